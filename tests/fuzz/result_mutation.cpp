// SPDX-License-Identifier: GPL-3.0-or-later
// Changes of a run's results that leave most of them results: a summary, tables with its number of rows, and checksums that fit.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "fuzz/fixture.hpp"
#include "fuzz/mutation.hpp"
#include "results/seal.hpp"
#include "text/json.hpp"

namespace earthtop::fuzz {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostRows = 60;

/// The lines of a table, the header first, each with its cells.
using Lines = std::vector<std::vector<std::string>>;

std::vector<std::string> split(std::string_view text, char at) {
  std::vector<std::string> pieces;
  for (;;) {
    const std::size_t end = text.find(at);
    pieces.emplace_back(text.substr(0, end));
    if (end == text.npos) return pieces;
    text.remove_prefix(end + 1);
  }
}

Lines lines_of(const std::string& table) {
  Lines lines;
  for (const std::string& line : split(table, '\n'))
    if (!line.empty()) lines.push_back(split(line, ','));
  return lines;
}

std::string text_of(const Lines& lines) {
  std::string table;
  for (const auto& cells : lines) table += fmt::format("{}\n", fmt::join(cells, ","));
  return table;
}

std::string multiplied(const std::string& cell, double factor) {
  char* end = nullptr;
  const double number = std::strtod(cell.c_str(), &end);
  return end == cell.c_str() ? cell : fmt::format("{}", number * factor);
}

/// Changes a column in all of its lines.
void change_column(Lines& lines, Random& random) {
  const std::size_t column = below(random, lines.front().size()), other = below(random, lines.front().size());
  const std::size_t kind = below(random, 6);
  const std::string cell = odd_cell(random);
  const double factor = one_of(random, std::array{-1.0, 0.0, 1e-9, 1e3, 1e200});
  for (std::size_t i = 0; i < lines.size(); ++i) {
    auto& cells = lines[i];
    if (column >= cells.size() || other >= cells.size()) continue;
    switch (kind) {
      case 0: cells.erase(cells.begin() + static_cast<std::ptrdiff_t>(column)); break;
      case 1: std::swap(cells[column], cells[other]); break;
      case 2:
        if (i == 0) std::swap(cells[column], cells[other]);
        break;
      case 3:
        if (i > 0) cells[column] = cell;
        break;
      case 4:
        if (i > 0) cells[column] = multiplied(cells[column], factor);
        break;
      default: cells.push_back(i == 0 ? "another" : cell); break;
    }
  }
}

/// Changes the number or order of the rows. The times still ascend where they are repeated.
void change_rows(Lines& lines, Random& random) {
  const std::size_t rows = lines.size() - 1;
  if (rows == 0) return;
  const std::size_t at = 1 + below(random, rows);
  switch (below(random, 4)) {
    case 0: lines.resize(at); break;
    case 1: lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(at)); break;
    case 2: std::swap(lines[at], lines[1 + below(random, rows)]); break;
    default: {
      const std::size_t count = std::min(kMostRows, rows * (2 + below(random, 10)));
      const double last_s = std::strtod(lines.back().front().c_str(), nullptr);
      for (std::size_t i = rows; i < count; ++i) {
        lines.push_back(lines[1 + i % rows]);
        lines.back().front() = fmt::format("{}", last_s * (1 + static_cast<double>(i - rows + 1) / static_cast<double>(rows)));
      }
    }
  }
}

std::string changed_rows(const std::string& table, Random& random) {
  Lines lines = lines_of(table);
  if (lines.empty() || one_in(random, 8)) return changed_text(table, random);
  switch (below(random, 3)) {
    case 0: change_rows(lines, random); break;
    case 1: change_column(lines, random); break;
    default: {
      auto& cells = lines[below(random, lines.size())];
      cells[below(random, cells.size())] = odd_cell(random);
    }
  }
  return text_of(lines);
}

/// The summary with the number of rows that the trajectory has.
std::string counted(const std::string& summary, const std::string& trajectory) {
  Json json = Json::parse(summary, nullptr, false);
  const std::size_t lines = lines_of(trajectory).size();
  if (!json.is_object() || !json.contains("outcome") || !json["outcome"].is_object() || lines == 0) return summary;
  json["outcome"]["rows"] = lines - 1;
  return written_replacing(json, 2) + "\n";
}

}  // namespace

std::string mutated_results(std::string_view input, std::uint32_t seed) {
  Random random(seed);
  ResultFiles files = result_files_in(input);
  const bool are_sealed = one_in(random, 2);
  files.summary = unsealed(files.summary), files.timing = unsealed(files.timing);
  for (std::size_t times = 1 + below(random, 3); times > 0; --times) switch (below(random, 8)) {
      case 0:
      case 1:
      case 2: files.summary = changed_text(files.summary, random); break;
      case 3:
      case 4: files.trajectory = changed_rows(files.trajectory, random); break;
      case 5: files.torques = files.torques.empty() ? files.trajectory : changed_rows(files.torques, random); break;
      case 6: files.timing = changed_text(files.timing.empty() ? "{}" : files.timing, random); break;
      default: (one_in(random, 2) ? files.torques : files.timing).clear();
    }
  if (!one_in(random, 4)) files.summary = counted(files.summary, files.trajectory);
  return input_of(are_sealed ? with_checksums(files) : files);
}

}  // namespace earthtop::fuzz
