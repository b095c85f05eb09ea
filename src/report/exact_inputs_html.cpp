// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/exact_inputs_html.hpp"

#include <fmt/core.h>

#include <vector>

#include "earthtop/measure/exact_input.hpp"
#include "measure/spoken_input.hpp"
#include "results/meanings.hpp"
#include "text/json.hpp"

namespace earthtop::report {

std::string input_name(const Json& entry, const char* key) {
  const Json release = entry.value("release", Json());
  return name_in_release(entry.at(key).get<std::string>(), release.is_number() ? count_in(release) : 0);
}

std::string input_words(const Json& entry, const char* key) {
  const std::string name = entry.at(key).get<std::string>();
  std::string words = measure::spoken_input(name);
  if (words == name) words = words_of_setting(name, name.starts_with('/') ? name : "").words;
  while (words.ends_with(',')) words.pop_back();
  if (words.starts_with("the ")) words.erase(0, 4);
  const Json release = entry.value("release", Json());
  if (release.is_number() && count_in(release) > 0) words += fmt::format(", release {}", count_in(release));
  return words;
}

std::string input_html(const Json& entry, const char* key) {
  return fmt::format("<span title=\"{}\">{}</span>", escaped(entry.at(key).get<std::string>()),
                     escaped(input_words(entry, key)));
}

std::string exact_inputs_html(const Json& estimate) {
  std::vector<std::vector<std::string>> rows;
  for (const Json& input : estimate.value("exact", Json::array())) {
    const std::string unit = input.at("unit").get<std::string>();
    rows.push_back({input_html(input), number_html(input.at("value"), unit, 9),
                    number_html(input.at("error_of_one_sigma"), unit, 2), number_html(input.at("stated"), unit, 2)});
  }
  if (rows.empty()) return "";
  return "<h3>Taken as exact</h3>\n<p>Each error by itself would shift " + input_html(estimate) +
         " by one standard error.</p>\n" +
         table_html({"input", "scenario's value", "error that shifts by one standard error", "stated standard error"}, rows);
}

}  // namespace earthtop::report
