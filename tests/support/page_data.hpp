// SPDX-License-Identifier: GPL-3.0-or-later
/// Reads the data of a page, and the motion in those of a run's page as assets/unpack.js does.
#pragma once

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "support/json.hpp"

namespace earthtop::testing {

/// The text between two texts.
inline std::string between(const std::string& text, const std::string& from, const std::string& to) {
  const std::size_t begin = text.find(from) + from.size();
  return text.substr(begin, text.find(to, begin) - begin);
}

inline nlohmann::json data_of(const std::string& html) {
  return parse_json(between(html, "<script type=\"application/json\" id=\"earthtop-data\">", "</script>"));
}

inline std::vector<double> unpacked_numbers(const nlohmann::json& packed) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
  const auto from = packed.at("from").get<double>(), unit = packed.at("unit").get<double>();
  std::vector<double> list;
  std::int64_t slope = 0, step = 0, number = 0, place = 1;
  for (const char c : packed.at("text").get<std::string>()) {
    const auto digit = static_cast<std::int64_t>(kDigits.find(c));
    number += digit % 32 * place, place *= 32;
    if (digit >= 32) continue;
    const std::int64_t bend = number % 2 == 1 ? -(number / 2) - 1 : number / 2;
    // The first number is its own second difference, since those before it count as 0.
    slope = list.empty() ? bend : slope + bend;
    step += slope;
    list.push_back(from + static_cast<double>(step) * unit);
    number = 0, place = 1;
  }
  return list;
}

/// Times and axes, three numbers for each time.
struct UnpackedAxes {
  std::vector<double> t_s, axis_L, ref_axis_L;
};
inline UnpackedAxes unpacked_axes(const nlohmann::json& data) {
  UnpackedAxes axes;
  const nlohmann::json &packed = data.at("packed"), &times = packed.at("times"), &both = packed.at("axes");
  const auto count = both.at("count").get<std::size_t>(), dropped = both.at("dropped").get<std::size_t>();
  for (std::size_t i = 0; i < count; ++i) {
    const auto even = [&] {
      const auto from = times.at("from").get<double>(), to = times.at("to").get<double>();
      return from + (to - from) * static_cast<double>(i) / static_cast<double>(count - 1);
    };
    axes.t_s.push_back(times.is_array() ? times.at(i).get<double>() : even());
  }
  std::vector<std::vector<double>> ref, off;
  for (const auto& component : both.at("ref")) ref.push_back(unpacked_numbers(component));
  for (const auto& component : both.at("off")) off.push_back(unpacked_numbers(component));
  for (std::size_t i = 0; i < count; ++i)
    for (const bool is_reference : {true, false}) {
      std::vector<double> known;
      double squared = 0;
      for (std::size_t k = 0; k < ref.size(); ++k) {
        known.push_back(ref[k][i] + (is_reference ? 0 : off[k][i]));
        squared += known.back() * known.back();
      }
      if (dropped < 3)
        known.insert(known.begin() + static_cast<std::ptrdiff_t>(dropped),
                     both.at("sign").get<double>() * std::sqrt(1 - squared));
      auto& list = is_reference ? axes.ref_axis_L : axes.axis_L;
      list.insert(list.end(), known.begin(), known.end());
    }
  return axes;
}

}  // namespace earthtop::testing
