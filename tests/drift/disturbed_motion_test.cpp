// SPDX-License-Identifier: GPL-3.0-or-later
// A disturbance that is put into a state is seen in it again, whatever the law of the motion.
#include "drift/derivatives/disturbed_motion.hpp"
//
#include <gtest/gtest.h>

#include "earthtop/scene/scene.hpp"
#include "support/effect_scenes.hpp"
#include "support/scenes.hpp"

namespace earthtop {
namespace {

constexpr double kRounding = 1e-14;  // of some fifty operations on numbers up to 10

Motion<double> release_of(const MotionProblem<double>& problem) {
  const NaturalRelease<double> release = problem.natural_release();
  return {release.q_LB.normalized(), release.w_XB_B};
}

/// Steps along the series of a law, so that no component of the state is as special as at the release.
template <class Law>
typename DisturbedMotion<Law>::State moved(const DisturbedMotion<Law>& system) {
  auto x = system.initial_state();
  auto series = system.series();
  std::array<typename DisturbedMotion<Law>::State, 16> orders{x};
  series.start(x, 0);
  series.expand(orders.data(), 15);
  constexpr double kStep = 0.1;
  for (std::size_t i = 0; i < x.size(); ++i) {
    double sum = 0;
    for (std::size_t k = orders.size(); k-- > 0;) sum = sum * kStep + orders[k][i];
    x[i] = sum;
  }
  return x;
}

template <class Law>
void expect_seen_as_put(const MotionProblem<double>& problem, const Disturbance& put) {
  const DisturbedMotion<Law> system(problem.model, Law(problem, release_of(problem)));
  auto x = moved(system);
  for (std::size_t d = 0; d < kDisturbances; ++d) {
    system.put({Vec3<double>((1 + d) * put.theta_B), Vec3<double>((3 - d) * put.dw_B)}, x, d);
    const Disturbance seen = system.disturbances(x)[d];
    EXPECT_LE(norm(Vec3<double>(seen.theta_B - (1 + d) * put.theta_B)), kRounding);
    EXPECT_LE(norm(Vec3<double>(seen.dw_B - (3 - d) * put.dw_B)), kRounding);
  }
}

TEST(DisturbedMotion, DisturbancesAreSeenAsTheyArePut) {
  const Scene top(testing::toy_top());
  const Disturbance any{{0.3, -0.7, 0.5}, {-0.2, 0.9, 0.4}};
  expect_seen_as_put<AnyBodyMotion>(top.problem<double>(), any);
  expect_seen_as_put<SpinlessMotion>(top.problem<double>(), any);
}

// Both have the same changes at a state, to the rounding of their sums.
TEST(DisturbedMotion, ThePlainRateIsThatOfTheRecordedList) {
  Scenario scenario = testing::toy_top();
  testing::set_principal(scenario.body, 1.2e-4, 1.5e-4, 4e-5);
  const Scene scene(scenario);
  const MotionProblem<double> problem = scene.problem<double>();
  const DisturbedMotion<AnyBodyMotion> system(problem.model, AnyBodyMotion(problem, release_of(problem)));
  auto x = moved(system);
  for (std::size_t d = 0; d < kDisturbances; ++d)
    system.put({{0.3, -0.7, 0.5 + double(d)}, {-0.2, 0.9 - double(d), 0.4}}, x, d);
  std::decay_t<decltype(x)> written, orders[2] = {x};
  PlainRate<DisturbedMotion<AnyBodyMotion>> rate(system);
  rate(x, written, 0);
  auto series = system.series();
  series.start(x, 0);
  series.expand(orders, 1);
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(written[i], orders[1][i], kRounding) << i;
}

// The gimbal lets the wheel turn about Up and about its axis, and these turns change the rate with the carrier's.
TEST(DisturbedMotion, AWheelTakesWhatItsGimbalAllows) {
  const Scene wheel(testing::gyrocompass(40, 25, 0));
  const MotionProblem<double> problem = wheel.problem<double>();
  const DisturbedMotion<WheelMotion> held(problem.model, WheelMotion(problem, release_of(problem)));
  const DisturbedMotion<AnyBodyMotion> free(problem.model, AnyBodyMotion(problem, release_of(problem)));
  auto x = held.initial_state();
  auto y = free.initial_state();
  for (std::size_t d = 0; d < kDisturbances; ++d) {
    const Disturbance any{{0.3, -0.7, 0.5 + double(d)}, {-0.2, 0.9, 0.4 - double(d)}};
    held.put(any, x, d), free.put(any, y, d);
  }
  free.restrict(y);
  for (std::size_t d = 0; d < kDisturbances; ++d) {
    const Disturbance a = held.disturbances(x)[d], b = free.disturbances(y)[d];
    EXPECT_LE(norm(Vec3<double>(a.theta_B - b.theta_B)), kRounding);
    EXPECT_LE(norm(Vec3<double>(a.dw_B - b.dw_B)), kRounding);
  }
}

}  // namespace
}  // namespace earthtop
