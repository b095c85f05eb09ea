// SPDX-License-Identifier: GPL-3.0-or-later
/// Numbers of a CSV line: shortest ones that read back to the same bits; what is not finite is an empty field.
#pragma once

#include <charconv>
#include <cmath>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

#include "earthtop/run.hpp"

namespace earthtop {

inline void append_number(std::string& line, double value) {
  if (!std::isfinite(value)) return;
  char digits[32];  // the longest shortest form of a double has 24 characters
  const auto [end, error] = std::to_chars(digits, digits + sizeof digits, value);
  line.append(digits, end);
}

/// Header and rows to the sink, in pieces of whole lines: two million rows at once are a gigabyte.
/// @param append_row  appends the line of a row, by its number, to a text
/// @param watch  sees how far it is
template <class AppendRow>
void write_csv(std::string header, std::size_t rows, AppendRow append_row, const std::function<void(std::string_view)>& sink,
               const Watch& watch) {
  constexpr std::size_t kPiece = std::size_t{1} << 18;
  std::string text = std::move(header);
  for (std::size_t i = 0; i < rows; ++i) {
    append_row(text, i);
    if (text.size() < kPiece) continue;
    watch.reach(static_cast<double>(i) / static_cast<double>(rows));
    sink(text);
    text.clear();
  }
  sink(text);
}

void write_trajectory_csv(const RunResult& result, const std::function<void(std::string_view)>& sink, const Watch& watch = {});
void write_torques_csv(const RunResult& result, const std::function<void(std::string_view)>& sink, const Watch& watch = {});

}  // namespace earthtop
