// SPDX-License-Identifier: GPL-3.0-or-later
// Over a million steps round-off makes a random walk without a trend, also for three different moments of inertia.
#include <gtest/gtest.h>

#include "support/random_walk.hpp"
#include "support/scenes.hpp"

namespace earthtop {
namespace {

TEST(TaylorRoundOff, JacobiIntegralOfTheAsymmetricTopWalksAtRandom) {
  testing::expect_random_walk(testing::asymmetric_top(), 15500, 9e5);
}

}  // namespace
}  // namespace earthtop
