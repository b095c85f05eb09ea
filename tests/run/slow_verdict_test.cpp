// SPDX-License-Identifier: GPL-3.0-or-later
// Verdicts on realistic gyrocompasses on the real Earth, over twenty periods; minutes of computing each.
#include <gtest/gtest.h>

#include <cmath>

#include "earthtop/run.hpp"
#include "support/effect_scenes.hpp"

namespace earthtop {
namespace {

TEST(SlowVerdict, TwentyPeriodsOfAGyrocompassAreReliable) {
  for (const auto& [spin_rad_s, damping] : {std::pair{2513.27, 1e-5}, {800.0, 1e-6}, {800.0, 0.0}}) {
    Scenario s = testing::gyrocompass(52, 20, damping);
    testing::set_principal(s.body, 9.1e-5, 9.1e-5, 1.42e-4);
    s.release.spin_rad_s = spin_rad_s;
    const double pull = 1.42e-4 * spin_rad_s * s.rotation_rate_rad_s * std::cos(52 * real::pi<double>() / 180);
    s.duration_s = 20 * 2 * real::pi<double>() * std::sqrt(9.1e-5 / pull);
    s.output_step_s = s.duration_s / 400;
    const RunResult result = run(s);
    EXPECT_EQ(result.status, RunStatus::completed);
    EXPECT_EQ(result.verdict.verdict, Verdict::reliable) << spin_rad_s << " " << damping << ": " << result.verdict.reason;
    EXPECT_FALSE(result.verdict.from_s);
    EXPECT_LE(result.verdict.lyapunov_exponent_1_s.value_or(0), 0);
  }
}

}  // namespace
}  // namespace earthtop
