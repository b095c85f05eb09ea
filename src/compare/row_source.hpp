// SPDX-License-Identifier: GPL-3.0-or-later
/// Sources of rows: a result file of earthtop's, a foreign CSV with a mapping, or a compact reference.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "compare/mapping.hpp"
#include "compare/row.hpp"

namespace earthtop::compare {

/// How finely numbers are printed, as far as their texts tell: to as many significant digits, or decimals, as the longest of them has.
class PrintedDigits {
 public:
  void add(std::string_view text, double value);
  /// The largest error by which a number was rounded when it was printed, in its unit; 0 without numbers.
  double rounding() const;
  int significant() const { return significant_; }

 private:
  int significant_ = 0, decimals_ = 0;
  double largest_ = 0;
};

class RowSource {
 public:
  virtual ~RowSource() = default;
  RowSource() = default;
  RowSource(const RowSource&) = delete;
  RowSource& operator=(const RowSource&) = delete;

  /// Reads the next row. @returns false at the end. The time of a row is later than that of the row before.
  /// @throws ScenarioError where the file ends too early, or has a line that cannot be a row
  virtual bool next(Row& row) = 0;
  virtual bool has_column(std::size_t column) const = 0;
  virtual std::string where() const = 0;  ///< file and line of the last row
  /// The part of the file that has been read, 0 to 1; 0 where it is not known.
  virtual double share_read() const { return 0; }
  /// The names of the file's columns that are not columns of the table.
  virtual std::vector<std::string> other_columns() const { return {}; }

  bool has(const Measure& measure) const;

  /// Begins to look at the digits of the rows to come.
  void count_digits() { counts_digits_ = true; }
  /// The digits of a column of the table; kTime for the times. Those of a mapped file are in the file's units.
  const PrintedDigits& digits(std::size_t column) const { return digits_[column]; }
  static constexpr std::size_t kTime = Row::kMostColumns;

 protected:
  void count(std::size_t column, std::string_view text, double value) {
    if (counts_digits_) digits_[column].add(text, value);
  }

 private:
  bool counts_digits_ = false;
  std::array<PrintedDigits, Row::kMostColumns + 1> digits_;
};

/// Rows of a file with the table's own column names.
std::unique_ptr<RowSource> open_own_csv(const std::string& file, const Table& table);
/// Rows of a trajectory in another program's columns, converted to the columns of trajectory.csv.
std::unique_ptr<RowSource> open_mapped_csv(const std::string& file, const Mapping& mapping);

}  // namespace earthtop::compare
