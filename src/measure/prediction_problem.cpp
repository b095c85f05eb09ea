// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/prediction_problem.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "measure/measured_motion.hpp"
#include "measure/quantities.hpp"

namespace earthtop::measure {
namespace {

/// The latest motions of one release among several.
class LatestMotions {
 public:
  explicit LatestMotions(std::size_t most) : most_(most) {}
  const std::vector<double>* find(const std::vector<double>& values) {
    const auto known = std::ranges::find(latest_, values, &Motion::values);
    if (known == latest_.end()) return nullptr;
    std::rotate(latest_.begin(), known, known + 1);  // the oldest of them will be forgotten first
    return &latest_.front().residuals;
  }
  const std::vector<double>* keep(const std::vector<double>& values, std::vector<double> residuals) {
    if (latest_.size() == most_) latest_.pop_back();
    latest_.insert(latest_.begin(), {values, std::move(residuals)});
    return &latest_.front().residuals;
  }

 private:
  struct Motion {
    std::vector<double> values, residuals;
  };
  std::size_t most_;
  std::vector<Motion> latest_;
};

std::vector<double> numbers_of(const std::vector<MeasurementResidual>& residuals) {
  std::vector<double> numbers;
  numbers.reserve(residuals.size());
  for (const MeasurementResidual& residual : residuals) numbers.push_back(residual.residual);
  return numbers;
}

PredictedMotion predicted(const Scene& scene, const Measurement& measurement, const Watch& watch,
                          std::optional<Method> method) {
  if (method) try {
      return predict(scene, measurement, watch, method);
    } catch (const ScenarioError&) {  // this motion is of another kind
    }
  return predict(scene, measurement, watch);
}

}  // namespace

VariedRelease varied_release(const EstimatedInputs& inputs, const Measurement& measurement,
                             std::vector<MeasurementResidual> residuals) {
  return {&inputs, &measurement, std::move(residuals), method_of_prediction(inputs.base(), measured_times(measurement))};
}

std::optional<std::vector<MeasurementResidual>> varied_residuals(const VariedRelease& release,
                                                                 const std::vector<double>& values, const Watch& watch,
                                                                 Trials& trials) {
  const std::optional<Scene> scene = release.inputs->scene(values);
  if (!scene) return std::nullopt;
  try {
    ++trials.predictions;
    const double begun = trials.share;
    trials.share += trials.part * (1 - trials.share);
    const Measurement& measurement = *release.measurement;
    const PredictedMotion motion = predicted(*scene, measurement, watch.part(begun, trials.share), release.method);
    if (motion.status != RunStatus::completed) return std::nullopt;
    return residuals_of(measurement, motion);
  } catch (const ScenarioError&) {  // no steady precession for these values, an axis that is vertical, days of work
    return std::nullopt;
  }
}

FitProblem prediction_problem(const JointInputs& inputs, const std::vector<VariedRelease>& releases, const Watch& watch,
                              Trials& trials) {
  FitProblem problem;
  for (const JointInput& input : inputs.list()) {
    problem.start.push_back(input.start);
    problem.scales.push_back(input.scale);
  }
  for (const VariedRelease& release : releases)
    for (const MeasurementResidual& residual : release.residuals) {
      problem.standard_error.push_back(residual.standard_error);
      problem.period.push_back(period_of(residual));
      problem.size.push_back(size_of(row_of(residual.quantity).dimension));
    }
  problem.stopped = [&watch] { return watch.asks_to_stop(); };
  constexpr std::size_t kMost = 24;  // two for each of a release's own inputs and for a few shared ones
  const auto latest =
      std::make_shared<std::vector<LatestMotions>>(releases.size(), LatestMotions(releases.size() > 1 ? kMost : 1));
  problem.residuals_at = [&, latest](const std::vector<double>& values, std::vector<double>& found) {
    found.clear();
    for (std::size_t r = 0; r < releases.size(); ++r) {
      const std::vector<double> own = inputs.values_of(r, values);
      const std::vector<double>* residuals = (*latest)[r].find(own);
      if (!residuals) {
        const auto varied = varied_residuals(releases[r], own, watch, trials);
        if (!varied) return false;
        residuals = (*latest)[r].keep(own, numbers_of(*varied));
      }
      found.insert(found.end(), residuals->begin(), residuals->end());
    }
    return true;
  };
  return problem;
}

}  // namespace earthtop::measure
