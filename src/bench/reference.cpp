// SPDX-License-Identifier: GPL-3.0-or-later
// The certified reference: 113 or 64 bits, from two independent computations.
#include <fmt/core.h>

#include <algorithm>

#include "bench/errors.hpp"
#include "bench/exact_motion.hpp"
#include "bench/table_equations.hpp"
#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/elementary.hpp"

namespace earthtop {
namespace {

/// How source or witness is computed.
struct Recipe {
  Method method;
  Equations equations;
};
struct Plan {
  Recipe source, witness;
  double tolerance;
};

/// In 113 bits the source is the general model with the method that needs a tenth of the evaluations; in 64 bits, and on a table, it is
/// the Taylor series, of the reduced equations if possible. The witness has another method and, where there are any, other variables
/// and other equations.
Plan plan_of(const Scene& scene, Precision precision) {
  const double tolerance = precision == Precision::bits113 ? 1e-20 : 1e-17;
  if (scene.support().has_contact) {
    const std::vector<Equations> equations = equations_on_table(scene);
    return {{Method::taylor, equations.front()}, {Method::extrapolation, equations.back()}, tolerance};
  }
  const bool reducible = scene.is_reducible();
  const Recipe extrapolation{Method::extrapolation, {Observer::body, ModelForm::general}};
  const ModelForm form = reducible ? ModelForm::reduced : ModelForm::general;
  if (precision == Precision::bits113 || scene.method_refusal(Method::taylor))
    return {extrapolation, {Method::rkf78, {Observer::inertial, form}}, tolerance};
  if (reducible) return {{Method::taylor, {Observer::laboratory, form}}, extrapolation, tolerance};
  return {{Method::taylor, {Observer::body, form}}, {Method::extrapolation, {Observer::inertial, form}}, tolerance};
}

std::string in_words(const Recipe& recipe, Precision precision, double tolerance) {
  return fmt::format("{} of the {} model in {} axes, {}, tolerance {:.0e}", to_string(recipe.method),
                     to_string(recipe.equations.form), to_string(recipe.equations.observer), to_string(precision), tolerance);
}

template <class T>
std::vector<Checkpoint> integrate_exactly(const Scene& scene, const std::vector<double>& times_s, const Recipe& recipe,
                                          double tolerance, const Watch& watch) {
  DriftProblem<T> problem = scene.problem<T>();
  problem.times_s = times_s;
  IntegrationOptions options;
  options.method = recipe.method;
  options.observer = recipe.equations.observer;
  options.form = recipe.equations.form;
  options.relative_tolerance = tolerance;
  const DriftTrajectory<T> trajectory = integrate_drift(problem, options, watch);
  if (trajectory.status == RunStatus::interrupted)
    throw ScenarioError("",
                        "no reference: source and witness take more than three times as long as they may; give a shorter "
                        "duration, or more time "
                        "by --reference-limit");
  if (trajectory.status != RunStatus::completed)
    throw ScenarioError(
        "", fmt::format("no reference: {} in extended precision ended with {} after {:.6g} s; take a shorter duration",
                        to_string(recipe.method), to_string(trajectory.status), times_s[trajectory.samples.size() - 1]));
  std::vector<Checkpoint> checkpoints;
  checkpoints.reserve(trajectory.samples.size());
  for (const auto& sample : trajectory.samples) checkpoints.push_back(checkpoint_of(sample));
  return checkpoints;
}

std::vector<Checkpoint> integrate_exactly(const Scene& scene, const std::vector<double>& times_s, const Recipe& recipe,
                                          double tolerance, Precision precision, const Watch& watch) {
  if (precision == Precision::bits113) return integrate_exactly<float128>(scene, times_s, recipe, tolerance, watch);
  return integrate_exactly<float80>(scene, times_s, recipe, tolerance, watch);
}

/// Both motions in closed form, and the angle between their axes. It is found by subtracting them, for which 113 bits are
/// enough.
std::vector<Checkpoint> exact_checkpoints(const Scene& scene, const std::vector<double>& times_s) {
  const auto rotating = exact_laboratory_motion<float128>(scene);
  const auto reference = exact_laboratory_motion<float128>(scene.without_rotation());
  if (!rotating || !reference) return {};
  std::vector<Checkpoint> checkpoints;
  checkpoints.reserve(times_s.size());
  for (const double t : times_s) checkpoints.push_back(subtracted(rotating(float128(t)).q_LB, reference(float128(t)).q_LB));
  return checkpoints;
}

/// The error stated for a distance between source and witness: three times the distance, because both may err in the same
/// direction.
BenchErrors stated(BenchErrors distance) {
  constexpr double kSafety = 3;
  distance.axis *= kSafety;
  if (distance.attitude) *distance.attitude *= kSafety;
  if (distance.drift) *distance.drift *= kSafety;
  return distance;
}

double estimated_seconds_of(const Scene& scene, const Recipe& recipe, double tolerance, Precision precision) {
  Scenario scenario = scene.scenario();
  scenario.numerics = {};
  scenario.numerics.method = recipe.method;
  scenario.numerics.observer = recipe.equations.observer;
  if (recipe.equations.form == ModelForm::general) scenario.numerics.form = recipe.equations.form;
  scenario.numerics.relative_tolerance = tolerance;
  scenario.precision = precision;
  constexpr std::size_t kRows = 60;
  scenario.output_step_s = scenario.duration_s / kRows;
  const Scene planned = resolve(std::move(scenario));
  return planned.costs()[0].seconds;
}

}  // namespace

CertifiedReference certified_reference(const Scene& scene, const std::vector<double>& times_s, Precision precision,
                                       const Watch& watch) {
  const Plan plan = plan_of(scene, precision);
  CertifiedReference reference;
  reference.checkpoints = integrate_exactly(scene, times_s, plan.source, plan.tolerance, precision, watch);
  reference.source = in_words(plan.source, precision, plan.tolerance);
  std::vector<Checkpoint> witness = exact_checkpoints(scene, times_s);
  reference.witness = "closed form, float128";
  if (witness.empty()) {
    witness = integrate_exactly(scene, times_s, plan.witness, plan.tolerance, precision, watch);
    reference.witness = in_words(plan.witness, precision, plan.tolerance);
  }
  reference.error = stated(largest_errors(reference.checkpoints, witness, true));
  return reference;
}

double estimated_reference_seconds(const Scene& scene, Precision precision) {
  const Plan plan = plan_of(scene, precision);
  return estimated_seconds_of(scene, plan.source, plan.tolerance, precision) +
         estimated_seconds_of(scene, plan.witness, plan.tolerance, precision);
}

Scene shortened_for_reference(const Scene& scene, double reference_seconds) {
  const double seconds = estimated_reference_seconds(scene, Precision::bits64);
  if (seconds <= reference_seconds) return scene;
  Scenario shortened = scene.scenario();
  const double duration_s = shortened.duration_s * reference_seconds / seconds;
  const double unit = real::power_of_ten(static_cast<int>(std::floor(real::log10(duration_s))));
  shortened.duration_s = std::floor(duration_s / unit) * unit;  // rounded down to one digit
  shortened.output_step_s = std::min(shortened.output_step_s, shortened.duration_s);
  return resolve(std::move(shortened));
}

}  // namespace earthtop
