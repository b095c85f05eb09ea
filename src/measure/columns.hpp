// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds the columns of a measurement in a CSV file by their names.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "earthtop/measure/measurement.hpp"

namespace earthtop::measure {

/// A number of the file as the one that is meant: size * number + zero.
struct Conversion {
  double size = 1;
  double zero = 0;
  double operator()(double number) const { return size * number + zero; }
};

/// The places of a quantity's numbers among the wanted columns, and their units.
struct QuantityCells {
  MeasuredQuantity quantity;
  std::size_t value;                      ///< place of the value; for an axis the first of three
  Conversion value_is;                    ///< what the value means, in rad, rad/s, m or s
  std::optional<std::size_t> error = {};  ///< place of the standard error
  double error_unit = 1;                  ///< size of its unit; without a place the standard error itself
};

struct MeasurementColumns {
  std::vector<std::size_t> wanted;  ///< the columns to be read, as places in the header
  std::optional<std::size_t> time;  ///< place of the time among them; none where only passages were timed
  double time_unit_s = 1;
  std::optional<std::size_t> extreme;  ///< place of the word on turning points
  std::optional<std::size_t> turns;    ///< place of the number of turns of passages
  std::vector<QuantityCells> quantities;
  std::vector<std::string> left_out;  ///< names of columns that nothing reads
  std::vector<std::string> errors;    ///< what is wrong with the header, and what is allowed
};
inline constexpr std::string_view kExtremeWords = "max|min";  // in the order of Extreme, without the first

/// @throws ScenarioError for a format that cannot be understood, or does not fit the header
MeasurementColumns measurement_columns(const std::vector<std::string>& header, const MeasurementFormat& format);

}  // namespace earthtop::measure
