// SPDX-License-Identifier: GPL-3.0-or-later
// How the error of a fixed-step method depends on its step.
#include <algorithm>
#include <cmath>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/elementary.hpp"
#include "verify/geometry.hpp"
#include "verify/judge.hpp"

namespace earthtop::verify_detail {
namespace {

/// Steps from row to row that the scene's own step makes. @throws NotJudged where it has none
long fewest_parts(const Scenario& scenario) {
  if (!scenario.numerics.step_s) throw NotJudged("the scene gives no step");
  return std::lround(std::ceil(scenario.output_step_s / *scenario.numerics.step_s));
}

constexpr double kFiner = 1.01;  // from one of a resonance's steps to the next, over two octaves

/// Steps from row to row, of all trajectories of a criterion together.
double steps_of(const CriterionSpec& criterion, double fewest) {
  return fewest * (criterion.quantity == "step_resonance" ? (4 - 1) / (kFiner - 1) : 1 + 2);
}

/// Errors of one scene's rotating motion by its method at many steps, against a series at its finest tolerance.
class StepErrors {
 public:
  /// @param work  steps from row to row of all that will be asked for
  StepErrors(const Scene& scene, const Watch& watch, double work) : scene_(scene), parts_(watch, work) {
    Scenario fine = scene.scenario();
    fine.numerics = {};
    fine.numerics.method = Method::taylor;
    fine.numerics.relative_tolerance = least_tolerance(Precision::bits53);
    reference_ = trajectory(resolve(std::move(fine)).choice().options, 1);
  }
  /// The largest angle between the attitudes at the rows. @param parts  steps from row to row
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

/// The largest error over the median, each over the power law of its octave, in the worst of two octaves.
double resonance(StepErrors& errors, double parts) {
  double worst = 0;
  for (int octave = 0; octave < 2; ++octave) {
    std::vector<double> x, y;
    for (const double end = 2 * parts; parts < end; parts *= kFiner) {
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
  // Of one motion, where the estimate is of two integrations of two motions and their deviation.
  constexpr double kOfEstimate = 0.15;
  const auto fewest = static_cast<double>(fewest_parts(scene.scenario()));
  return kOfEstimate * scene.estimate().seconds.all() * steps_of(criterion, fewest) / fewest;
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
