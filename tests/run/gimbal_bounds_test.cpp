// SPDX-License-Identifier: GPL-3.0-or-later
/// The bounds of more random suspensions than the gate has time for.
#include "support/gimbal_bounds.hpp"

namespace earthtop {

TEST(SuspensionBounds, HoldOverRandomScenes) { testing::expect_bounds_of_suspensions(71, 14); }

TEST(SuspensionBounds, ObserversAgreeOverRandomScenes) { testing::expect_formulations_agree(72, 60); }

}  // namespace earthtop
