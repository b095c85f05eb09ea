// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds the columns of a measurement in a CSV file by their names.
#pragma once

#include <string>
#include <vector>

#include "earthtop/measure/measurement.hpp"

namespace earthtop::measure {

/// The places of a quantity's numbers among the wanted columns, and their units.
struct QuantityCells {
  MeasuredQuantity quantity;
  std::size_t value;  ///< place of the value; for an axis the first of three
  double value_rad;   ///< unit of the value (rad)
  std::size_t error;  ///< place of the standard error
  double error_rad;   ///< unit of the standard error (rad)
};

struct MeasurementColumns {
  std::vector<std::size_t> wanted;  ///< the columns to be read, as places in the header; the time is the first
  std::vector<QuantityCells> quantities;
  std::vector<std::string> errors;  ///< what is wrong with the header, and what is allowed
};

MeasurementColumns measurement_columns(const std::vector<std::string>& header);

}  // namespace earthtop::measure
