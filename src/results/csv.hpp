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

/// Hands header and rows to a sink in pieces of whole lines, because two million rows at once would take a gigabyte.
class CsvPieces {
 public:
  CsvPieces(std::string header, const std::function<void(std::string_view)>& sink) : sink_(sink), text_(std::move(header)) {}
  /// Appends the line of a row. @param append  is called with the text, to which it appends the line
  template <class Append>
  void add(Append append) {
    constexpr std::size_t kPiece = std::size_t{1} << 18;
    append(text_);
    if (text_.size() >= kPiece) flush();
  }
  void flush() {
    sink_(text_);
    text_.clear();
  }

 private:
  const std::function<void(std::string_view)>& sink_;
  std::string text_;
};

void write_trajectory_csv(const RunResult& result, const std::function<void(std::string_view)>& sink, const Watch& watch = {});
void write_torques_csv(const RunResult& result, const std::function<void(std::string_view)>& sink, const Watch& watch = {});

}  // namespace earthtop
