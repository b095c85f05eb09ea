// SPDX-License-Identifier: GPL-3.0-or-later
// Over a million steps round-off makes a random walk without a trend.
#include <gtest/gtest.h>

#include "support/random_walk.hpp"
#include "support/scenes.hpp"

namespace earthtop {
namespace {

TEST(TaylorRoundOff, JacobiIntegralOfTheToyTopWalksAtRandom) { testing::expect_random_walk(testing::toy_top(), 19000, 9e5); }

}  // namespace
}  // namespace earthtop
