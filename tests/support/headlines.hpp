// SPDX-License-Identifier: GPL-3.0-or-later
/// The output of the reference program of tests/headlines: for each scene, the columns of trajectory.csv at one time.
#pragma once

#include <fmt/format.h>

#include <map>
#include <optional>
#include <stdexcept>
#include <string>

#include "support/json.hpp"

namespace earthtop::testing {

/// A scene's values, kept to the last digit in long double; `error` is the generator's own estimate, the largest over all
/// columns.
struct GeneratedValues {
  double at_s = 0;
  long double error = 0;
  std::map<std::string, std::optional<long double>> columns;

  long double at(const std::string& column) const {
    const auto& value = columns.at(column);
    if (!value) throw std::runtime_error(fmt::format("{} has no generated value", column));
    return *value;
  }
};

inline const nlohmann::json& generated_document() {
  static const nlohmann::json document = parse_json(read_file(EARTHTOP_TESTS "/data/headlines.json"));
  return document;
}

inline GeneratedValues generated_values(const std::string& name) {
  for (const auto& scene : generated_document().at("scenarios")) {
    if (scene.at("name") != name) continue;
    GeneratedValues values{scene.at("at_s").get<double>(), std::stold(scene.at("error").get<std::string>()), {}};
    for (const auto& [column, text] : scene.at("columns").items())
      values.columns[column] = text.is_null() ? std::nullopt : std::optional(std::stold(text.get<std::string>()));
    return values;
  }
  throw std::runtime_error(fmt::format("tests/data/headlines.json has no values of {}", name));
}

}  // namespace earthtop::testing
