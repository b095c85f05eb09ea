// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenario/angle_table.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "earthtop/error.hpp"
#include "earthtop/frames/angle_spline.hpp"
#include "input/csv_text.hpp"
#include "input/node.hpp"
#include "text/number_words.hpp"

namespace earthtop::scenario {
namespace {

constexpr std::size_t kFewestRows = 4;  // required by a not-a-knot spline
/// Largest rate and acceleration of a table (rad/s, rad/s^2), the same limit as for motions without one.
constexpr double kFastestTurn = 1e9;

/// Returns the number that a whole cell holds; empty unless it is finite and fits a double.
std::optional<double> finite_number(std::string_view cell) {
  const input::CellNumber number = input::cell_number(cell);
  return number.fits_a_double && std::isfinite(number.value) ? std::optional(number.value) : std::nullopt;
}

/// Returns the beginning of a text in printable form, because a table may hold any bytes.
std::string shown_text(std::string_view text) { return printable(input::excerpt(text)); }

std::string no_number(std::string_view key, std::string_view field) {
  return fmt::format("{} is \"{}\"; must be a finite number that a double can hold, like -1.25e-3", key, shown_text(field));
}

/// Appends a row. @returns what is wrong with it; empty if it is valid
std::optional<std::string> read_row(std::string_view line, const TableKind& kind, AngleTable& table) {
  if (line.empty()) return fmt::format("is empty; must be a row \"{}\", or leave it out", kind.header);
  std::vector<std::string_view> cells;
  input::split_cells(line, ',', cells, 3);
  if (cells.size() != 2) return fmt::format("is \"{}\"; must be two numbers with one comma between them", shown_text(line));
  const auto time = finite_number(cells[0]), value = finite_number(cells[1]);
  if (!time) return no_number("t_s", cells[0]);
  if (!value) return no_number(kind.column(), cells[1]);
  if (!table.t_s.empty() && !(*time > table.t_s.back()))
    return fmt::format("t_s is {} after {}; times must ascend, each above the one before", *time, table.t_s.back());
  table.t_s.push_back(*time);
  table.value.push_back(*value);
  return std::nullopt;
}

}  // namespace

std::variant<AngleTable, TableFault> parse_angle_table(std::string_view text, double duration_s, const TableKind& kind) {
  const std::string_view header = input::take_line(text);
  if (header != kind.header)
    return TableFault{1,
                      fmt::format("is \"{}\"; must be the header \"{}\", and nothing else", shown_text(header), kind.header)};
  AngleTable table;
  std::size_t line = 1;
  while (!text.empty()) {
    ++line;
    if (auto wrong = read_row(input::take_line(text), kind, table)) return TableFault{line, *std::move(wrong)};
  }
  if (table.t_s.size() < kFewestRows)
    return TableFault{line,
                      fmt::format("the table ends after {} rows; a spline needs at least {}", table.t_s.size(), kFewestRows)};
  if (table.t_s.front() > 0)
    return TableFault{2,
                      fmt::format("the table begins at {} s; it must begin at 0 s, the release, or before", table.t_s.front())};
  if (table.t_s.back() < duration_s)
    return TableFault{line, fmt::format("the table ends at {} s; it must reach the duration, {} s: add rows, or shorten "
                                        "/motion/duration_s",
                                        table.t_s.back(), duration_s)};
  const AngleSpline<double> spline(table);
  const double largest_value = std::abs(std::ranges::max(table.value, {}, [](double value) { return std::abs(value); }));
  const double rate = kind.lists_rates ? largest_value : spline.largest_rate();
  const double acceleration = kind.lists_rates ? spline.largest_rate() : spline.largest_acceleration();
  if (!(rate <= kFastestTurn && acceleration <= kFastestTurn))
    return TableFault{
        line, fmt::format("up to here the spline reaches {} rad/s and {} rad/s^2; at most {:g} are allowed: are the times "
                          "in seconds and {}?",
                          told_apart(rate, kFastestTurn, 3).first, told_apart(acceleration, kFastestTurn, 3).first,
                          kFastestTurn, kind.in_units)};
  return table;
}

}  // namespace earthtop::scenario
