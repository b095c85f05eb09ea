// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "earthtop/results/results.hpp"
#include "results/columns.hpp"
#include "results/csv.hpp"
#include "results/digits.hpp"

namespace earthtop {
namespace {

std::string header() {
  std::string text(kTimeColumn);
  for (const Column& column : trajectory_columns()) text += ',' + column.name;
  return text + '\n';
}

/// The line of a row, put together in one piece of memory. A file may have millions of rows of some thirty numbers.
class Line {
 public:
  void add(double value) {
    if (std::isfinite(value)) end_ = std::to_chars(end_, end_ + kLongestNumber, value).ptr;
  }
  void add(const std::optional<double>& value) {
    if (value) add(*value);
  }
  void add(bool flag) { add(flag ? 1.0 : 0.0); }
  void add_char(char c) { *end_++ = c; }
  std::string_view text() const { return {begin_.data(), end_}; }

 private:
  static constexpr std::size_t kLongestNumber = 31;  // the longest shortest form of a double has 24 characters
  static constexpr std::size_t kNumbers = [] {
    std::size_t numbers = 1;  // the time
    for (const DriftQuantity& quantity : kDriftQuantities) numbers += quantity.width();
    return numbers;
  }();
  std::array<char, kNumbers*(kLongestNumber + 1)> begin_;
  char* end_ = begin_.data();
};

void append_row(std::string& text, const DriftRow& row) {
  Line line;
  line.add(row.t_s);
  const auto add = [&](const auto& number) {
    line.add_char(',');
    line.add(number);
  };
  for_each_drift_quantity([&](auto member, const RowQuantity&) {
    const auto& value = member(row);
    if constexpr (requires { value.size(); })
      for (const double component : value) add(component);
    else
      add(value);
  });
  line.add_char('\n');
  text += line.text();
}

/// Appends the line of a row of extended precision. The time is a double in every precision, and is written as one.
void append_row(std::string& text, const ExtendedDriftRow& row, Precision precision) {
  append_number(text, static_cast<double>(row.t_s));
  for (const DriftQuantity& quantity : kDriftQuantities)
    for (std::size_t i = 0; i < quantity.width(); ++i) {
      text += ',';
      if (const auto value = quantity.extended_value(row, i)) text += digits(*value, precision);
    }
  text += '\n';
}

}  // namespace

void write_trajectory_csv(const RunResult& result, const std::function<void(std::string_view)>& sink, const Watch& watch) {
  const auto append = [&](std::string& text, std::size_t i) {
    if (result.extended_rows.empty())
      append_row(text, result.rows[i]);
    else
      append_row(text, result.extended_rows[i], result.scene.scenario().precision);
  };
  write_csv(header(), result.rows.size(), append, sink, watch);
}

std::string trajectory_csv(const RunResult& result) {
  std::string text;
  write_trajectory_csv(result, [&](std::string_view piece) { text += piece; });
  return text;
}

}  // namespace earthtop
