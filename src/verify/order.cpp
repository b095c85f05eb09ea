// How the error of a fixed-step method depends on its step.
#include <algorithm>
#include <cmath>

#include "earthtop/elementary.hpp"
#include "earthtop/integrate/motion_integration.hpp"
#include "scenario/problem.hpp"
#include "verify/geometry.hpp"
#include "verify/judge.hpp"

namespace earthtop::verify_detail {
namespace {

/// Errors of one scene's rotating motion by its method at many steps, against a series at its finest tolerance.
class StepErrors {
 public:
  explicit StepErrors(const Scenario& scenario) : scenario_(scenario), problem_(make_problem<double>(scenario)) {
    if (!scenario.numerics.step_s) throw NotJudged("the scene gives no step");
    Scenario fine = scenario;
    fine.numerics = {};
    fine.numerics.method = Method::taylor;
    fine.numerics.relative_tolerance = least_tolerance(Precision::bits53);
    fine.numerics = method_choice(fine).options;
    reference_ = trajectory(fine.numerics);
  }
  /// The largest angle between the attitudes at the rows. @param parts  steps from row to row
  double at(long parts) const {
    IntegrationOptions options = scenario_.numerics;
    options.step_s = scenario_.output_step_s / static_cast<double>(parts);
    const auto samples = trajectory(options);
    double error = 0;
    for (std::size_t i = 0; i < samples.size(); ++i)
      error = worse(error, attitude_distance(samples[i].q_LB, reference_[i].q_LB));
    return error;
  }
  long fewest_parts() const { return std::lround(std::ceil(scenario_.output_step_s / *scenario_.numerics.step_s)); }

 private:
  std::vector<MotionSample<double>> trajectory(const IntegrationOptions& options) const {
    auto motion = integrate_motion(problem_, options);
    if (interrupt_requested()) throw NotJudged("interrupted");
    if (motion.status != RunStatus::completed) throw NotJudged("an integration ended early");
    return std::move(motion.samples);
  }

  const Scenario& scenario_;
  DriftProblem<double> problem_;
  std::vector<MotionSample<double>> reference_;
};

/// The largest error over the median, each over the power law of its octave, in the worst of two octaves.
double resonance(const StepErrors& errors) {
  double worst = 0;
  double parts = static_cast<double>(errors.fewest_parts());
  for (int octave = 0; octave < 2; ++octave) {
    std::vector<double> x, y;
    for (const double end = 2 * parts; parts < end; parts *= 1.01) {
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

double order_error(const CriterionSpec& criterion, Runs& runs) {
  const Scenario scenario = runs.scenario(criterion.set);
  const StepErrors errors(scenario);
  if (criterion.quantity == "step_resonance") return resonance(errors);
  const long parts = errors.fewest_parts();
  const double order = real::log2(errors.at(parts) / errors.at(2 * parts));
  return std::abs(order - criterion.values.at(0));
}

}  // namespace earthtop::verify_detail
