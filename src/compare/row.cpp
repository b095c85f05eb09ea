// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/row.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "earthtop/elementary.hpp"
#include "results/columns.hpp"

namespace earthtop::compare {
namespace {

using enum MeasureKind;

template <class Quantities>
Table table_of(std::string_view file, const Quantities& quantities) {
  Table table{file, {}, {}};
  for (const RowQuantity& quantity : quantities) {
    table.measures.push_back({quantity.measure, quantity.kind, quantity.part, quantity.bound, quantity.effect,
                              table.columns.size(), quantity.width(), quantity.column(0), quantity.words, quantity.owner});
    for (std::size_t i = 0; i < quantity.width(); ++i) table.columns.push_back(quantity.column(i));
  }
  if (table.columns.size() > Row::kMostColumns) throw std::logic_error("more columns than a row has room for");
  std::stable_sort(table.measures.begin(), table.measures.end(),
                   [](const Measure& a, const Measure& b) { return a.part < b.part; });
  return table;
}

double length(const double* v, std::size_t n) {
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) sum += v[i] * v[i];
  if (std::isfinite(sum)) return std::sqrt(sum);
  double largest = 0;  // stands in for the length where the sum of squares overflows
  for (std::size_t i = 0; i < n; ++i) largest = std::max(largest, std::abs(v[i]));
  return largest;
}

/// The angle between two vectors (rad), from their cross and dot products: no digits cancel where the angle is small.
double angle_between(const double* a, const double* b) {
  const double x[] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  return real::atan2(length(x, 3), a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
}

/// The angle of the turn conj(a) b from one quaternion's attitude to the other's (rad), which does not depend on their signs.
double turn_between(const double* a, const double* b) {
  const double w = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
  const double v[] = {a[0] * b[1] - b[0] * a[1] - (a[2] * b[3] - a[3] * b[2]),
                      a[0] * b[2] - b[0] * a[2] - (a[3] * b[1] - a[1] * b[3]),
                      a[0] * b[3] - b[0] * a[3] - (a[1] * b[2] - a[2] * b[1])};
  return 2 * real::atan2(length(v, 3), std::abs(w));
}

}  // namespace

bool tells_motion(const Measure& measure) {
  return measure.name == "attitude_rad" || measure.name == "axis_rad" || measure.name == "rates_rad_s";
}

std::optional<std::size_t> Table::find(std::string_view column) const {
  const auto at = std::find(columns.begin(), columns.end(), column);
  return at == columns.end() ? std::nullopt : std::optional(static_cast<std::size_t>(at - columns.begin()));
}

const Measure& Table::measure_of(std::size_t column) const {
  return *std::find_if(measures.begin(), measures.end(), [&](const Measure& measure) {
    return column >= measure.column && column < measure.column + measure.width;
  });
}

const Table& trajectory_table() {
  static const Table table = table_of("trajectory.csv", kDriftQuantities);
  return table;
}
const Table& torques_table() {
  static const Table table = table_of("torques.csv", torque_quantities());
  return table;
}

Presence presence(const Measure& measure, const Row& row) {
  bool empty = false;
  for (std::size_t i = measure.column; i < measure.column + measure.width; ++i) {
    if (row.kind[i] == CellKind::not_finite) return Presence::not_finite;
    empty = empty || row.kind[i] == CellKind::empty;
  }
  return empty ? Presence::empty : Presence::whole;
}

double difference(const Measure& measure, const Row& row_a, const Row& row_b) {
  const double* a = row_a.value.data() + measure.column;
  const double* b = row_b.value.data() + measure.column;
  switch (measure.kind) {
    case attitude: return std::max(turn_between(a, b), 2 * std::abs(length(a, 4) - length(b, 4)));
    case direction: return std::max(angle_between(a, b), std::abs(length(a, 3) - length(b, 3)));
    case vector: {
      const double d[] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
      return length(d, 3);
    }
    case place: {
      const double d[] = {a[0] - b[0], a[1] - b[1]};
      return length(d, 2);
    }
    case angle: return std::abs(std::remainder(*a - *b, 2 * std::numbers::pi));
    case number:
    case word:
    case flag: return std::abs(*a - *b);
  }
  return 0;
}

double size(const Measure& measure, const Row& row) {
  if (measure.kind == attitude || measure.kind == direction) return 1;
  if (measure.kind == angle) return std::abs(std::remainder(row.value[measure.column], 2 * std::numbers::pi));
  return length(row.value.data() + measure.column, measure.width);
}

}  // namespace earthtop::compare
