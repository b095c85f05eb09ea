// SPDX-License-Identifier: GPL-3.0-or-later
// Changes of JSON documents and CSV tables that stay JSON and CSV.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "fuzz/door.hpp"
#include "fuzz/mutation.hpp"
#include "fuzz/properties.hpp"
#include "text/json.hpp"

namespace earthtop::fuzz {
namespace {

using Json = nlohmann::ordered_json;

void collect(Json& json, std::vector<Json*>& nodes) {
  nodes.push_back(&json);
  for (auto& element : json)
    if (json.is_structured()) collect(element, nodes);
}

Json odd_value(Random& random) {
  static const std::vector<Json> kValues = {nullptr,
                                            true,
                                            false,
                                            0,
                                            -1,
                                            1,
                                            2,
                                            3,
                                            1e-320,
                                            1e308,
                                            -1e308,
                                            0.5,
                                            1e-12,
                                            1e18,
                                            9007199254740993,
                                            -0.0,
                                            4294967296,
                                            "",
                                            "a",
                                            "-",
                                            "\n",
                                            "<b>&\"'",
                                            "nan",
                                            "1",
                                            "/",
                                            "/a~1b~0",
                                            "t_s",
                                            std::string(3000, 'x'),
                                            "\xE2\x80\xAE",
                                            "\x07",
                                            Json::array(),
                                            Json::object(),
                                            Json::array({Json::array()}),
                                            Json::array({1, 2, 3}),
                                            Json::object({{"", 1}})};
  return one_of(random, kValues);
}

/// Changes one value; often one below a member of the document that is chosen first, so that a small one is as likely as a large.
void change(Json& json, Random& random) {
  std::vector<Json*> nodes;
  if (json.is_structured() && !json.empty() && !one_in(random, 3)) {
    auto part = json.begin();
    std::advance(part, static_cast<std::ptrdiff_t>(below(random, json.size())));
    collect(*part, nodes);
  } else {
    collect(json, nodes);
  }
  Json& node = *nodes[below(random, nodes.size())];
  switch (below(random, 7)) {
    case 0: node = Json(*nodes[below(random, nodes.size())]); return;
    case 1:
      if (node.is_structured() && !node.empty()) {
        auto gone = node.begin();
        std::advance(gone, static_cast<std::ptrdiff_t>(below(random, node.size())));
        node.erase(gone);
        return;
      }
      break;
    case 2:
      if (node.is_array() && !node.empty()) {
        node.push_back(Json(node[below(random, node.size())]));
        return;
      }
      break;
    case 3:
      if (node.is_object() && !node.empty()) {  // a member under another name
        auto member = node.begin();
        std::advance(member, static_cast<std::ptrdiff_t>(below(random, node.size())));
        const Json value = member.value();
        node.erase(member);
        const Json name = odd_value(random);
        node[name.is_string() ? name.get<std::string>() : "x"] = value;
        return;
      }
      break;
    case 4:
      if (node.is_number()) {
        node = node.get<double>() * (below(random, 2) == 0 ? -1 : 1e3);
        return;
      }
      break;
    default: break;
  }
  node = odd_value(random);
}

std::string changed_table(std::string_view text, Random& random) {
  std::vector<std::string> lines;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.emplace_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  if (lines.empty()) return "";
  const std::size_t at = below(random, lines.size());
  switch (below(random, 6)) {
    case 0: lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(at), lines[below(random, lines.size())]); break;
    case 1: lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(at)); break;
    case 2: std::swap(lines[at], lines[below(random, lines.size())]); break;
    default: {
      std::string& line = lines[at];
      const char delimiter = line.find(';') != line.npos ? ';' : line.find('\t') != line.npos ? '\t' : ',';
      std::vector<std::size_t> starts = {0};
      for (std::size_t i = 0; i < line.size(); ++i)
        if (line[i] == delimiter) starts.push_back(i + 1);
      const std::size_t start = starts[below(random, starts.size())];
      const std::size_t end = std::min(line.find(delimiter, start), line.size());
      line.replace(start, end - start, odd_cell(random));
    }
  }
  std::string table;
  for (const std::string& line : lines) table += line + "\n";
  return table;
}

}  // namespace

std::string odd_cell(Random& random) {
  static const std::vector<std::string> kCells = {
      "",      "0",     "-0",  "1",   "nan",   "inf",          "-inf",   "1e999", "1e-400",
      "1e308", "0x1p3", " 1 ", "1,2", "\"1\"", "3.4028235e38", "5e-324", "abc",   "0.10000000000000000000000000000000001",
      "\t",    "-1",    "1e9"};
  return one_of(random, kCells);
}

std::string changed_text(std::string_view text, Random& random) {
  Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded() || !json.is_structured()) return changed_table(text, random);
  for (std::size_t times = 1 + below(random, 3); times > 0; --times) change(json, random);
  return written_replacing(json, 2) + "\n";
}

std::string mutated_text(std::string_view input, std::uint32_t seed) {
  Random random(seed);
  auto parts = parts_of(input);
  std::string& part = parts[below(random, parts.size())];
  part = changed_text(part, random);
  return joined(parts);
}

}  // namespace earthtop::fuzz
