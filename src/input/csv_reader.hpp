// SPDX-License-Identifier: GPL-3.0-or-later
/// Reads the numbers of a CSV file line by line; a file of a gigabyte needs a megabyte of memory.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "input/file.hpp"

namespace earthtop::input {

inline constexpr std::size_t kMostColumns = 10'000;  ///< a header with more is refused

struct CsvFormat {
  char delimiter = ',';
  char comment = '#';  ///< lines that begin with this character are skipped
  /// Whether the cells may also be separated by semicolons or tabs: by what the header has most of. Where no comma separates them, decimal
  /// signs may be commas.
  bool or_others = false;
};

enum class CellKind : char { number, empty, not_finite };

class CsvReader {
 public:
  /// Opens the file and reads its header line.
  /// @throws ScenarioError for a missing header, one with more than `kMostColumns` columns or one name twice, and a file that is not
  /// regular; ReadError where reading fails
  explicit CsvReader(const std::string& file, CsvFormat format = {});
  /// Reads a text instead of a file.   @param name  what messages call it
  static CsvReader of_text(std::string name, std::string text, CsvFormat format = {});

  const std::string& file() const { return file_; }
  const std::vector<std::string>& header() const { return header_; }
  /// Returns the column's index in the header; the size of the header if there is no column of this name.
  std::size_t find(std::string_view column) const;

  /// Selects the columns whose numbers `next` reads, and their order.
  void want(std::vector<std::size_t> columns);
  /// Takes the cells of a wanted column for words: the number of each is its place among the words, starting at 0.
  /// @param words  separated by '|'
  void take_words(std::size_t wanted, std::string_view words);

  /// Reads the numbers of the next line. @returns false at the end of the file
  /// @throws ScenarioError, with line and column, for a cell that is not a number, a line whose number of cells differs from
  /// that of the header, a NUL byte, a byte that is not UTF-8, and a last line without a line end, as an interrupted write
  /// leaves it; ReadError where reading fails
  bool next();
  std::span<const double> numbers() const { return numbers_; }  ///< in the order of `want`; NaN for a cell without a number
  std::span<const CellKind> kinds() const { return kinds_; }
  std::string_view text(std::size_t wanted) const { return cells_[wanted_[wanted]]; }  ///< a cell's text as it is in the file
  /// Returns the share of the file that has been read, relative to its length when it was opened.
  double share_read() const { return size_ > 0 ? static_cast<double>(read_) / static_cast<double>(size_) : 0; }
  std::uint64_t line() const { return line_; }  ///< number of the current line, from 1
  /// Returns the position of a cell in its line (bytes), counted from 1.
  std::size_t column(std::size_t wanted) const { return static_cast<std::size_t>(text(wanted).data() - whole_.data()) + 1; }

 private:
  CsvReader(std::string file, CsvFormat format, Descriptor descriptor, std::string text);
  bool read_line(std::string_view& line);
  void require_text(std::string_view line) const;
  void split(std::string_view line, std::size_t most);
  bool parse_number(std::string_view given, double& number, CellKind& kind);
  [[noreturn]] void refuse(std::string message, std::size_t column = 1) const;

  std::string file_;
  CsvFormat format_;
  Descriptor descriptor_;
  std::uint64_t size_ = 0, read_ = 0;  // bytes
  std::string buffer_;
  std::size_t begin_ = 0, end_ = 0;  // bounds of the unused bytes in the buffer
  std::uint64_t line_ = 0;
  char decimal_sign_ = 0;           // of the file's numbers, where it may be a comma; 0: not seen yet
  std::uint64_t decimal_line_ = 0;  // where it was seen
  std::vector<std::string> header_;
  std::vector<std::string_view> cells_;
  std::string_view whole_;  // the line that holds the cells
  std::vector<std::size_t> wanted_;
  std::vector<std::vector<std::string_view>> words_;  // of each wanted column; empty for a column of numbers
  std::vector<double> numbers_;
  std::vector<CellKind> kinds_;
};

}  // namespace earthtop::input
