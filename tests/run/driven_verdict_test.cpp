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

constexpr double kDrive = 0.1;  // h in theta'' + w0^2 (1 + h cos w t) theta = 0
constexpr double kI1 = 1.2e-4, kGravity = 9.8;
const double kSwing = std::sqrt(0.1 * kGravity * 0.03 / kI1);  // w0 (rad/s)

/// A spinless top that hangs at rest. Its pivot lies to the North of the platform's horizontal axis, so that a small turn a of the
/// platform lifts it by d sin(a): with an amplitude A the height is accelerated by d A w^2, which is h g.
/// @param ratio  frequency of the platform over that of the pendulum
Scenario driven_pendulum(double ratio, double duration_s) {
  Scenario s = testing::toy_top();
  s.site.gravity_m_s2 = kGravity;
  testing::set_principal(s.body, kI1, kI1, 4e-5);
  s.release.tilt_deg = 180, s.release.spin_rad_s = 0;
  constexpr double kOffset = 0.05;
  const double w = ratio * kSwing;
  PlatformSpec& platform = s.platform.emplace();
  platform.motion = PlatformMotion::harmonic, platform.axis = {1, 0, 0};
  platform.amplitude_rad = kDrive * kGravity / (w * w * kOffset);
  platform.frequency_hz = w / (2 * testing::kPi);
  platform.pivot_offset_m = {0, kOffset, 0};
  s.duration_s = duration_s, s.output_step_s = duration_s / 50;
  return s;
}

/// The rate at which disturbances grow from 10 s to 20 s, while the swing is still small.
double growth_rate_1_s(double ratio) {
  const auto problem = Scene(driven_pendulum(ratio, 20)).problem<double>();
  const auto log_growth = [&](double end_s) {
    const GrowthReport report = disturbance_growth(problem, MotionKind::rotating, end_s, 1e-10);
    EXPECT_TRUE(report.completed);
    return report.mean_exponent_1_s * report.end_s;
  };
  return (log_growth(20) - log_growth(10)) / 10;
}

// Inside of the tongue |ratio - 2| < h/2 the rate is w0 sqrt((h/4)^2 - (ratio/2 - 1)^2), to shares of the order of h
// [L. D. Landau, E. M. Lifshitz, Mechanics, section 27]. Outside there is none: a swing's frequency differs between neighbours.
TEST(DrivenVerdict, DisturbancesGrowAsInMathieusTongue) {
  for (const double ratio : {1.98, 2.0, 2.02}) {
    const double detuning = ratio / 2 - 1, expected = kSwing * std::sqrt(kDrive * kDrive / 16 - detuning * detuning);
    EXPECT_NEAR(growth_rate_1_s(ratio), expected, 0.1 * expected) << ratio;
  }
  for (const double ratio : {1.9, 2.1}) EXPECT_LT(growth_rate_1_s(ratio), 0.1 * kSwing * kDrive / 4 + 0.07) << ratio;
}

TEST(DrivenVerdict, APendulumIsUnstableInTheTongueOnly) {
  const RunResult inside = run(driven_pendulum(2, 60)), outside = run(driven_pendulum(1.9, 60));
  // In the tongue the swing grows until its own frequency leaves the resonance; after that nothing grows, so it is not chaotic.
  EXPECT_EQ(inside.verdict.verdict, Verdict::unstable) << inside.verdict.reason;
  EXPECT_LE(inside.verdict.lyapunov_exponent_1_s.value_or(0), 0);
  EXPECT_EQ(outside.verdict.verdict, Verdict::reliable) << outside.verdict.reason;
}

}  // namespace
}  // namespace earthtop
