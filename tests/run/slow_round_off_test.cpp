// SPDX-License-Identifier: GPL-3.0-or-later
/// Round-off over a hundred million steps; some five minutes each.
#include "support/random_walk.hpp"
#include "support/scenes.hpp"

namespace earthtop {
namespace {

TEST(SlowRoundOff, JacobiIntegralOfTheToyTopWalksAtRandom) { testing::expect_random_walk(testing::toy_top(), 2.0e6, 9e7); }
TEST(SlowRoundOff, JacobiIntegralOfTheAsymmetricTopWalksAtRandom) {
  testing::expect_random_walk(testing::asymmetric_top(), 1.6e6, 9e7);
}

}  // namespace
}  // namespace earthtop
