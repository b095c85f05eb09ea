// SPDX-License-Identifier: GPL-3.0-or-later
// Estimates from 1,000 simulated measurements scatter as planned, within 8 %: 3.6 times the 2.2 % by which the standard deviation of
// 1,000 normal numbers scatters itself. Their mean is within 0.1 planned errors of the truth, 3.2 times its own standard error. The fits'
// own standard errors are the planned ones, within 5 %.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "plan/scatter.hpp"

namespace earthtop::testing {
namespace {

/// @param name  of the case
void expect_scatter_as_planned(const std::string& name) {
  for (const ScatterCase& what : scatter_cases()) {
    if (what.name != name) continue;
    const Scatter scatter = scatter_of(what, 1000);
    for (std::size_t j = 0; j < scatter.names.size(); ++j) {
      const std::string number = name + ' ' + scatter.names[j];
      fmt::print("{}: scatter {:.4f} of the planned one, mean {:+.4f} planned errors, fitted error {:.4f} of it\n", number,
                 scatter.over_prediction[j], scatter.mean_pull[j], scatter.fitted_error[j]);
      EXPECT_NEAR(scatter.fitted_error[j], 1, 0.05) << number;  // planned at the truth, fitted next to it
      EXPECT_NEAR(scatter.over_prediction[j], 1, 0.08) << number;
      EXPECT_NEAR(scatter.mean_pull[j], 0, 0.1) << number;
    }
    return;
  }
  FAIL() << "no case " << name;
}

TEST(PlanManyScatter, HeavyTop) { expect_scatter_as_planned("heavy top"); }
TEST(PlanManyScatter, Friction) { expect_scatter_as_planned("friction"); }
TEST(PlanManyScatter, Gyrocompass) { expect_scatter_as_planned("gyrocompass"); }
TEST(PlanManyScatter, TiltedMount) { expect_scatter_as_planned("tilted mount"); }
TEST(PlanManyScatter, ClockOffset) { expect_scatter_as_planned("clock offset"); }
TEST(PlanManyScatter, TwoReleases) { expect_scatter_as_planned("two releases"); }

}  // namespace
}  // namespace earthtop::testing
