// SPDX-License-Identifier: GPL-3.0-or-later
/// Numbers of a CSV file, a line at a time: a gigabyte passes through a megabyte of memory.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "input/file.hpp"

namespace earthtop::input {

struct CsvFormat {
  char delimiter = ',';
  char comment = '#';  ///< lines that begin with it are passed over
};

enum class CellKind : char { number, empty, not_finite };

class CsvReader {
 public:
  /// Opens the file and reads its header line. @throws ScenarioError where there is none, or no regular file; ReadError
  explicit CsvReader(std::string file, CsvFormat format = {});

  const std::string& file() const { return file_; }
  const std::vector<std::string>& header() const { return header_; }
  /// The column's place in the header; the header's size where there is none of this name.
  std::size_t find(std::string_view column) const;

  /// Says which columns' numbers are wanted from now on, and in which order.
  void want(std::vector<std::size_t> columns);

  /// The next line's numbers. @returns false at the end
  /// @throws ScenarioError, with line and column, for a cell that is no number, a line of another length than the header, and
  /// a last line without an end, as a writing that broke off leaves it; ReadError
  bool next();
  std::span<const double> numbers() const { return numbers_; }  ///< in the wanted order; NaN where there is none
  std::span<const CellKind> kinds() const { return kinds_; }
  std::string_view text(std::size_t wanted) const { return cells_[wanted_[wanted]]; }  ///< as it stands in the file
  /// The part of the file that has been read, by its length when it was opened.
  double share_read() const { return size_ > 0 ? static_cast<double>(read_) / static_cast<double>(size_) : 0; }
  std::uint64_t line() const { return line_; }  ///< counted from 1
  /// The cell's place in its line (bytes), counted from 1.
  std::size_t column(std::size_t wanted) const { return static_cast<std::size_t>(text(wanted).data() - whole_.data()) + 1; }

 private:
  bool read_line(std::string_view& line);
  void split(std::string_view line);
  [[noreturn]] void refuse(std::string message, std::size_t column = 1) const;

  std::string file_;
  CsvFormat format_;
  Descriptor descriptor_;
  std::uint64_t size_ = 0, read_ = 0;  // bytes
  std::string buffer_;
  std::size_t begin_ = 0, end_ = 0;  // of what is in the buffer and not yet given out
  std::uint64_t line_ = 0;
  std::vector<std::string> header_;
  std::vector<std::string_view> cells_;
  std::string_view whole_;  // the line the cells are of
  std::vector<std::size_t> wanted_;
  std::vector<double> numbers_;
  std::vector<CellKind> kinds_;
};

}  // namespace earthtop::input
