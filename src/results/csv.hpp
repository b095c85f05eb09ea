// SPDX-License-Identifier: GPL-3.0-or-later
/// Writing of CSV files. A number is written in its shortest form that reads back to the same bits; a number that is not finite
/// becomes an empty field.
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

/// Writes header and rows to the sink in pieces of whole lines, because two million rows at once would take a gigabyte.
/// @param append_row  is called with a text and the number of a row, and appends the row's line to the text
/// @param watch  gets the progress
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
