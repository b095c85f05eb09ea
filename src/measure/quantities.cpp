// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/quantities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>

namespace earthtop {
namespace measure {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr MeasuredUnit kAngleUnits[] = {{"rad", 1}, {"deg", kTurn / 360}, {"arcsec", kTurn / (360 * 3600.0)}};
constexpr MeasuredUnit kRateUnits[] = {{"rad_s", 1}, {"rpm", kTurn / 60}, {"deg_s", kTurn / 360}};
constexpr MeasuredUnit kLengthUnits[] = {{"m", 1}, {"mm", 1e-3}};
constexpr MeasuredUnit kDurationUnits[] = {{"s", 1}};

constexpr const char* kAlways = "";
constexpr const char* kNoRotor = "the scenario has no rotor; give it /rotor";
constexpr const char* kNoGimbals = "the scenario has no gimbals; give it /gimbals";
constexpr const char* kNoTable = "the top does not stand on a table; give it /contact";
constexpr const char* kNoSwing =
    "only a symmetric body on a pivot that swings below it, and does not go round in a circle, has such an ellipse";
constexpr const char* kNoTurning = "there is no turning point near this time";
constexpr const char* kNoPassage = "the azimuth of the axis does not go round within sixteen times that time";

using enum MeasuredQuantity;

constexpr QuantityRow kRows[] = {
    {azimuth, "azimuth", Dimension::angle, kTurn, "Azimuth", kAlways, Feature::value, azimuth, &CurvePoint::azimuth_rad},
    {tilt, "tilt", Dimension::angle, 0, "Tilt", kAlways, Feature::value, tilt, &CurvePoint::tilt_rad},
    {axis, "axis", Dimension::angle, 0, "Axis", kAlways},
    {drift_azimuth, "drift_azimuth", Dimension::angle, kTurn, "Drift in azimuth", kAlways, Feature::value, drift_azimuth,
     &CurvePoint::drift_azimuth_rad},
    {drift_tilt, "drift_tilt", Dimension::angle, 0, "Drift in tilt", kAlways, Feature::value, drift_tilt,
     &CurvePoint::drift_tilt_rad},
    {rotor_rate, "rotor_rate", Dimension::rate, 0, "Rate of the rotor", kNoRotor, Feature::value, rotor_rate,
     &CurvePoint::rotor_rate_rad_s},
    {outer_angle, "outer_angle", Dimension::angle, 0, "Angle of the outer gimbal", kNoGimbals, Feature::value, outer_angle,
     &CurvePoint::outer_angle_rad},
    {inner_angle, "inner_angle", Dimension::angle, 0, "Angle of the inner gimbal", kNoGimbals, Feature::value, inner_angle,
     &CurvePoint::inner_angle_rad},
    {spin, "spin", Dimension::rate, 0, "Spin", kAlways},
    {w_LB_B_x, "w_LB_B_x", Dimension::rate, 0, "Rate about body axis 1, in the laboratory", kAlways},
    {w_LB_B_y, "w_LB_B_y", Dimension::rate, 0, "Rate about body axis 2, in the laboratory", kAlways},
    {w_LB_B_z, "w_LB_B_z", Dimension::rate, 0, "Rate about body axis 3, in the laboratory", kAlways},
    {w_IB_B_x, "w_IB_B_x", Dimension::rate, 0, "Inertial rate about body axis 1", kAlways},
    {w_IB_B_y, "w_IB_B_y", Dimension::rate, 0, "Inertial rate about body axis 2", kAlways},
    {w_IB_B_z, "w_IB_B_z", Dimension::rate, 0, "Inertial rate about body axis 3", kAlways},
    {tip_L_x, "tip_L_x", Dimension::length, 0, "Tip to East", kNoTable},
    {tip_L_y, "tip_L_y", Dimension::length, 0, "Tip to North", kNoTable},
    {swing_azimuth, "swing_azimuth", Dimension::angle, kTurn / 2, "Azimuth of the swing's plane", kNoSwing},
    {swing_major, "swing_major", Dimension::angle, 0, "Major semi-axis of the swing", kNoSwing},
    {swing_minor, "swing_minor", Dimension::angle, 0, "Minor semi-axis of the swing", kNoSwing},
    {azimuth_turning, "azimuth_turning", Dimension::angle, kTurn, "Turning point in azimuth", kNoTurning, Feature::turning,
     azimuth},
    {tilt_turning, "tilt_turning", Dimension::angle, 0, "Turning point in tilt", kNoTurning, Feature::turning, tilt},
    {outer_angle_turning, "outer_angle_turning", Dimension::angle, 0, "Turning point of the outer gimbal", kNoTurning,
     Feature::turning, outer_angle},
    {inner_angle_turning, "inner_angle_turning", Dimension::angle, 0, "Turning point of the inner gimbal", kNoTurning,
     Feature::turning, inner_angle},
    {precession_period, "precession_period", Dimension::duration, 0, "Time of a turn of the axis", kNoPassage, Feature::period},
    {passage, "passage", Dimension::duration, 0, "Time of a passage", kNoPassage, Feature::passage},
};

constexpr bool is_in_order() {
  for (std::size_t k = 0; k < std::size(kRows); ++k)
    if (kRows[k].quantity != static_cast<MeasuredQuantity>(k)) return false;
  return std::size(kRows) == kMeasuredQuantities;
}
static_assert(is_in_order());

/// The residuals of an axis, whose angles are azimuths and tilts.
struct AxisResidual {
  std::string_view name;
  MeasuredQuantity angle;
};
constexpr AxisResidual kAxisResiduals[] = {{"axis_azimuth", azimuth}, {"axis_tilt", tilt}};

std::span<const MeasuredUnit> units_of(Dimension dimension) {
  switch (dimension) {
    case Dimension::angle: return kAngleUnits;
    case Dimension::rate: return kRateUnits;
    case Dimension::length: return kLengthUnits;
    case Dimension::duration: return kDurationUnits;
  }
  return {};
}

/// "a, b or c"
std::string in_words(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) text += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + names[i];
  return text;
}

}  // namespace

std::span<const QuantityRow> quantity_rows() { return kRows; }
const QuantityRow& row_of(MeasuredQuantity quantity) { return kRows[static_cast<std::size_t>(quantity)]; }

const QuantityRow& row_of(std::string_view residual_quantity) {
  for (const AxisResidual& one : kAxisResiduals)
    if (one.name == residual_quantity) return row_of(one.angle);
  const auto row = std::ranges::find(kRows, residual_quantity, &QuantityRow::name);
  return row == std::end(kRows) ? kRows[0] : *row;
}

std::string_view residual_quantity(std::string_view name) {
  for (const AxisResidual& one : kAxisResiduals)
    if (one.name == name) return one.name;
  const auto row = std::ranges::find(kRows, name, &QuantityRow::name);
  return row == std::end(kRows) || row->quantity == axis ? std::string_view() : row->name;
}

std::span<const MeasuredUnit> units_of(MeasuredQuantity quantity) { return units_of(row_of(quantity).dimension); }
std::string_view unit_of(Dimension dimension) { return units_of(dimension)[0].name; }
std::string_view spoken_unit(Dimension dimension) { return dimension == Dimension::rate ? "rad/s" : unit_of(dimension); }

double shown(const CurvePoint& point, const QuantityRow& row) {
  if (row.shown) return point.*row.shown;
  const auto place = static_cast<std::size_t>(row.feature == Feature::turning ? row.of : row.quantity);
  if (row.feature == Feature::turning && row_of(row.of).shown) return point.*row_of(row.of).shown;
  return place < point.others.size() ? point.others[place] : std::numeric_limits<double>::quiet_NaN();
}

void show(CurvePoint& point, const QuantityRow& row, double value) {
  if (row.shown) {
    point.*row.shown = value;
    return;
  }
  if (point.others.empty()) point.others.assign(kMeasuredQuantities, std::numeric_limits<double>::quiet_NaN());
  point.others[static_cast<std::size_t>(row.quantity)] = value;
}

std::vector<std::string> value_columns() {
  std::vector<std::string> names;
  for (const QuantityRow& row : kRows) {
    if (row.quantity == axis) {
      for (const char* component : {"axis_L_x", "axis_L_y", "axis_L_z"}) names.emplace_back(component);
      continue;
    }
    for (const MeasuredUnit& unit : units_of(row.dimension)) names.push_back(fmt::format("{}_{}", row.name, unit.name));
  }
  return names;
}

std::string quantities_in_words() {
  std::string text;
  for (const Dimension dimension : {Dimension::angle, Dimension::rate, Dimension::length, Dimension::duration}) {
    std::vector<std::string> names, units;
    for (const QuantityRow& row : kRows)
      if (row.dimension == dimension) names.emplace_back(row.name);
    for (const MeasuredUnit& unit : units_of(dimension)) units.push_back(fmt::format("_{}", unit.name));
    text += fmt::format("{}{} with {}", text.empty() ? "" : "; ", in_words(names), in_words(units));
  }
  return text;
}

}  // namespace measure

std::string_view to_string(MeasuredQuantity quantity) { return measure::row_of(quantity).name; }

}  // namespace earthtop
