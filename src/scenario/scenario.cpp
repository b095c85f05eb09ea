// SPDX-License-Identifier: GPL-3.0-or-later
// Copies, moves, ends and comparisons of a Scenario: much code, which sources that hold one would each compile for themselves.
#include "earthtop/scenario/scenario.hpp"

namespace earthtop {

Scenario::Scenario() = default;
Scenario::Scenario(const Scenario&) = default;
Scenario::Scenario(Scenario&&) noexcept = default;
Scenario& Scenario::operator=(const Scenario&) = default;
Scenario& Scenario::operator=(Scenario&&) noexcept = default;
Scenario::~Scenario() = default;
bool Scenario::operator==(const Scenario&) const = default;

}  // namespace earthtop
