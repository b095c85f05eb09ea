// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/exact_inputs_html.hpp"

#include <vector>

#include "earthtop/measure/exact_input.hpp"
#include "text/json.hpp"

namespace earthtop::report {

std::string input_name(const Json& entry, const char* key) {
  const Json release = entry.value("release", Json());
  return name_in_release(entry.at(key).get<std::string>(), release.is_number() ? count_in(release) : 0);
}

std::string exact_inputs_html(const Json& estimate) {
  std::vector<std::vector<std::string>> rows;
  for (const Json& input : estimate.value("exact", Json::array())) {
    const std::string unit = input.at("unit").get<std::string>();
    rows.push_back({escaped(input_name(input)), number_html(input.at("value"), unit, 9),
                    number_html(input.at("error_of_one_sigma"), unit, 2), number_html(input.at("stated"), unit, 2)});
  }
  if (rows.empty()) return "";
  return "<h3>Taken as exact</h3>\n<p>Each error by itself would shift " + escaped(input_name(estimate)) +
         " by one standard error.</p>\n" +
         table_html({"input", "scenario's value", "error that shifts by one standard error", "stated standard error"}, rows);
}

}  // namespace earthtop::report
