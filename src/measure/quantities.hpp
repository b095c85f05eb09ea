// SPDX-License-Identifier: GPL-3.0-or-later
/// The table of the quantities that can be measured: their names, units and words, and which part of a motion each of them is.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "earthtop/measure/measurement.hpp"

namespace earthtop::measure {

/// The kind of number that a quantity is: the units follow from it.
enum class Dimension : std::uint8_t { angle, rate, length, duration };

/// A unit in which a quantity may be measured, by the end of its columns' names.
struct MeasuredUnit {
  std::string_view name;
  double size;  ///< (rad, rad/s, m or s)
};

/// How a quantity is taken from a motion.
enum class Feature : std::uint8_t {
  value,    ///< its value at the row's time
  turning,  ///< its extreme next to the row's time
  period,   ///< the time from the row's time on in which the azimuth goes round once
  passage   ///< the time at which the azimuth has gone round a number of times
};

struct QuantityRow {
  MeasuredQuantity quantity;
  std::string_view name;  ///< the beginning of its columns' names
  Dimension dimension;
  double period;        ///< values that differ by this are the same; 0: none are (rad)
  const char* spoken;   ///< as a picture calls it
  const char* missing;  ///< why a scenario may not have it, and what to do
  Feature feature = Feature::value;
  MeasuredQuantity of = quantity;       ///< of a turning point: the quantity that turns
  double CurvePoint::*shown = nullptr;  ///< its number in a curve's point; null: it is among the others
};

std::span<const QuantityRow> quantity_rows();
const QuantityRow& row_of(MeasuredQuantity quantity);
/// The row of a residual's quantity; those of an axis have that of the angle.
const QuantityRow& row_of(std::string_view residual_quantity);
/// The name of a residual's quantity as long as the program lives; empty if it is none.
std::string_view residual_quantity(std::string_view name);

std::span<const MeasuredUnit> units_of(MeasuredQuantity quantity);
std::string_view unit_of(Dimension dimension);  ///< "rad", "rad_s", "m" or "s": that of the numbers of a residual
/// How much of a quantity makes as much of a difference to a motion as a radian of an angle, roughly: a rad/s, a centimetre, a second.
constexpr double size_of(Dimension dimension) { return dimension == Dimension::length ? 0.01 : 1; }
std::string_view spoken_unit(Dimension dimension);  ///< "rad", "rad/s", "m" or "s"

/// The number of a quantity in a point of a curve; NaN where it has none.
double shown(const CurvePoint& point, const QuantityRow& row);
void show(CurvePoint& point, const QuantityRow& row, double value);

/// The names of all columns with values, in their units: "azimuth_rad, azimuth_deg, ...". Those of an axis are its three components.
std::vector<std::string> value_columns();
/// The quantities with their units, in a sentence: "azimuth, tilt ... with _rad, _deg or _arcsec; ..."
std::string quantities_in_words();

}  // namespace earthtop::measure
