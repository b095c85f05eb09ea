// SPDX-License-Identifier: GPL-3.0-or-later
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

void append_row(std::string& text, const DriftRow& row) {
  append_number(text, row.t_s);
  for (const DriftQuantity& quantity : kDriftQuantities)
    for (std::size_t i = 0; i < quantity.width(); ++i) {
      text += ',';
      if (const auto value = quantity.value(row, i)) append_number(text, *value);
    }
  text += '\n';
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
