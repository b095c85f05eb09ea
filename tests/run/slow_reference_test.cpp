// SPDX-License-Identifier: GPL-3.0-or-later
/// Complete shipped scenarios compared with 113-bit arithmetic; each takes minutes.

#include <gtest/gtest.h>

#include "support/soundness.hpp"

namespace earthtop {
namespace {

class WholeScenario : public ::testing::TestWithParam<const char*> {};

TEST_P(WholeScenario, DriftAndBoundAgainstExtendedPrecision) {
  testing::expect_sound(testing::shipped(GetParam()), Observer::inertial);
}
INSTANTIATE_TEST_SUITE_P(Shipped, WholeScenario,
                         ::testing::Values("toy-top", "free-gyro", "asymmetric-top", "turntable", "fast-gyro"));

}  // namespace
}  // namespace earthtop
