// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds the columns of a measurement in a CSV file by their names.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "earthtop/measure/measurement.hpp"

namespace earthtop::measure {

/// A unit in which a quantity may be measured, by the end of its columns' names.
struct MeasuredUnit {
  std::string_view name;
  double size;  ///< (rad, or rad/s of a rate)
};
std::span<const MeasuredUnit> units_of(MeasuredQuantity quantity);
inline constexpr MeasuredQuantity kAllMeasured[] = {
    MeasuredQuantity::azimuth,    MeasuredQuantity::tilt,       MeasuredQuantity::axis,        MeasuredQuantity::drift_azimuth,
    MeasuredQuantity::drift_tilt, MeasuredQuantity::rotor_rate, MeasuredQuantity::outer_angle, MeasuredQuantity::inner_angle};

/// The places of a quantity's numbers among the wanted columns, and their units.
struct QuantityCells {
  MeasuredQuantity quantity;
  std::size_t value;  ///< place of the value; for an axis the first of three
  double value_unit;  ///< size of the value's unit
  std::size_t error;  ///< place of the standard error
  double error_unit;  ///< the same of the standard error
};

struct MeasurementColumns {
  std::vector<std::size_t> wanted;  ///< the columns to be read, as places in the header; the time is the first
  std::vector<QuantityCells> quantities;
  std::vector<std::string> errors;  ///< what is wrong with the header, and what is allowed
};

MeasurementColumns measurement_columns(const std::vector<std::string>& header);

}  // namespace earthtop::measure
