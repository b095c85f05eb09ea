// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenario/angle_table.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "earthtop/elementary.hpp"
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

/// One unit of the last digit that a number is printed with: 0.01 for "-1.25", 100 for "12e2".
double unit_of_last_digit(std::string_view number) {
  const std::size_t exponent = number.find_first_of("eE"), point = number.find('.');
  int power = 0;
  if (exponent != std::string_view::npos) {
    std::string_view digits = number.substr(exponent + 1);
    if (digits.starts_with('+')) digits.remove_prefix(1);
    std::from_chars(digits.data(), digits.data() + digits.size(), power);
  }
  const std::size_t end = std::min(exponent, number.find_last_not_of(' ') + 1);
  if (point != std::string_view::npos) power -= static_cast<int>(end - point) - 1;
  return real::pow(10.0, static_cast<double>(power));
}

/// Returns the beginning of a text in printable form, because a table may hold any bytes.
std::string shown_text(std::string_view text) { return printable(input::excerpt(text)); }

std::string no_number(std::string_view key, std::string_view field) {
  return fmt::format("{} is \"{}\"; must be a finite number that a double can hold, like -1.25e-3", key, shown_text(field));
}

/// Appends a row. @returns what is wrong with it; empty if it is valid
std::optional<std::string> read_row(std::string_view line, const TableKind& kind, std::vector<AngleTable>& tables) {
  if (line.empty()) return fmt::format("is empty; must be a row \"{}\", or leave it out", kind.header);
  const std::size_t columns = tables.size() + 1;
  std::vector<std::string_view> cells, names;
  input::split_cells(line, ',', cells, columns + 1);
  input::split_cells(kind.header, ',', names, columns);
  if (cells.size() != columns)
    return columns == 2 ? fmt::format("is \"{}\"; must be two numbers with one comma between them", shown_text(line))
                        : fmt::format("is \"{}\"; must be {} numbers with commas between them", shown_text(line), columns);
  std::vector<double> numbers;
  for (std::size_t i = 0; i < columns; ++i) {
    const auto number = finite_number(cells[i]);
    if (!number) return no_number(names[i], cells[i]);
    numbers.push_back(*number);
  }
  const std::vector<double>& times = tables.front().t_s;
  if (!times.empty() && !(numbers[0] > times.back()))
    return fmt::format("t_s is {} after {}; times must ascend, each above the one before", numbers[0], times.back());
  if (kind.circular_column != 0 && !times.empty()) {
    double& angle = numbers[kind.circular_column];
    const double step = angle - tables[kind.circular_column - 1].value.back();
    if (std::abs(step) > 180) angle -= 360 * std::round(step / 360);
  }
  for (std::size_t i = 0; i < tables.size(); ++i)
    tables[i].t_s.push_back(numbers[0]), tables[i].value.push_back(numbers[i + 1]);
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const double unit = unit_of_last_digit(cells[i + 1]);
    double& finest = tables[i].last_digit;
    finest = finest == 0 ? unit : std::min(finest, unit);
  }
  return std::nullopt;
}

/// Says that a table is too fast for what it lists; empty where it is not.
std::optional<std::string> too_fast(const AngleTable& table, const TableKind& kind) {
  const AngleSpline<double> spline(table);
  const double largest_value = std::abs(std::ranges::max(table.value, {}, [](double value) { return std::abs(value); }));
  const double rate = kind.lists_rates ? largest_value : spline.largest_rate();
  const double acceleration = kind.lists_rates ? spline.largest_rate() : spline.largest_acceleration();
  if (rate <= kFastestTurn && acceleration <= kFastestTurn) return std::nullopt;
  return fmt::format(
      "up to here the spline reaches {} {} and {} {}; at most {:g} are allowed: are the times "
      "in seconds and {}?",
      told_apart(rate, kFastestTurn, 3).first, kind.rate_unit, told_apart(acceleration, kFastestTurn, 3).first,
      kind.acceleration_unit, kFastestTurn, kind.in_units);
}

}  // namespace

std::variant<std::vector<AngleTable>, TableFault> parse_tables(std::string_view text, double duration_s,
                                                               const TableKind& kind) {
  const std::string_view header = input::take_line(text);
  if (header != kind.header)
    return TableFault{1,
                      fmt::format("is \"{}\"; must be the header \"{}\", and nothing else", shown_text(header), kind.header)};
  std::vector<AngleTable> tables(static_cast<std::size_t>(std::ranges::count(kind.header, ',')));
  std::size_t line = 1;
  while (!text.empty()) {
    ++line;
    if (auto wrong = read_row(input::take_line(text), kind, tables)) return TableFault{line, *std::move(wrong)};
  }
  const AngleTable& table = tables.front();
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
  for (const AngleTable& one : tables)
    if (auto wrong = too_fast(one, kind)) return TableFault{line, *std::move(wrong)};
  return tables;
}

std::variant<AngleTable, TableFault> parse_angle_table(std::string_view text, double duration_s, const TableKind& kind) {
  auto parsed = parse_tables(text, duration_s, kind);
  if (auto* fault = std::get_if<TableFault>(&parsed)) return std::move(*fault);
  return std::move(std::get<std::vector<AngleTable>>(parsed).front());
}

}  // namespace earthtop::scenario
