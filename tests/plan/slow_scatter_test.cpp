// SPDX-License-Identifier: GPL-3.0-or-later
// The same as many_scatter_test.cpp, of what takes a minute each.
#include <gtest/gtest.h>

#include "plan/scatter.hpp"

namespace earthtop::testing {
namespace {

TEST(PlanManyScatter, TurningPoints) { expect_scatter_as_planned("turning points"); }
TEST(PlanManyScatter, PassagesOfAStopwatch) { expect_scatter_as_planned("passages of a stopwatch"); }

}  // namespace
}  // namespace earthtop::testing
