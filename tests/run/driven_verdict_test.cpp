// SPDX-License-Identifier: GPL-3.0-or-later
// Verdicts on a pendulum that a harmonic platform drives up and down: it is Mathieu's equation, whose first tongue of resonance is
// known.
#include <gtest/gtest.h>

#include <cmath>

#include "earthtop/drift/growth.hpp"
#include "earthtop/run.hpp"
#include "support/effect_scenes.hpp"

namespace earthtop {
namespace {

constexpr double kDriven = 0.1;  // h in theta'' + w0^2 (1 + h cos w t) theta = 0
constexpr double kPendulumMoment = 1.2e-4, kDrivenGravity = 9.8;
const double kSwing = std::sqrt(0.1 * kDrivenGravity * 0.03 / kPendulumMoment);  // w0 (rad/s)

/// A spinless top that hangs at rest. Its pivot lies to the North of the platform's horizontal axis, so that a small turn a of the
/// platform lifts it by d sin(a): with an amplitude A the height is accelerated by d A w^2, which is h g.
/// The platform also pulls the pendulum outwards, which gives it a swing of about h g / (15 d w^2) rad to begin with.
/// @param ratio  frequency of the platform over that of the pendulum   @param offset_m  d
Scenario driven_pendulum(double ratio, double duration_s, double offset_m) {
  Scenario s = testing::toy_top();
  s.site.gravity_m_s2 = kDrivenGravity;
  testing::set_principal(s.body, kPendulumMoment, kPendulumMoment, 4e-5);
  s.release.tilt_deg = 180, s.release.spin_rad_s = 0;
  const double w = ratio * kSwing;
  PlatformSpec& platform = s.platform.emplace();
  platform.motion = PlatformMotion::harmonic, platform.axis = {1, 0, 0};
  platform.amplitude_rad = kDriven * kDrivenGravity / (w * w * offset_m);
  platform.frequency_hz = w / (2 * testing::kPi);
  platform.pivot_offset_m = {0, offset_m, 0};
  s.duration_s = duration_s, s.output_step_s = duration_s / 50;
  return s;
}

/// The rate at which disturbances grow from 25 s to 40 s: then the swing's exceed those that grow with the time, and the swing
/// itself, of 1e-8 rad at first, is still small.
double growth_rate_1_s(double ratio) {
  const auto problem = Scene(driven_pendulum(ratio, 40, 500)).problem<double>();
  const auto log_growth = [&](double end_s) {
    const GrowthReport report = disturbance_growth(problem, MotionKind::reference, end_s, 1e-10);
    EXPECT_TRUE(report.completed);
    return report.mean_exponent_1_s * report.end_s;
  };
  return (log_growth(40) - log_growth(25)) / 15;
}

// Inside of the tongue |ratio - 2| < h/2 the rate is w0 sqrt((h/4)^2 - (ratio/2 - 1)^2), to shares of the order of h
// [L. D. Landau, E. M. Lifshitz, Mechanics, section 27]. Outside there is none: a swing's frequency differs between neighbours.
TEST(DrivenVerdict, DisturbancesGrowAsInMathieusTongue) {
  for (const double ratio : {1.98, 2.0, 2.02}) {
    const double detuning = ratio / 2 - 1, expected = kSwing * std::sqrt(kDriven * kDriven / 16 - detuning * detuning);
    EXPECT_NEAR(growth_rate_1_s(ratio), expected, 0.1 * expected) << ratio;
  }
  for (const double ratio : {1.9, 2.1}) EXPECT_LT(growth_rate_1_s(ratio), 0.1 * kSwing * kDriven / 4 + 0.07) << ratio;
}

TEST(DrivenVerdict, APendulumIsUnstableInTheTongueOnly) {
  const RunResult growing = run(driven_pendulum(2, 50, 500)), outside = run(driven_pendulum(1.9, 50, 500));
  EXPECT_EQ(growing.verdict.verdict, Verdict::unstable) << growing.verdict.reason;
  EXPECT_GT(growing.verdict.lyapunov_exponent_1_s.value_or(0), 0);
  EXPECT_EQ(outside.verdict.verdict, Verdict::reliable) << outside.verdict.reason;
  // A swing that is larger at first grows until its own frequency has left the resonance. After that nothing grows: that is not
  // chaos.
  const RunResult grown = run(driven_pendulum(2, 60, 0.05));
  EXPECT_EQ(grown.verdict.verdict, Verdict::unstable) << grown.verdict.reason;
  EXPECT_LE(grown.verdict.lyapunov_exponent_1_s.value_or(1), 0);
}

}  // namespace
}  // namespace earthtop
