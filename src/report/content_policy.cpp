// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/content_policy.hpp"

#include <fmt/core.h>

#include <set>
#include <string_view>

#include "text/sha256.hpp"

namespace earthtop::report {
namespace {

std::string base64_of_hex(std::string_view hex) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  unsigned bits = 0;
  int count = 0;
  for (const char c : hex) {
    bits = bits << 4U | static_cast<unsigned>(c <= '9' ? c - '0' : c - 'a' + 10);
    count += 4;
    if (count < 6) continue;
    count -= 6;
    text += kDigits[bits >> static_cast<unsigned>(count) & 63U];
  }
  if (count > 0) text += kDigits[bits << static_cast<unsigned>(6 - count) & 63U];
  while (text.size() % 4 != 0) text += '=';
  return text;
}

/// Hashes of the contents of all elements that begin with `open`.
std::string hashes(std::string_view html, std::string_view open, std::string_view close) {
  std::set<std::string> found;
  for (std::size_t at = html.find(open); at != html.npos; at = html.find(open, at)) {
    const std::size_t begin = at + open.size(), end = html.find(close, begin);
    if (end == html.npos) break;
    found.insert(fmt::format(" 'sha256-{}'", base64_of_hex(sha256_hex(std::string(html.substr(begin, end - begin))))));
    at = end;
  }
  std::string text;
  for (const std::string& hash : found) text += hash;
  return text;
}

}  // namespace

void set_content_policy(std::string& html) {
  const std::string policy =
      fmt::format("default-src 'none'; style-src{}; script-src{}; img-src data:; base-uri 'none'; form-action 'none'",
                  hashes(html, "<style>", "</style>"), hashes(html, "<script>", "</script>"));
  const std::string_view place = kPolicyPlace;
  html.replace(html.find(place), place.size(), policy);
}

}  // namespace earthtop::report
