// The certified reference: 113 bits, from two unrelated sources.
#include <fmt/format.h>

#include <stdexcept>

#include "bench/errors.hpp"
#include "bench/exact_motion.hpp"
#include "run/setup.hpp"

namespace earthtop {
namespace {

DriftTrajectory<float128> integrate_exactly(const DriftProblem<float128>& problem, Method method, Observer observer,
                                            ModelForm form, double tolerance) {
  IntegrationOptions options;
  options.method = method;
  options.observer = observer;
  options.form = form;
  options.relative_tolerance = tolerance;
  DriftTrajectory<float128> trajectory = integrate_drift(problem, options);
  if (trajectory.status != RunStatus::completed)
    throw std::runtime_error(
        fmt::format("no reference: {} in 113 bits ended with {}", to_string(method), to_string(trajectory.status)));
  return trajectory;
}

std::vector<Checkpoint> checkpoints_of(const std::vector<DriftSample<float128>>& samples) {
  std::vector<Checkpoint> checkpoints;
  checkpoints.reserve(samples.size());
  for (const auto& sample : samples) checkpoints.push_back(checkpoint_of(sample));
  return checkpoints;
}

/// Both motions in closed form, and the angle between their axes: subtracted, which 113 bits can afford.
std::vector<Checkpoint> exact_checkpoints(const Scenario& scenario, const std::vector<double>& times_s) {
  Scenario still = scenario;
  still.rotation_rate_rad_s = 0;  // same attitude, same rates of the kind that the release names
  const auto rotating = exact_laboratory_motion<float128>(scenario), reference = exact_laboratory_motion<float128>(still);
  if (!rotating || !reference) return {};
  std::vector<Checkpoint> checkpoints;
  for (const double t : times_s) {
    Checkpoint checkpoint{rotating(float128(t)).q_LB, std::nullopt};
    const Quaternion<float128> e = reference(float128(t)).q_LB.conjugate() * checkpoint.q_LB;
    checkpoint.drift_axis = 2 * real::atan2(real::hypot(e.v[0], e.v[1]), real::hypot(e.w, e.v[2]));
    checkpoints.push_back(checkpoint);
  }
  return checkpoints;
}

/// The error stated for a distance: three times it, as the two may err to the same side.
BenchErrors stated(BenchErrors distance) {
  constexpr double kSafety = 3;
  distance.axis *= kSafety;
  if (distance.attitude) *distance.attitude *= kSafety;
  if (distance.drift) *distance.drift *= kSafety;
  return distance;
}

}  // namespace

CertifiedReference certified_reference(const Scenario& scenario, const std::vector<double>& times_s, double tolerance) {
  auto problem = make_problem<float128>(scenario);
  problem.times_s = times_s;
  CertifiedReference reference;
  // The general model by the method that takes a tenth of the evaluations; what it is held against has other variables, other
  // equations and another method, and without the spin where that can be.
  reference.samples = integrate_exactly(problem, Method::extrapolation, Observer::body, ModelForm::general, tolerance).samples;
  reference.source = fmt::format("extrapolation of the general model in body axes, float128, tolerance {:.0e}", tolerance);
  std::vector<Checkpoint> witness = exact_checkpoints(scenario, times_s);
  reference.witness = "closed form, float128";
  if (witness.empty()) {
    const ModelForm form = is_reducible(problem.model) ? ModelForm::reduced : ModelForm::general;
    witness = checkpoints_of(integrate_exactly(problem, Method::rkf78, Observer::inertial, form, tolerance).samples);
    reference.witness =
        fmt::format("rkf78 of the {} model in inertial axes, float128, tolerance {:.0e}", to_string(form), tolerance);
  }
  reference.error = stated(largest_errors(checkpoints_of(reference.samples), witness, true));
  return reference;
}

}  // namespace earthtop
