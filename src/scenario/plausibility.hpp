// SPDX-License-Identifier: GPL-3.0-or-later
/// Values that are allowed, but look like a mistake of unit: what a colleague would ask about.
#pragma once

#include "earthtop/scenario/scenario.hpp"
#include "input/section.hpp"

namespace earthtop::scenario {

using input::Section;

/// Adds warnings. @param scenario  as decoded so far: what could not be decoded has its initial value and is passed over
void warn_of_implausible(const Section& root, const Scenario& scenario);

}  // namespace earthtop::scenario
