// SPDX-License-Identifier: GPL-3.0-or-later
/// Rows of a result file, and the physical measures in which two rows are compared.
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

/// A row: its time (s), and the cells of its table's columns in their order.
struct Row {
  static constexpr std::size_t kMostColumns = 96;
  double t_s = 0;
  std::array<double, kMostColumns> value{};  // NaN where there is no number
  std::array<CellKind, kMostColumns> kind{};
  std::array<std::size_t, kMostColumns> more_digits{};  // a hash of the cell if it has more digits than a double; else 0
};

/// The difference of two rows in one quantity.
struct Measure {
  std::string_view name;  ///< with its unit
  MeasureKind kind;
  RowPart part;
  BoundKind bound;
  std::string_view effect;   ///< the measure whose largest value is the Earth's effect on this one; empty if none
  std::size_t column;        ///< index of the first of its columns
  std::size_t width;         ///< number of its columns
  std::string first_column;  ///< name of the first column
  std::string_view words;    ///< of a word: those it may be
  RowOwner owner;            ///< which runs have it
};

/// Whether it is the attitude, the axis or the rates of the top: what another program's file may have.
bool tells_motion(const Measure& measure);

/// The columns of a result file after the time, and the measures made of them.
struct Table {
  std::string_view file;
  std::vector<std::string> columns;
  std::vector<Measure> measures;
  std::optional<std::size_t> find(std::string_view column) const;
  /// The measure that a column belongs to.
  const Measure& measure_of(std::size_t column) const;
};
const Table& trajectory_table();
const Table& torques_table();

/// Whether a row's cells of a measure are all numbers (`whole`), some are empty, or some are not finite.
enum class Presence { whole, empty, not_finite };
Presence presence(const Measure& measure, const Row& row);

/// Difference of two rows in a measure that both have, in its unit; at least 0. Directions and quaternions should have length
/// 1. A difference of their lengths counts as well, so that a change along their direction does not stay unnoticed.
double difference(const Measure& measure, const Row& a, const Row& b);

/// Size of a measure: the absolute value of a number, or of a word's number; the same for an angle, reduced to at most half a turn; the length of a
/// vector; 1 for an attitude or a direction.
double size(const Measure& measure, const Row& row);

}  // namespace earthtop::compare
