// SPDX-License-Identifier: GPL-3.0-or-later
// The dependence of the error of a fixed-step method on its step: the order of the method, and resonances of the step with the motion.
#include <algorithm>
#include <cmath>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/elementary.hpp"
#include "verify/geometry.hpp"
#include "verify/judge.hpp"

namespace earthtop::verify_detail {
namespace {

/// The number of steps from row to row with the scene's own step.   @throws NotJudged if the scenario gives no step
long fewest_parts(const Scenario& scenario) {
  if (!scenario.numerics.step_s) throw NotJudged("the scenario gives no step");
  return std::lround(std::ceil(scenario.output_step_s / *scenario.numerics.step_s));
}

constexpr double kStepCountRatio =
    1.01;  // of successive step counts in a search for resonances, from the fewest to kMost times these
constexpr double kMost = 4;

/// Number of steps from row to row, summed over all trajectories of a criterion: a geometric series in a search for resonances; for the
/// order of a method, the fewest and twice as many.
double steps_of(const CriterionSpec& criterion, double fewest) {
  const bool is_search = criterion.quantity == "step_resonance";
  return fewest * (is_search ? (kMost - 1) / (kStepCountRatio - 1) : 1 + 2);
}

/// Errors of a scene's rotating motion with its method at various steps, relative to a Taylor series solution at its finest
/// tolerance.
class StepErrors {
 public:
  /// @param work  number of steps from row to row, summed over all trajectories that will be requested
  StepErrors(const Scene& scene, const Watch& watch, double work) : scene_(scene), parts_(watch, work) {
    Scenario fine = scene.scenario();
    fine.numerics = {};
    fine.numerics.method = Method::taylor;
    fine.numerics.relative_tolerance = least_tolerance(Precision::bits53);
    reference_ = trajectory(resolve(std::move(fine)).choice().options, 1);
  }
  /// The largest angle between the attitudes at the rows (rad).   @param parts  steps from row to row
  double at(long parts) {
    IntegrationOptions options = scene_.scenario().numerics;
    options.step_s = scene_.scenario().output_step_s / static_cast<double>(parts);
    const auto samples = trajectory(options, static_cast<double>(parts));
    double error = 0;
    for (std::size_t i = 0; i < samples.size(); ++i)
      error = worse(error, attitude_distance(samples[i].q_LB, reference_[i].q_LB));
    return error;
  }

 private:
  std::vector<MotionSample<double>> trajectory(const IntegrationOptions& options, double work) {
    const Watch watch = parts_.next(work);
    auto motion = integrate_motion<double>(scene_.problem<double>(), options, MotionSought::attitude, watch);
    if (watch.asks_to_stop()) throw NotJudged("interrupted");
    if (motion.status != RunStatus::completed) throw NotJudged("an integration ended early");
    return std::move(motion.samples);
  }

  Scene scene_;
  Parts parts_;
  std::vector<MotionSample<double>> reference_;
};

/// The largest error over the median error, after division by the power law fitted in its octave; the larger value of two
/// octaves.
double resonance(StepErrors& errors, double parts) {
  double worst = 0;
  for (int octave = 0; octave < 2; ++octave) {
    std::vector<double> x, y;
    for (const double end = 2 * parts; parts < end; parts *= kStepCountRatio) {
      x.push_back(real::log(std::round(parts)));
      y.push_back(real::log(errors.at(std::lround(parts))));
    }
    const double n = static_cast<double>(x.size());
    double mean_x = 0, mean_y = 0, xx = 0, xy = 0;
    for (std::size_t i = 0; i < x.size(); ++i) mean_x += x[i] / n, mean_y += y[i] / n;
    for (std::size_t i = 0; i < x.size(); ++i) xx += (x[i] - mean_x) * (x[i] - mean_x), xy += (x[i] - mean_x) * (y[i] - mean_y);
    std::vector<double> rest;
    for (std::size_t i = 0; i < x.size(); ++i) rest.push_back(y[i] - mean_y - xy / xx * (x[i] - mean_x));
    std::sort(rest.begin(), rest.end());
    worst = worse(worst, real::exp(rest.back() - rest[rest.size() / 2]));
  }
  return worst;
}

}  // namespace

double order_work(const CriterionSpec& criterion, const Runs& runs) {
  const Scene scene = runs.scene(criterion.set);
  if (!scene.scenario().numerics.step_s) return 0;
  // The work is for one motion, whereas the estimate is for two integrations of two motions and their deviation.
  constexpr double kShareOfEstimate = 0.15;
  const auto fewest = static_cast<double>(fewest_parts(scene.scenario()));
  return kShareOfEstimate * scene.estimate().seconds.all() * steps_of(criterion, fewest) / fewest;
}

double order_error(const CriterionSpec& criterion, Runs& runs) {
  const Scene scene = runs.scene(criterion.set);
  const long parts = fewest_parts(scene.scenario());
  StepErrors errors(scene, runs.watch(), steps_of(criterion, static_cast<double>(parts)) + 1);
  if (criterion.quantity == "step_resonance") return resonance(errors, static_cast<double>(parts));
  const double order = real::log2(errors.at(parts) / errors.at(2 * parts));
  return std::abs(order - criterion.values.at(0));
}

}  // namespace earthtop::verify_detail
