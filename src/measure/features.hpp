// SPDX-License-Identifier: GPL-3.0-or-later
/// Turning points, periods and passages of a predicted motion: what is measured of it that is no value at a given time.
#pragma once

#include <optional>

#include "measure/measured_motion.hpp"

namespace earthtop::measure {

bool has_features(const Measurement& measurement);

/// The motion at a measurement's times, with its features. It is computed at even times that resolve what was measured, and once more where
/// a feature lies between two of these. There the angle is the polynomial of third degree through two values and their rates.
///   A turning point is the extreme of its kind next to the row's time, as the instrument shows it; a release at rest is one. A turn is one of
/// the azimuth, in the sense in which it turns on the whole.
PredictedMotion predict_features(const Scene& scene, const Measurement& measurement, const Watch& watch,
                                 std::optional<Method> method);

}  // namespace earthtop::measure
