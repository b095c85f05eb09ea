// SPDX-License-Identifier: GPL-3.0-or-later
/// The motion that a scenario predicts at measured times, and what a measurement differs from it by.
#pragma once

#include <optional>
#include <vector>

#include "earthtop/measure/measurement.hpp"
#include "earthtop/vectors.hpp"
#include "earthtop/watch.hpp"

namespace earthtop::measure {

/// The measured times, each once, ascending; the release is the first (s).
std::vector<double> measured_times(const Measurement& measurement);

/// Body axis 3 at one instant, and how far it has drifted from the non-rotating prediction.
struct PredictedAxis {
  double t_s = 0;
  Vec3<double> n_L = Vec3<double>::Zero();
  double drift_tilt_rad = 0;                ///< 0 where no drift was asked for
  std::optional<double> drift_azimuth_rad;  ///< continuous; none where an axis is vertical, or no drift was asked for
};
struct PredictedMotion {
  RunStatus status = RunStatus::completed;
  std::vector<PredictedAxis> axes;  ///< one for each time that was reached
};

/// A scenario's motion at these times, in double whatever its precision; its rows and what else it asks for are not looked at.
/// @param times_s  ascending, from 0 on, none beyond the scenario's duration   @param drift  whether drifts are wanted, which
/// take the non-rotating prediction as well: threefold work   @param watch  may end it early
/// @throws ScenarioError for a method that does not fit the scene, or a scene that would take days
PredictedMotion predict(const Scene& scene, const std::vector<double>& times_s, bool drift, const Watch& watch);

bool has_drifts(const Measurement& measurement);

/// The verdict on a run of the scenario to this time, prepared as for `predict`.
/// @param status  of the run: completed, or why there is no verdict
VerdictReport verdict_at(const Scene& scene, double end_s, const Watch& watch, RunStatus& status);

/// A measurement's residuals against the motion at measured_times(), as many rows as were reached. Azimuths are folded to
/// the nearest turn. The components of an axis are along directions that the measured axis alone decides, so that they do not
/// turn as a prediction is varied.
/// @throws ScenarioError, at the row's line, for the azimuth of an axis that the prediction has vertical
std::vector<MeasurementResidual> residuals_of(const Measurement& measurement, const PredictedMotion& motion);

/// The amount by which a residual jumps when its angle passes a full turn (rad); 0 where it cannot jump.
double period_of(const MeasurementResidual& residual);

}  // namespace earthtop::measure
