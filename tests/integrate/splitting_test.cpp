// SPDX-License-Identifier: GPL-3.0-or-later
/// Splitting and collocation methods on tops: their errors fall smoothly with the step, without resonances of step and
/// nutation, and conserved quantities have no trend.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/model/reduced_top.hpp"
#include "earthtop/scene/scene.hpp"
#include "integrate/compositions.hpp"
#include "support/scenes.hpp"

namespace earthtop {
namespace {

/// A gyro of 500 g that nutates at 1309 rad/s.
Scenario fast_gyro() {
  Scenario s = testing::toy_top();
  s.body.mass_kg = 0.5;
  s.body.center_of_mass_m = {0, 0, 0.005};
  testing::set_principal(s.body, 4e-4, 4e-4, 5e-4);
  s.release.tilt_deg = 60;
  s.release.spin_rad_s = 1047.2;
  return s;
}

/// One motion from 0 to the end, and the rate of its nutation.
struct Sweep {
  DriftProblem<double> problem;
  double duration_s, nutation_rad_s;
  Vec3<double> exact;

  Sweep(Scenario scene, double seconds) : duration_s(seconds) {
    scene.duration_s = scene.output_step_s = seconds;
    problem = Scene(scene).problem<double>();
    const ReducedTop<double> top = reduced_top(problem.model);
    nutation_rad_s = scene.release.spin_rad_s * top.I3 / top.I1;
    IntegrationOptions options;
    options.method = Method::extrapolation;
    options.relative_tolerance = 1e-14;
    exact = axis_at_end(options);
  }
  Vec3<double> axis_at_end(const IntegrationOptions& options) const {
    const auto trajectory = integrate_motion(problem, options, MotionSought::symmetry_axis);
    if (trajectory.status != RunStatus::completed) return Vec3<double>::Zero();
    return rotation_matrix(trajectory.samples.back().q_LB).col(2);
  }
  /// Points (log of the nutation's phase per step, log of the axis error); the phase varies by 1 % of an octave.
  std::vector<std::pair<double, double>> octave(IntegrationOptions options, double phase) const {
    std::vector<std::pair<double, double>> points;
    double steps_before = 0;
    for (double x = phase; x < 2 * phase; x *= 1.01) {
      const double steps = std::ceil(duration_s * nutation_rad_s / x);
      if (steps == steps_before) continue;
      steps_before = steps;
      options.step_s = duration_s / steps * (1 + 1e-13);
      const double error = norm(Vec3<double>(axis_at_end(options) - exact));
      points.emplace_back(std::log(duration_s * nutation_rad_s / steps), std::log(error));
    }
    return points;
  }
};

/// The largest ratio of an error to the power law that fits the octave best: a resonance rises above that law.
double largest_over_power_law(const std::vector<std::pair<double, double>>& points) {
  double x = 0, y = 0, xx = 0, xy = 0;
  const auto n = static_cast<double>(points.size());
  for (const auto& [px, py] : points) x += px / n, y += py / n;
  for (const auto& [px, py] : points) xx += (px - x) * (px - x), xy += (px - x) * (py - y);
  double largest = 0;
  for (const auto& [px, py] : points) largest = std::max(largest, py - y - xy / xx * (px - x));
  return std::exp(largest);
}
double largest_over_median(std::vector<std::pair<double, double>> points) {
  std::sort(points.begin(), points.end(), [](const auto& p, const auto& q) { return p.second < q.second; });
  return std::exp(points.back().second - points[points.size() / 2].second);
}

// H26. With order p, errors rise by 2^(p/2) from the middle to the end of an octave even without a resonance, by 16 for order
// 8. The bound of 10 is therefore applied to the ratio of the errors to the power law.
TEST(StepResonance, ErrorsAreSmoothUpToTwoRadiansOfNutationAStep) {
  const Sweep toy(testing::toy_top(), 5);
  for (const CompositionTable& table : kCompositionTables)
    for (const double phase : {0.5, 1.0}) {
      SCOPED_TRACE(to_string(table.name));
      IntegrationOptions options;
      options.method = Method::splitting;
      options.composition = table.name;
      const auto points = toy.octave(options, phase);
      EXPECT_GT(points.size(), 50u);
      EXPECT_LT(largest_over_power_law(points), 2);
      EXPECT_LT(largest_over_median(points), 10 * (table.order > 6 ? 2 : 1));
    }
  IntegrationOptions options;
  options.method = Method::gauss;
  options.form = ModelForm::reduced;
  EXPECT_LT(largest_over_power_law(toy.octave(options, 1.0)), 3);
}

// The first resonance of a fast top is at one nutation per step, three times the step that `splitting` chooses. This shows that
// the sweep detects a resonance.
TEST(StepResonance, TheFirstIsWhereAStepIsAWholeNutation) {
  const Sweep gyro(fast_gyro(), 10);
  IntegrationOptions options;
  options.method = Method::splitting;
  options.composition = Composition::aba864;
  EXPECT_GT(largest_over_power_law(gyro.octave(options, 4.5)), 10);
  EXPECT_LT(largest_over_power_law(gyro.octave(options, 1.6)), 3);
}

TEST(Splitting, FindsAStepThatMeetsItsTolerance) {
  Scenario scene = testing::toy_top();
  scene.duration_s = 10;
  const auto problem = Scene(scene).problem<double>();
  IntegrationOptions options;
  options.method = Method::extrapolation;
  options.relative_tolerance = 1e-14;
  const auto exact = integrate_motion(problem, options);
  options.method = Method::splitting;
  for (const Composition composition :
       {Composition::aba84, Composition::aba864, Composition::aba1064, Composition::rkn6, Composition::kahan_li8})
    for (const Observer observer : {Observer::laboratory, Observer::inertial})
      for (const double tolerance : {1e-7, 1e-9, 1e-11}) {
        SCOPED_TRACE(to_string(composition));
        options.composition = composition;
        options.observer = observer;
        options.relative_tolerance = tolerance;
        const auto motion = integrate_motion(problem, options);
        ASSERT_EQ(motion.samples.size(), exact.samples.size());
        double error = 0;
        for (std::size_t i = 0; i < motion.samples.size(); ++i) {
          const Quaternion<double> d = motion.samples[i].q_LB.conjugate() * exact.samples[i].q_LB;
          error = std::max(error, 2 * norm(d.v));
        }
        // A hundred turns of the nutation, each in error by the tolerance at most; 1e-11 is the reference's own error.
        EXPECT_LT(error, 300 * tolerance + 2e-11) << tolerance;
      }
}

/// The Jacobi integral T + V - L.W, from the motion alone, in units of T at release (the energy of the spin).
double jacobi_integral(const DriftProblem<double>& problem, const MotionSample<double>& sample) {
  const auto& model = problem.model;
  const Mat3<double> R_LB = rotation_matrix(sample.q_LB);
  const Vec3<double> W_B = transposed_times(R_LB, model.W_IL_L);
  const Vec3<double> w_IB_B = problem.units.rate_from_rad_s(sample.w_LB_B) + W_B;
  const Vec3<double> L_B = model.I_BP_B * w_IB_B;
  const double kinetic = L_B.dot(w_IB_B) / 2, spin = problem.natural_release().w_XB_B[2];
  const double potential = -times(R_LB, model.mass_moment_B).dot(model.apparent_gravity_L);
  return (kinetic + potential - L_B.dot(W_B)) / (model.I_BP_B(2, 2) * spin * spin / 2);
}

// A hundred thousand steps each. Rounding makes a random walk of some 1e-17 per step, 4e-15 in all; a trend of 1e-16 per step
// would add up to 1e-11.
TEST(LongRuns, TheJacobiIntegralHasNoTrend) {
  Scenario scene = testing::toy_top();
  scene.duration_s = 600;
  scene.output_step_s = 0.6;
  const auto problem = Scene(scene).problem<double>();
  for (const Method method : {Method::gauss, Method::splitting}) {
    SCOPED_TRACE(to_string(method));
    IntegrationOptions options;
    options.method = method;
    options.step_s = 0.006;
    const auto motion = integrate_motion(problem, options);
    ASSERT_EQ(motion.status, RunStatus::completed);
    ASSERT_EQ(motion.counters.accepted, 100'000);
    const double start = jacobi_integral(problem, motion.samples.front());
    double first = 0, second = 0;
    const std::size_t half = motion.samples.size() / 2;
    for (std::size_t i = 1; i < motion.samples.size(); ++i) {
      double& largest = i < half ? first : second;
      largest = std::max(largest, std::abs(jacobi_integral(problem, motion.samples[i]) - start));
    }
    // Gauss is at round-off at this step; the composition's own error oscillates, and does not grow.
    EXPECT_LT(second, method == Method::gauss ? 2e-14 : 1e-10);
    EXPECT_LT(second, 1.5 * first + 1e-14);
  }
}

}  // namespace
}  // namespace earthtop
