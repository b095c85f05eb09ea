/// The motion that a scenario predicts at measured times, and what a measurement differs from it by.
#pragma once

#include <vector>

#include "earthtop/compare/measurement.hpp"
#include "earthtop/drift/drift_integration.hpp"

namespace earthtop::compare {

/// The measured times, each once, ascending; the release is the first (s).
std::vector<double> measured_times(const Measurement& measurement);

/// Both predictions of a scenario at these times, in double whatever its precision; its rows and its threshold are not looked
/// at. @param times_s  ascending, from 0 on, none beyond the scenario's duration   @param stop  set from outside to end early
/// @throws ScenarioError for a method that does not fit the scene, or a scene that would take days
DriftTrajectory<double> predict(Scenario scenario, const std::vector<double>& times_s, const std::atomic<bool>* stop);

/// The verdict on a run of the scenario to this time, prepared as for `predict`.
/// @param status  of the run: completed, or why there is no verdict
VerdictReport verdict_at(Scenario scenario, double end_s, RunStatus& status);

/// A measurement's residuals against samples at measured_times(), as many rows as there are samples for. Azimuths are folded to
/// the nearest turn. The components of an axis are along directions that the measured axis alone decides, so that they do not
/// turn as a prediction is varied.
/// @throws ScenarioError, at the row's line, for the azimuth of an axis that the prediction has vertical
std::vector<MeasurementResidual> residuals_of(const Measurement& measurement, const std::vector<DriftSample<double>>& samples);

/// What a residual may jump by where an angle goes round (rad); 0 where it cannot.
double period_of(const MeasurementResidual& residual);

}  // namespace earthtop::compare
