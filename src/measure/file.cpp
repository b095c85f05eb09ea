// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a measured motion from a CSV file.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "earthtop/measure/measurement.hpp"
#include "earthtop/real.hpp"
#include "input/csv_reader.hpp"
#include "input/findings.hpp"
#include "measure/columns.hpp"

namespace earthtop {
namespace measure {
namespace {

using input::CellKind, input::CsvReader;

constexpr input::CsvFormat kFormat = {.or_tabs = true};
constexpr std::uint64_t kMostMeasuredRows = 200'000;
constexpr double kLatestTime_s = 1e9;                               // the longest duration that a scenario may have
constexpr double kNormSlack = 1e-3;                                 // allowed deviation of a measured axis's length from 1
constexpr double kLargestTilt_rad = std::numbers::pi * (1 + 1e-9);  // leaves room for rounding in the file's last digits

class MeasurementReader {
 public:
  explicit MeasurementReader(CsvReader reader) : reader_(std::move(reader)) {
    measurement_.file = reader_.file();
    MeasurementColumns columns = measurement_columns(reader_.header());
    for (std::string& error : columns.errors) refuse_at(1, std::move(error));
    throw_findings();
    reader_.want(std::move(columns.wanted));
    quantities_ = std::move(columns.quantities);
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
      refuse_at(1, "there is no measured value; a row needs a time, a value and its standard error");
    throw_findings();
    return std::move(measurement_);
  }

 private:
  void read_row() {
    const double t_s = reader_.numbers()[0];
    if (reader_.kinds()[0] != CellKind::number || t_s < 0 || t_s > kLatestTime_s) {
      refuse(0, fmt::format("t_s must be a number from 0, the release, to {:g} (s)", kLatestTime_s));
      return;
    }
    if (t_s < latest_s_)
      refuse(0, fmt::format("t_s is earlier than in the row above ({} s); sort the rows by time", latest_s_));
    latest_s_ = std::max(latest_s_, t_s);
    for (const QuantityCells& cells : quantities_)
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
    const double error = reader_.numbers()[cells.error] * cells.error_unit;
    if (reader_.kinds()[cells.error] != CellKind::number || !(error > 0) || !std::isfinite(1 / error)) {
      refuse(cells.error, "a measured value needs a standard error above 0; give it, or leave the value's cell empty");
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
      value.value = reader_.numbers()[cells.value] * cells.value_unit;
      const bool tilts = cells.quantity == MeasuredQuantity::tilt || cells.quantity == MeasuredQuantity::drift_tilt;
      if (tilts && std::abs(value.value) > kLargestTilt_rad) {
        refuse(cells.value, "a tilt is at most 180 deg; is it in another unit?");
        return;
      }
    }
    measurement_.values.push_back(value);
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
  std::vector<QuantityCells> quantities_;
  double latest_s_ = 0;
  std::vector<Diagnostic> findings_;
  std::size_t count_ = 0;
};

}  // namespace
}  // namespace measure

std::string_view to_string(MeasuredQuantity quantity) {
  switch (quantity) {
    case MeasuredQuantity::azimuth: return "azimuth";
    case MeasuredQuantity::tilt: return "tilt";
    case MeasuredQuantity::axis: return "axis";
    case MeasuredQuantity::drift_azimuth: return "drift_azimuth";
    case MeasuredQuantity::drift_tilt: return "drift_tilt";
    case MeasuredQuantity::rotor_rate: return "rotor_rate";
    case MeasuredQuantity::outer_angle: return "outer_angle";
    case MeasuredQuantity::inner_angle: return "inner_angle";
  }
  return "";
}

Measurement read_measurement(const std::string& csv_file) {
  return measure::MeasurementReader(input::CsvReader(csv_file, measure::kFormat)).read();
}

Measurement parse_measurement(const std::string& name, std::string csv) {
  return measure::MeasurementReader(input::CsvReader::of_text(name, std::move(csv), measure::kFormat)).read();
}

}  // namespace earthtop
