// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a measured motion from a CSV file.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "earthtop/measure/measurement.hpp"
#include "earthtop/real.hpp"
#include "input/csv_reader.hpp"
#include "input/findings.hpp"
#include "input/node.hpp"
#include "measure/columns.hpp"
#include "measure/quantities.hpp"

namespace earthtop {
namespace measure {
namespace {

using input::CellKind, input::CsvReader;

constexpr input::CsvFormat kFormat = {.or_others = true};
constexpr std::uint64_t kMostMeasuredRows = 200'000;
constexpr double kMostTurns = 1e9;
constexpr double kLatestTime_s = 1e9;                               // the longest duration that a scenario may have
constexpr double kNormSlack = 1e-3;                                 // allowed deviation of a measured axis's length from 1
constexpr double kLargestTilt_rad = std::numbers::pi * (1 + 1e-9);  // leaves room for rounding in the file's last digits

class MeasurementReader {
 public:
  MeasurementReader(CsvReader reader, const MeasurementFormat& format)
      : reader_(std::move(reader)), offset_s_(format.time_offset_s) {
    if (!(std::abs(offset_s_) <= kLatestTime_s))
      throw ScenarioError("--time-offset", fmt::format("must be a time of at most {:g} (s)", kLatestTime_s));
    measurement_.file = reader_.file();
    columns_ = measurement_columns(reader_.header(), format);
    for (std::string& error : columns_.errors) refuse_at(1, std::move(error));
    throw_findings();
    reader_.want(columns_.wanted);
    if (columns_.extreme) reader_.take_words(*columns_.extreme, kExtremeWords);
    note_columns();
  }

  Measurement read() && {
    while (reader_.next()) {
      if (++measurement_.rows > kMostMeasuredRows) {
        refuse(0, fmt::format("more than {} rows; average neighbouring ones", kMostMeasuredRows));
        break;
      }
      read_row();
    }
    if (measurement_.values.empty() && count_ == 0)
      refuse_at(1, early_ > 0 ? fmt::format("all rows are before the release, which --time-offset puts at {:g} s", offset_s_)
                              : "there is no measured value; a row needs a time, a value and its standard error");
    throw_findings();
    if (early_ > 0)
      measurement_.notes.push_back(fmt::format("{} row{} left out: before the release, {:.6g} s by the clock of the file",
                                               early_, early_ == 1 ? " is" : "s are", offset_s_));
    std::ranges::stable_sort(measurement_.values, {}, &MeasuredValue::t_s);
    return std::move(measurement_);
  }

 private:
  const std::string& time_name() const { return reader_.header()[columns_.wanted[*columns_.time]]; }

  void note_columns() {
    if (columns_.left_out.empty()) return;
    constexpr std::size_t kShown = 12;
    std::vector<std::string> shown;
    for (const std::string& name : columns_.left_out)
      if (shown.size() < kShown) shown.push_back(fmt::format("\"{}\"", input::excerpt(name)));
    const std::size_t more = columns_.left_out.size() - shown.size();
    measurement_.notes.push_back(fmt::format("column{} not read: {}{}", columns_.left_out.size() == 1 ? "" : "s",
                                             fmt::join(shown, ", "), more > 0 ? fmt::format(" and {} more", more) : ""));
  }

  void read_row() {
    if (!columns_.time) {
      for (const QuantityCells& cells : columns_.quantities)
        if (is_measured(cells)) read_value(cells, reader_.numbers()[cells.value] - offset_s_);
      return;
    }
    const double t_s = reader_.numbers()[*columns_.time] * columns_.time_unit_s - offset_s_;
    if (reader_.kinds()[*columns_.time] != CellKind::number || (t_s < 0 && offset_s_ == 0) || t_s > kLatestTime_s) {
      refuse(*columns_.time,
             fmt::format("{} must be a number from 0, the release, to {:g} (s){}", time_name(), kLatestTime_s,
                         t_s < 0 ? "; if the clock shows another time at the release, say --time-offset T" : ""));
      return;
    }
    if (t_s < latest_s_)
      refuse(*columns_.time, fmt::format("{} is earlier than in the row above ({} s); sort the rows by time", time_name(),
                                         latest_s_ + offset_s_));
    if (t_s < 0) {
      ++early_;
      return;
    }
    latest_s_ = std::max(latest_s_, t_s);
    for (const QuantityCells& cells : columns_.quantities)
      if (is_measured(cells)) read_value(cells, t_s);
  }

  /// Whether the row has all the quantity's numbers. Refuses a row that has only some of them, or one that is not finite.
  bool is_measured(const QuantityCells& cells) {
    const std::size_t numbers = cells.quantity == MeasuredQuantity::axis ? 3 : 1;
    std::size_t there = 0;
    for (std::size_t i = cells.value; i < cells.value + numbers; ++i) {
      if (reader_.kinds()[i] == CellKind::not_finite) {
        refuse(i, "a measured value must be a finite number; leave the cell empty where nothing was measured");
        return false;
      }
      if (reader_.kinds()[i] == CellKind::number) ++there;
    }
    if (there > 0 && there < numbers)
      refuse(cells.value, "only one or two of an axis's three components are given; give all or none");
    return there == numbers;
  }

  void read_value(const QuantityCells& cells, double t_s) {
    const double error = cells.error ? reader_.numbers()[*cells.error] * cells.error_unit : cells.error_unit;
    if (cells.error && (reader_.kinds()[*cells.error] != CellKind::number || !(error > 0) || !std::isfinite(1 / error))) {
      refuse(*cells.error, "a measured value needs a standard error above 0; give it, or leave the value's cell empty");
      return;
    }
    MeasuredValue value{cells.quantity, t_s, 0, {}, error, reader_.line()};
    if (cells.quantity == MeasuredQuantity::axis) {
      const auto n = reader_.numbers().subspan(cells.value, 3);
      const double length = real::hypot(n[0], n[1], n[2]);
      if (!(std::abs(length - 1) <= kNormSlack)) {
        refuse(cells.value, fmt::format("an axis is a unit vector; this one has the length {:g}", length));
        return;
      }
      value.axis_L = {n[0] / length, n[1] / length, n[2] / length};
    } else {
      value.value = cells.value_is(reader_.numbers()[cells.value]);
      if (!is_possible(cells, value)) return;
    }
    measurement_.values.push_back(value);
  }

  /// Refuses a value that no top can have, and fills in what belongs to a turning point or a passage.
  bool is_possible(const QuantityCells& cells, MeasuredValue& value) {
    const QuantityRow& row = row_of(cells.quantity);
    const std::string_view angle = row_of(row.of).name;
    if ((angle == "tilt" || angle == "drift_tilt" || angle == "swing_major" || angle == "swing_minor") &&
        std::abs(value.value) > kLargestTilt_rad) {
      refuse(cells.value,
             fmt::format("a {} is at most 180 deg; is it in another unit?", angle.starts_with("swing") ? "semi-axis" : "tilt"));
      return false;
    }
    if (row.feature == Feature::turning && columns_.extreme && reader_.kinds()[*columns_.extreme] == CellKind::number) {
      const bool is_largest = (reader_.numbers()[*columns_.extreme] == 0) == (cells.value_is.size > 0);
      value.extreme = is_largest ? Extreme::maximum : Extreme::minimum;
    }
    if (row.feature == Feature::passage) {
      value.value -= offset_s_;
      if (columns_.turns && reader_.kinds()[*columns_.turns] == CellKind::number)
        value.turns = reader_.numbers()[*columns_.turns];
      if (value.turns < 0 || value.turns > kMostTurns) {
        refuse(*columns_.turns,
               fmt::format("must be above 0, and at most {:g}: how often the azimuth has gone round since the release",
                           kMostTurns));
        return false;
      }
    }
    if (row.dimension == Dimension::duration && !(value.value > 0 && value.value <= kLatestTime_s)) {
      refuse(cells.value, fmt::format("must be a time above 0, and at most {:g} (s){}", kLatestTime_s,
                                      row.feature == Feature::passage ? ", after the release" : ""));
      return false;
    }
    return true;
  }

  void refuse(std::size_t wanted, std::string message) { refuse_at(reader_.column(wanted), std::move(message)); }
  void refuse_at(std::size_t column, std::string message) {
    if (++count_ > input::kMostDiagnostics) return;
    findings_.push_back({static_cast<int>(reader_.line()), static_cast<int>(column), "", std::move(message)});
  }
  void throw_findings() {
    if (count_ == 0) return;
    if (count_ > input::kMostDiagnostics)
      findings_.push_back({static_cast<int>(reader_.line()), 1, "",
                           fmt::format("{} more errors are not shown", count_ - input::kMostDiagnostics)});
    throw ScenarioError(std::move(findings_), reader_.file());
  }

  CsvReader reader_;
  Measurement measurement_;
  MeasurementColumns columns_;
  double offset_s_;  // what the clock shows at the release
  double latest_s_ = -HUGE_VAL;
  std::uint64_t early_ = 0;  // rows before the release
  std::vector<Diagnostic> findings_;
  std::size_t count_ = 0;
};

}  // namespace
}  // namespace measure

Measurement read_measurement(const std::string& csv_file, const MeasurementFormat& format) {
  return measure::MeasurementReader(input::CsvReader(csv_file, measure::kFormat), format).read();
}

Measurement parse_measurement(const std::string& name, std::string csv, const MeasurementFormat& format) {
  return measure::MeasurementReader(input::CsvReader::of_text(name, std::move(csv), measure::kFormat), format).read();
}

}  // namespace earthtop
