// SPDX-License-Identifier: GPL-3.0-or-later
/// The bounds of more random gyrostats than the gate has time for.
#include "support/rotor_bounds.hpp"

namespace earthtop {

TEST(GyrostatBounds, HoldOverRandomScenes) { testing::expect_bounds_of_gyrostats(53, 14); }

TEST(GyrostatBounds, ObserversAgreeOverRandomScenes) { testing::expect_observers_agree(63, 60); }

}  // namespace earthtop
