// SPDX-License-Identifier: GPL-3.0-or-later
/// Rows of a result file, and the physical measures in which two of them are held against each other.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drift/row_quantities.hpp"
#include "input/csv_reader.hpp"

namespace earthtop::compare {

using input::CellKind, input::CsvReader;

/// A row: its time, and the cells of its table's columns in their order.
struct Row {
  static constexpr std::size_t kMostColumns = 32;
  double t_s = 0;
  std::array<double, kMostColumns> value{};  // NaN where there is no number
  std::array<CellKind, kMostColumns> kind{};
  std::array<std::size_t, kMostColumns> more_digits{};  // a hash of the cell where a double does not hold all of it; else 0
};

/// The difference of two rows in one quantity.
struct Measure {
  std::string_view name;  ///< with its unit
  MeasureKind kind;
  RowPart part;
  BoundKind bound;
  std::string_view effect;   ///< the measure whose largest value is the Earth's effect on this one; empty where there is none
  std::size_t column;        ///< the first of its columns
  std::size_t width;         ///< how many there are
  std::string first_column;  ///< its name
};

/// A result file's columns after the time, and what is measured of them.
struct Table {
  std::string_view file;
  std::vector<std::string> columns;
  std::vector<Measure> measures;
  std::optional<std::size_t> find(std::string_view column) const;
};
const Table& trajectory_table();
const Table& torques_table();

/// Which cells of a measure are there.
enum class Presence { whole, empty, not_finite };
Presence presence(const Measure& measure, const Row& row);

/// Difference of two rows in a measure that both have, in its unit; at least 0. Directions and quaternions should have length
/// 1: what their lengths differ by counts as well, so that no changed digit hides along them.
double difference(const Measure& measure, const Row& a, const Row& b);

/// Size of a measure: of a number its absolute value, of an angle the same within half a turn, of a vector its length, of an
/// attitude or a direction 1.
double size(const Measure& measure, const Row& row);

}  // namespace earthtop::compare
