// SPDX-License-Identifier: GPL-3.0-or-later
/// The rows that a plan measures, as a measurement whose values are those of the scenario's own motion.
#pragma once

#include <cstddef>
#include <vector>

#include "earthtop/plan/plan.hpp"
#include "earthtop/scene/scene.hpp"
#include "measure/measured_motion.hpp"

namespace earthtop::plan {

inline constexpr std::size_t kMostRows = 200'000;  // as many as a measurement file may have

/// Number of rows from the release to `until_s`, both included if they are a whole number of steps apart.
/// @throws ScenarioError for a distance or an end that is not above 0, or more rows than a measurement may have
std::size_t count_rows(double every_s, double until_s);

/// A plan's values at `times_s`, for each time those of all quantities in their order. Angles are not set yet.
Measurement empty_measurement(const std::vector<PlannedQuantity>& quantities, const std::vector<double>& times_s);

/// The times k every_s (s).
std::vector<double> planned_times(double every_s, std::size_t rows);

/// Sets each value to the predicted one. @param motion  complete, at the measurement's times
/// @throws ScenarioError for a planned azimuth where the axis is vertical
void fill_in(Measurement& measurement, const measure::PredictedMotion& motion);

/// A scenario that lasts until the last row, at least.
Overrides lasting(Overrides overrides, const Scenario& scenario, double until_s);

}  // namespace earthtop::plan
