// SPDX-License-Identifier: GPL-3.0-or-later
/// The times at which the drift first passes a threshold, in random scenes by every method (events_test.cpp has the scenes with
/// known times).
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/run.hpp"
#include "earthtop/scene/scene.hpp"
#include "support/scenes.hpp"

namespace earthtop {
namespace {

/// The drift just before and after a passing, and its largest value at many times before, from a finer integration by another
/// method.
struct Around {
  double before, after, largest_before;
};
Around drift_around(Scenario scene, double t_s, double bound_s) {
  DriftProblem<float80> problem = Scene(scene).problem<float80>();
  problem.threshold_rad.reset();
  problem.times_s.clear();
  constexpr int kMoments = 400;
  for (int i = 0; i < kMoments; ++i) problem.times_s.push_back((t_s - bound_s) * i / kMoments);
  problem.times_s.push_back(t_s - bound_s);
  problem.times_s.push_back(t_s + bound_s);
  IntegrationOptions options;
  options.observer = Observer::inertial, options.form = ModelForm::general;
  options.method = Method::rkf78, options.relative_tolerance = 1e-16;
  const auto rows = integrate_drift(problem, options).samples;
  Around around{static_cast<double>(rows[kMoments].measures.axis), static_cast<double>(rows[kMoments + 1].measures.axis), 0};
  for (int i = 0; i < kMoments; ++i)
    around.largest_before =
        std::max(around.largest_before, static_cast<double>(rows[static_cast<std::size_t>(i)].measures.axis));
  return around;
}

// Random tops with thresholds that their drifts reach: another integration's drift passes between t - bound and t + bound, and
// not before. There are few rows, so the steps have to find what happens between them.
TEST(ThresholdTime, LiesWithinItsBoundOnRandomScenes) {
  int clear = 0;
  std::vector<double> excess;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    Scenario scene = testing::random_scene(seed, 60);
    const double most = run(scene).drift.axis_max_rad;
    testing::Random random(seed);
    scene.threshold_rad = std::min(3.0, most * random.uniform(0.05, 0.97));
    scene.output_step_s = scene.duration_s / 3;
    for (const MethodRow& row : kMethodRows) {
      const Method method = row.method;
      Scenario s = scene;
      s.numerics.method = method;
      if (method == Method::automatic || Scene(s).method_refusal(method) ||
          method == (seed % 2 == 0 ? Method::dopri5 : Method::abm8))
        continue;
      SCOPED_TRACE(::testing::Message() << "seed " << seed << " by " << to_string(method));
      const RunResult result = run(s);
      ASSERT_EQ(result.status, RunStatus::completed);
      ASSERT_TRUE(result.drift.threshold_time_s);
      if (result.drift.threshold_crossing != ThresholdCrossing::clear) continue;
      ++clear;
      const double t = *result.drift.threshold_time_s, bound = *result.drift.threshold_time_bound_s;
      if (t + bound > s.duration_s) continue;
      const Around around = drift_around(s, t, bound);
      EXPECT_LT(around.before, *s.threshold_rad);
      EXPECT_GT(around.after, *s.threshold_rad);
      EXPECT_LT(around.largest_before, *s.threshold_rad);
      // The bound on the drift at the end, as time, is what a generous one could be.
      excess.push_back(bound / t);
    }
  }
  EXPECT_GT(clear, 150);
  std::ranges::sort(excess);
  EXPECT_LT(excess[excess.size() / 2], 1e-9);
}

}  // namespace
}  // namespace earthtop
