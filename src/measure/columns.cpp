// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/columns.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <numbers>
#include <optional>

#include "input/findings.hpp"
#include "input/node.hpp"
#include "input/suggest.hpp"

namespace earthtop::measure {
namespace {

constexpr MeasuredUnit kAngleUnits[] = {
    {"rad", 1}, {"deg", std::numbers::pi / 180}, {"arcsec", std::numbers::pi / (180 * 3600.0)}};
constexpr MeasuredUnit kRateUnits[] = {{"rad_s", 1}, {"rpm", std::numbers::pi / 30}};
constexpr std::string_view kAxisColumns[] = {"axis_L_x", "axis_L_y", "axis_L_z"};
constexpr std::string_view kAllowedColumns =
    "allowed are t_s; azimuth, tilt, drift_azimuth, drift_tilt, outer_angle and inner_angle, each as azimuth_rad, azimuth_deg "
    "or "
    "azimuth_arcsec with azimuth_se_rad, _deg or _arcsec; axis_L_x, axis_L_y, axis_L_z with axis_se_rad, _deg or _arcsec; "
    "rotor_rate_rad_s or "
    "rotor_rate_rpm with rotor_rate_se_rad_s or _rpm; and names that begin with _, which are skipped";

struct Column {
  std::size_t place;  // place in the header
  double unit;        // its size
};

/// The names of a quantity's columns in all units: "azimuth_rad, azimuth_deg or azimuth_arcsec"
std::string in_all_units(MeasuredQuantity quantity, const std::string& stem) {
  std::string names;
  const auto units = units_of(quantity);
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (i > 0) names += i + 1 == units.size() ? " or " : ", ";
    names += fmt::format("{}_{}", stem, units[i].name);
  }
  return names;
}

bool is_number(const std::string& name) {
  double number = 0;
  const char* const end = name.data() + name.size();
  return std::from_chars(name.data(), end, number).ptr == end;
}

class HeaderReader {
 public:
  explicit HeaderReader(const std::vector<std::string>& header) : header_(header) {}

  MeasurementColumns read() && {
    if (header_.size() == 1 && header_.front().find(';') != std::string::npos) {
      columns_.errors.emplace_back(
          "semicolons separate these columns, as spreadsheets write them where the comma is the decimal sign; separate them by "
          "commas or tabs, and write decimal points: 0.1, not 0,1");
      return std::move(columns_);
    }
    refuse_unknown_columns();
    if (!columns_.errors.empty()) return std::move(columns_);  // a misspelled column is not missing as well
    if (const auto time = find("t_s"))
      want(*time);
    else
      columns_.errors.emplace_back("there is no column t_s, the time since the release (s)");
    for (const MeasuredQuantity quantity : kAllMeasured) read_quantity(quantity);
    if (columns_.quantities.empty() && columns_.errors.empty())
      columns_.errors.push_back(fmt::format("there is no measured quantity; {}", kAllowedColumns));
    return std::move(columns_);
  }

 private:
  void refuse_unknown_columns() {
    std::vector<std::string> names = {"t_s"};
    for (const MeasuredQuantity quantity : kAllMeasured)
      for (const MeasuredUnit& unit : units_of(quantity)) {
        if (quantity != MeasuredQuantity::axis) names.push_back(fmt::format("{}_{}", to_string(quantity), unit.name));
        names.push_back(fmt::format("{}_se_{}", to_string(quantity), unit.name));
      }
    names.insert(names.end(), std::begin(kAxisColumns), std::end(kAxisColumns));
    const std::vector<std::string_view> candidates(names.begin(), names.end());
    if (std::ranges::all_of(header_, is_number)) {
      columns_.errors.emplace_back("the first line has numbers; it must name the columns, as t_s,azimuth_deg,azimuth_se_deg");
      return;
    }
    for (const std::string& name : header_) {
      if (name.starts_with('_') || std::find(names.begin(), names.end(), name) != names.end()) continue;
      if (columns_.errors.size() >= input::kMostDiagnostics) {  // it is counted, and not shown
        columns_.errors.emplace_back();
        continue;
      }
      const auto meant = input::suggest(name, candidates);
      columns_.errors.push_back(fmt::format("unknown column \"{}\"; {}{}", input::excerpt(name), kAllowedColumns,
                                            meant ? fmt::format("; did you mean \"{}\"?", *meant) : ""));
    }
  }

  void read_quantity(MeasuredQuantity quantity) {
    const std::string name(to_string(quantity));
    const bool is_axis = quantity == MeasuredQuantity::axis;
    const std::optional<Column> error = find_in_a_unit(quantity, name + "_se");
    const std::optional<Column> value = is_axis ? find_axis() : find_in_a_unit(quantity, name);
    if (value && !error)
      columns_.errors.push_back(fmt::format("{} has no standard error; give {}", name, in_all_units(quantity, name + "_se")));
    if (error && !value && !is_axis)
      columns_.errors.push_back(
          fmt::format("{} is given without a column {}", header_[error->place], in_all_units(quantity, name)));
    if (error && !value && is_axis)
      columns_.errors.push_back(header_[error->place] + " is given without all of axis_L_x, axis_L_y, axis_L_z");
    if (!value || !error) return;
    QuantityCells cells{quantity, want(value->place), value->unit, 0, error->unit};
    if (is_axis)
      for (const std::string_view column : {kAxisColumns[1], kAxisColumns[2]}) want(*find(column));
    cells.error = want(error->place);
    columns_.quantities.push_back(cells);
  }

  std::optional<std::size_t> find(std::string_view name) const {
    const auto at = std::find(header_.begin(), header_.end(), name);
    if (at == header_.end()) return std::nullopt;
    return static_cast<std::size_t>(at - header_.begin());
  }

  /// The column of this quantity, in any unit. Reports an error if there are two.
  std::optional<Column> find_in_a_unit(MeasuredQuantity quantity, const std::string& stem) {
    std::optional<Column> found;
    for (const MeasuredUnit& unit : units_of(quantity)) {
      const std::string name = fmt::format("{}_{}", stem, unit.name);
      const auto place = find(name);
      if (!place) continue;
      if (found)
        columns_.errors.push_back(
            fmt::format("columns {} and {} give the same quantity in two units; keep one", header_[found->place], name));
      found = Column{*place, unit.size};
    }
    return found;
  }

  std::optional<Column> find_axis() const {
    for (const std::string_view column : kAxisColumns)
      if (!find(column)) return std::nullopt;
    return Column{*find(kAxisColumns[0]), 1};
  }

  std::size_t want(std::size_t place) {
    columns_.wanted.push_back(place);
    return columns_.wanted.size() - 1;
  }

  const std::vector<std::string>& header_;
  MeasurementColumns columns_;
};

}  // namespace

std::span<const MeasuredUnit> units_of(MeasuredQuantity quantity) {
  if (quantity == MeasuredQuantity::rotor_rate) return kRateUnits;
  return kAngleUnits;
}

MeasurementColumns measurement_columns(const std::vector<std::string>& header) { return HeaderReader(header).read(); }

}  // namespace earthtop::measure
