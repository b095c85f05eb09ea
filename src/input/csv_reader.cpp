// SPDX-License-Identifier: GPL-3.0-or-later
#include "input/csv_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <unordered_set>

#include "earthtop/error.hpp"
#include "input/csv_text.hpp"
#include "input/fields.hpp"
#include "input/node.hpp"
#include "text/utf8.hpp"

namespace earthtop::input {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 20;         // bytes read at once
constexpr std::size_t kLongestLine = std::size_t{16} << 20;  // bytes; a file without line ends is not a table of numbers
constexpr FileUse kCsvFile = {"CSV file", false};
constexpr int kNoFile = -1;  // in place of a descriptor: all there is to read is in the buffer

std::string_view trimmed(std::string_view cell) {
  while (!cell.empty() && (cell.front() == ' ' || cell.front() == '\t')) cell.remove_prefix(1);
  while (!cell.empty() && (cell.back() == ' ' || cell.back() == '\t' || cell.back() == '\r')) cell.remove_suffix(1);
  if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') cell = cell.substr(1, cell.size() - 2);
  return cell;
}

/// Whether a cell is a number with a decimal comma.
bool has_decimal_comma(std::string_view cell) {
  std::string text(cell);
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos) return false;
  text[comma] = '.';
  return cell_number(text).is_number;
}

/// Parses a cell. @returns whether it is a number, a word for one (nan, inf), or empty
bool parse(std::string_view cell, double& number, CellKind& kind) {
  number = std::numeric_limits<double>::quiet_NaN();
  kind = CellKind::empty;
  if (cell.empty()) return true;
  if (cell.size() > 1 && cell[0] == '+' && cell[1] != '-') cell.remove_prefix(1);
  const CellNumber given = cell_number(cell);
  if (!given.is_number) return false;
  const double parsed = given.fits_a_double ? given.value : std::strtod(std::string(cell).c_str(), nullptr);  // 0 or infinity
  kind = std::isfinite(parsed) ? CellKind::number : CellKind::not_finite;
  if (kind == CellKind::number) number = parsed;
  return true;
}

}  // namespace

CsvReader::CsvReader(const std::string& file, CsvFormat format)
    : CsvReader(file, format, open_regular_file(file, file, kCsvFile), "") {}

CsvReader CsvReader::of_text(std::string name, std::string text, CsvFormat format) {
  return {std::move(name), format, Descriptor(kNoFile), std::move(text)};
}

CsvReader::CsvReader(std::string file, CsvFormat format, Descriptor descriptor, std::string text)
    : file_(std::move(file)),
      format_(format),
      descriptor_(std::move(descriptor)),
      size_(text.size()),
      read_(text.size()),
      buffer_(std::move(text)),
      end_(buffer_.size()) {
  struct stat status = {};
  if (::fstat(descriptor_.get(), &status) == 0 && status.st_size > 0) size_ = static_cast<std::uint64_t>(status.st_size);
  std::string_view line;
  if (!read_line(line)) refuse("is empty; a header line and rows of numbers are needed");
  if (format_.or_others)
    for (const char other : {';', '\t'})
      if (std::ranges::count(line, other) > std::ranges::count(line, format_.delimiter)) format_.delimiter = other;
  split(line, kMostColumns + 1);
  if (cells_.size() > kMostColumns)
    refuse(fmt::format("the header names more than {} columns, the most that a table may have; leave some out", kMostColumns),
           static_cast<std::size_t>(cells_.back().data() - whole_.data()) + 1);
  for (const std::string_view cell : cells_) header_.emplace_back(cell);
  std::unordered_set<std::string_view> names;
  for (const std::string& name : header_)
    if (!name.empty() && !names.insert(name).second)
      refuse(fmt::format("column \"{}\" occurs twice in the header; rename one, or leave it out", excerpt(name)));
}

std::size_t CsvReader::find(std::string_view column) const {
  return static_cast<std::size_t>(std::find(header_.begin(), header_.end(), column) - header_.begin());
}

void CsvReader::want(std::vector<std::size_t> columns) {
  wanted_ = std::move(columns);
  numbers_.assign(wanted_.size(), 0);
  kinds_.assign(wanted_.size(), CellKind::empty);
  words_.assign(wanted_.size(), {});
}

void CsvReader::take_words(std::size_t wanted, std::string_view words) { words_[wanted] = split_words(words); }

bool CsvReader::next() {
  std::string_view line;
  if (!read_line(line)) return false;
  const std::size_t most = 2 * header_.size();  // as many as decimal commas would make of it
  split(line, most + 1);
  if (cells_.size() != header_.size())
    refuse(fmt::format("{} cells, where the header names {} columns{}",
                       cells_.size() > most ? fmt::format("more than {}", most) : fmt::format("{}", cells_.size()),
                       header_.size(),
                       format_.delimiter == ',' && cells_.size() > header_.size() && cells_.size() <= most
                           ? "; are there decimal commas? write 0.1, not 0,1"
                       : cells_.size() < header_.size() ? "; every column needs a cell in each row, if an empty one"
                                                        : ""));
  for (std::size_t i = 0; i < wanted_.size(); ++i) {
    const std::string_view cell = cells_[wanted_[i]];
    if (!words_[i].empty() && !cell.empty()) {
      const auto word = std::find(words_[i].begin(), words_[i].end(), cell);
      if (word == words_[i].end())
        refuse(fmt::format("column {}: \"{}\" is not one of {}", excerpt(header_[wanted_[i]]), excerpt(cell),
                           fmt::join(words_[i], ", ")),
               static_cast<std::size_t>(cell.data() - whole_.data()) + 1);
      numbers_[i] = static_cast<double>(word - words_[i].begin());
      kinds_[i] = CellKind::number;
    } else if (!parse_number(cell, numbers_[i], kinds_[i]))
      refuse(fmt::format("column {}: \"{}\" is not a number; write it as 0.1 or 1e-5, without a unit",
                         excerpt(header_[wanted_[i]]), excerpt(cell)),
             static_cast<std::size_t>(cell.data() - whole_.data()) + 1);
  }
  return true;
}

/// A number with a decimal comma counts where commas do not separate the cells; one file has one decimal sign.
bool CsvReader::parse_number(std::string_view given, double& number, CellKind& kind) {
  const bool may_be_comma = format_.or_others && format_.delimiter != ',';
  if (!may_be_comma) return parse(given, number, kind);
  const bool has_comma = has_decimal_comma(given);
  std::string_view cell = given;
  std::string text;
  if (has_comma) {
    text = given;
    text[text.find(',')] = '.';
    cell = text;
  }
  if (!parse(cell, number, kind)) return false;
  if (cell.find('.') == cell.npos) return true;
  const char sign = has_comma ? ',' : '.';
  if (decimal_sign_ == 0) decimal_sign_ = sign, decimal_line_ = line_;
  if (sign != decimal_sign_)
    refuse(
        fmt::format("\"{}\" has a decimal {}, the numbers of line {} a decimal {}; write all with the same sign, and no sign "
                    "between thousands",
                    excerpt(given), has_comma ? "comma" : "point", decimal_line_, has_comma ? "point" : "comma"));
  return true;
}

bool CsvReader::read_line(std::string_view& line) {
  for (;;) {
    const char* start = buffer_.data() + begin_;
    const auto* end = static_cast<const char*>(std::memchr(start, '\n', end_ - begin_));
    if (!end) {
      if (end_ - begin_ > kLongestLine) refuse("a line of more than 16 MiB; is it a CSV file?");
      std::memmove(buffer_.data(), start, end_ - begin_);
      end_ -= begin_;
      begin_ = 0;
      if (buffer_.size() < end_ + kBlock) buffer_.resize(end_ + kBlock);
      const std::size_t got = descriptor_.get() == kNoFile ? 0 : read_some(descriptor_, file_, buffer_.data() + end_, kBlock);
      if (got == 0 && end_ == 0) return false;
      if (got == 0) {
        ++line_;
        refuse("the last line is incomplete, as if writing the file had been interrupted; write the file again");
      }
      end_ += got;
      read_ += got;
      continue;
    }
    ++line_;
    line = std::string_view(start, static_cast<std::size_t>(end - start));
    begin_ += line.size() + 1;
    if (line_ == 1 && line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
    require_text(line);
    const std::string_view content = trimmed(line);
    if (!content.empty() && content.front() != format_.comment) return true;
  }
}

/// Refuses a line that is not UTF-8 text; comments are lines, too.
void CsvReader::require_text(std::string_view line) const {
  if (line_ == 1 && (line.starts_with("\xFF\xFE") || line.starts_with("\xFE\xFF"))) refuse("is UTF-16; save it as UTF-8");
  if (const auto nul = line.find('\0'); nul != line.npos) refuse("a NUL byte; remove it: a table is plain UTF-8 text", nul + 1);
  if (const auto bad = first_invalid_utf8(line); bad != line.npos)
    refuse(fmt::format("byte 0x{:02x} is not valid UTF-8; save the file as UTF-8",
                       static_cast<unsigned>(static_cast<unsigned char>(line[bad]))),
           bad + 1);
}

void CsvReader::split(std::string_view line, std::size_t most) {
  whole_ = line;
  split_cells(line, format_.delimiter, cells_, most);
  for (std::string_view& cell : cells_) cell = trimmed(cell);
}

void CsvReader::refuse(std::string message, std::size_t column) const {
  throw ScenarioError(std::vector<Diagnostic>{{static_cast<int>(std::min<std::uint64_t>(line_, 2147483647)),
                                               static_cast<int>(column), "", std::move(message)}},
                      file_);
}

}  // namespace earthtop::input
