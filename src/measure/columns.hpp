// SPDX-License-Identifier: GPL-3.0-or-later
/// Which columns of a CSV file are a measurement's, by their names.
#pragma once

#include <string>
#include <vector>

#include "earthtop/measure/measurement.hpp"

namespace earthtop::measure {

/// Where a quantity's numbers are among the wanted ones, and in which units.
struct QuantityCells {
  MeasuredQuantity quantity;
  std::size_t value;  ///< the first of three of an axis
  double value_rad;
  std::size_t error;  ///< its standard error
  double error_rad;
};

struct MeasurementColumns {
  std::vector<std::size_t> wanted;  ///< places in the header; the time is the first
  std::vector<QuantityCells> quantities;
  std::vector<std::string> errors;  ///< what is wrong with the header, and what is allowed
};

MeasurementColumns measurement_columns(const std::vector<std::string>& header);

}  // namespace earthtop::measure
