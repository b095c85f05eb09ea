// SPDX-License-Identifier: GPL-3.0-or-later
/// Reads the document of a comparison with a measurement.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "earthtop/measure/measurement.hpp"

namespace earthtop::measure {

/// The figures need these parts of a document of `measurement_json`: names, residuals, correlation time and curve.
/// @throws nlohmann::json::exception where it is no such document
MeasurementReport measurement_of(const nlohmann::ordered_json& document);

}  // namespace earthtop::measure
