// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/prediction_problem.hpp"

#include <optional>

#include "measure/measured_motion.hpp"

namespace earthtop::measure {

FitProblem prediction_problem(const EstimatedInputs& inputs, const Measurement& measurement,
                              const std::vector<MeasurementResidual>& residuals, const std::vector<double>& times_s,
                              const Watch& watch, Trials& trials) {
  FitProblem problem;
  for (const EstimatedInput& input : inputs.list()) {
    problem.start.push_back(input.start);
    problem.scales.push_back(input.scale);
  }
  for (const MeasurementResidual& residual : residuals) {
    problem.standard_error.push_back(residual.standard_error);
    problem.period.push_back(period_of(residual));
  }
  problem.stopped = [&watch] { return watch.asks_to_stop(); };
  problem.residuals_at = [&, drift = has_drifts(measurement)](const std::vector<double>& values, std::vector<double>& found) {
    const std::optional<Scene> scene = inputs.scene(values);
    if (!scene) return false;
    try {
      ++trials.predictions;
      const double begun = trials.share;
      trials.share += trials.part * (1 - trials.share);
      const PredictedMotion motion = predict(*scene, times_s, drift, watch.part(begun, trials.share));
      if (motion.status != RunStatus::completed) return false;
      trials.latest = residuals_of(measurement, motion);
    } catch (const ScenarioError&) {  // no steady precession for these values, an axis that is vertical, days of work
      return false;
    }
    found.clear();
    for (const MeasurementResidual& residual : trials.latest) found.push_back(residual.residual);
    return true;
  };
  return problem;
}

}  // namespace earthtop::measure
