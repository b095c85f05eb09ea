// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "earthtop/results/results.hpp"
#include "earthtop/run/each_row.hpp"
#include "earthtop/scenario/support.hpp"
#include "results/columns.hpp"
#include "results/csv.hpp"
#include "results/digits.hpp"

namespace earthtop {
namespace {

/// Whether the file has the columns of an owner.
bool has_columns(const RunResult& result, RowOwner owner) {
  if (!result.rows.empty()) return has_part(result.rows.front(), owner);
  const Scenario& scenario = result.scene.scenario();
  return owner == RowOwner::every_top || (owner == RowOwner::contact   ? scenario.contact.has_value()
                                          : owner == RowOwner::rotor   ? scenario.rotor.has_value()
                                          : owner == RowOwner::journey ? scenario.travel.has_value()
                                                                       : scenario.gimbals.has_value());
}

std::string header(const RunResult& result) {
  std::string text(kTimeColumn);
  for (const Column& column : trajectory_columns())
    if (has_columns(result, column.quantity->owner)) text += ',' + column.name;
  return text + '\n';
}

/// The line of a row, put together in one piece of memory. A file may have millions of rows of some thirty numbers.
class Line {
 public:
  void add(double value) {
    if (std::isfinite(value)) end_ = std::to_chars(end_, end_ + kLongestNumber, value).ptr;
  }
  void add(const std::optional<double>& value) {
    if (value) add(*value);
  }
  void add(bool flag) { add(flag ? 1.0 : 0.0); }
  void add(ContactState state) { end_ = std::ranges::copy(to_string(state), end_).out; }
  void add_char(char c) { *end_++ = c; }
  std::string_view text() const { return {begin_.data(), static_cast<std::size_t>(end_ - begin_.data())}; }

 private:
  static constexpr std::size_t kLongestNumber = 31;  // the longest shortest form of a double has 24 characters
  static constexpr std::size_t kNumbers = [] {
    std::size_t numbers = 1;  // the time
    for (const DriftQuantity& quantity : kDriftQuantities) numbers += quantity.width();
    return numbers;
  }();
  std::array<char, kNumbers*(kLongestNumber + 1)> begin_;
  char* end_ = begin_.data();
};

void append_row(std::string& text, const DriftRow& row) {
  Line line;
  line.add(row.t_s);
  const auto add = [&](const auto& number) {
    line.add_char(',');
    line.add(number);
  };
  const auto add_all = [&](const auto& value) {
    if constexpr (requires { value.size(); })
      for (const double component : value) add(component);
    else
      add(value);
  };
  for_each_drift_quantity([&](auto member, const RowQuantity&) { add_all(member(row)); });
  if (row.contact) for_each_contact_quantity([&](auto member, const RowQuantity&) { add_all(member(*row.contact)); });
  if (row.rotor) for_each_rotor_quantity([&](auto member, const RowQuantity&) { add_all(member(*row.rotor)); });
  if (row.gimbals) for_each_gimbal_quantity([&](auto member, const RowQuantity&) { add_all(member(*row.gimbals)); });
  if (row.journey) for_each_journey_quantity([&](auto member, const RowQuantity&) { add_all(member(*row.journey)); });
  line.add_char('\n');
  text += line.text();
}

/// Appends the line of a row of extended precision. The time is a double in every precision, and is written as one.
void append_row(std::string& text, const ExtendedDriftRow& row, Precision precision) {
  append_number(text, static_cast<double>(row.t_s));
  for (const DriftQuantity& quantity : kDriftQuantities) {
    if (!has_part(row, quantity.owner)) continue;
    for (std::size_t i = 0; i < quantity.width(); ++i) {
      text += ',';
      const auto value = quantity.extended_value(row, i);
      if (!value) continue;
      if (quantity.kind == MeasureKind::word)
        text += word_of(quantity, static_cast<std::size_t>(*value));
      else
        text += digits(*value, precision);
    }
  }
  text += '\n';
}

}  // namespace

void write_trajectory_csv(const RunResult& result, const std::function<void(std::string_view)>& sink, const Watch& watch) {
  CsvPieces csv(header(result), sink);
  if (result.extended_rows.empty())
    each_row(
        result, [&](const DriftRow& row) { csv.add([&](std::string& text) { append_row(text, row); }); }, watch);
  const std::vector<ExtendedDriftRow>& extended = result.extended_rows;
  for (std::size_t i = 0; i < extended.size(); ++i) {
    if (i % 1024 == 0) watch.reach(static_cast<double>(i) / static_cast<double>(extended.size()));
    csv.add([&](std::string& text) { append_row(text, extended[i], result.scene.scenario().precision); });
  }
  csv.flush();
}

std::string trajectory_csv(const RunResult& result) {
  std::string text;
  write_trajectory_csv(result, [&](std::string_view piece) { text += piece; });
  return text;
}

}  // namespace earthtop
