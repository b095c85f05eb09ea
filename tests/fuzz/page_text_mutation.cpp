// SPDX-License-Identifier: GPL-3.0-or-later
// Changes of what the door of page texts takes: the document, the words of it that are replaced, and the texts that come there.
#include <vector>

#include "fuzz/door.hpp"
#include "fuzz/mutation.hpp"
#include "fuzz/properties.hpp"

namespace earthtop::fuzz {
namespace {

/// Where a character of a text begins, or anywhere.
std::size_t place_in(const std::string& text, Random& random) {
  std::size_t at = below(random, text.size() + 1);
  if (!one_in(random, 8))
    while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U) ++at;
  return at;
}

void change_text(std::string& text, Random& random) {
  switch (below(random, 6)) {
    case 0: text = odd_words(random); break;
    case 1: text.erase(place_in(text, random)); break;
    case 2: text.erase(0, place_in(text, random)); break;
    case 3:
      for (std::size_t times = below(random, 8); times > 0 && text.size() < 4096; --times) text += text;
      break;
    default: text.insert(place_in(text, random), odd_words(random));
  }
}

/// The bits that choose words: none, all, one, or any.
std::string odd_choice(Random& random) {
  std::string choice(1 + below(random, 24), '\0');
  switch (below(random, 4)) {
    case 0: return "\xFF";
    case 1: choice[below(random, choice.size())] = static_cast<char>(1U << below(random, 8)); break;
    case 2: choice.assign(choice.size(), static_cast<char>(1U << below(random, 8))); break;
    default:
      for (char& bits : choice) bits = static_cast<char>(random());
  }
  for (char& bits : choice)
    if (bits == kBetweenParts) bits = '\x02';
  return choice;
}

}  // namespace

std::string odd_words(Random& random) {
  static const std::vector<std::string> kWords = {"<",
                                                  ">",
                                                  "&",
                                                  "\"",
                                                  "'",
                                                  "&lt;",
                                                  "&#0;",
                                                  "&#x202e;",
                                                  "&amp;amp;",
                                                  "<!--",
                                                  "-->",
                                                  "--",
                                                  "]]>",
                                                  "<![CDATA[",
                                                  "<?xml ?>",
                                                  "</title>",
                                                  "</script>",
                                                  "</SCRIPT >",
                                                  "</style>",
                                                  "</svg>",
                                                  "<script>alert(1)</script>",
                                                  "<img src=x onerror=alert(1)>",
                                                  "<a href=\"javascript:alert(1)\">",
                                                  "<base href=//x>",
                                                  "\" onload=\"x",
                                                  "' onload='x",
                                                  "`",
                                                  "${x}",
                                                  "{{x}}",
                                                  "{}",
                                                  "{0}",
                                                  "%s",
                                                  "%00",
                                                  "\\",
                                                  "\\u003c",
                                                  "\\u0000",
                                                  "\\ud800",
                                                  std::string(1, '\0'),
                                                  "\x02",
                                                  "\x07",
                                                  "\x1B[31m",
                                                  "\x7F",
                                                  "\n",
                                                  "\r\n",
                                                  "\t",
                                                  "\xC2\x85",
                                                  "\xC2\xA0",
                                                  "\xC2\xAD",
                                                  "\xCC\x81",
                                                  "\xE2\x80\x8B",
                                                  "\xE2\x80\xA8",
                                                  "\xE2\x80\xAE",
                                                  "\xE2\x81\xA6",
                                                  "\xEF\xBB\xBF",
                                                  "\xEF\xBF\xBE",
                                                  "\xF0\x9F\x98\x80",
                                                  "\xF3\xA0\x80\xA0",
                                                  "\xF4\x8F\xBF\xBF",
                                                  "\xC0\xAF",
                                                  "\xED\xA0\x80",
                                                  "\xF4\x90\x80\x80",
                                                  "\xE2\x80",
                                                  "\xFF",
                                                  "\xCE\xA9",
                                                  "\xD7\x90",
                                                  "=1+1",
                                                  "+1",
                                                  "-x",
                                                  "@x",
                                                  ",",
                                                  ";",
                                                  "\"\"",
                                                  "10^-3",
                                                  "1e-3",
                                                  "^2",
                                                  "m^2 s^-1",
                                                  "nan",
                                                  "inf",
                                                  "1e999",
                                                  "a",
                                                  "word word word word word word word word word word word word",
                                                  std::string(200, 'W'),
                                                  "'\"'\"'",
                                                  "$(x)",
                                                  "!x",
                                                  "EOF\n"};
  return one_of(random, kWords);
}

std::string mutated_page_text(std::string_view input, std::uint32_t seed) {
  Random random(seed);
  auto parts = parts_of(input.empty() ? input : input.substr(1));
  parts.resize(std::max<std::size_t>(parts.size(), 2));
  char document = input.empty() ? 'F' : input.front();
  switch (below(random, 6)) {
    case 0: document = static_cast<char>('A' + below(random, 26)); break;
    case 1: parts[0] = odd_choice(random); break;
    case 2:
      if (parts.size() < 5) parts.push_back(odd_words(random));
      break;
    case 3:
      if (parts.size() > 2) parts.pop_back();
      break;
    default: break;
  }
  change_text(parts[1 + below(random, parts.size() - 1)], random);
  return std::string(1, document) + joined(parts);
}

}  // namespace earthtop::fuzz
