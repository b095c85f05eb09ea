// SPDX-License-Identifier: GPL-3.0-or-later
// Estimates from 1,000 simulated measurements scatter as planned.
#include <gtest/gtest.h>

#include "plan/scatter.hpp"

namespace earthtop::testing {
namespace {

TEST(PlanManyScatter, HeavyTop) { expect_scatter_as_planned("heavy top"); }
TEST(PlanManyScatter, Friction) { expect_scatter_as_planned("friction"); }
TEST(PlanManyScatter, Gyrocompass) { expect_scatter_as_planned("gyrocompass"); }
TEST(PlanManyScatter, TiltedMount) { expect_scatter_as_planned("tilted mount"); }
TEST(PlanManyScatter, ClockOffset) { expect_scatter_as_planned("clock offset"); }
TEST(PlanManyScatter, RatesOfAPhone) { expect_scatter_as_planned("rates of a phone"); }
TEST(PlanManyScatter, TwoReleases) { expect_scatter_as_planned("two releases"); }

}  // namespace
}  // namespace earthtop::testing
