// SPDX-License-Identifier: GPL-3.0-or-later
/// What the closed forms say of a scenario: whether it has one, and how finely its motion has to be looked at.
#pragma once

#include "earthtop/closed_form/exact_kind.hpp"
#include "earthtop/scenario/scenario.hpp"

namespace earthtop {

ExactKind closed_form_kind(const Scenario& scenario);

/// How fast both motions and the laboratory turn together (rad/s), without the spin of a top that is symmetric about body axis
/// 3. @param scenario  with a closed form
double closed_form_turn_rate_rad_s(const Scenario& scenario);

}  // namespace earthtop
