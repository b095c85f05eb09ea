// SPDX-License-Identifier: GPL-3.0-or-later
/// Values that are allowed, but look like a mistake of unit: what a colleague would ask about.
#pragma once

#include "earthtop/scene/scene.hpp"
#include "input/section.hpp"

namespace earthtop {

/// Adds warnings. @param scene  of what was decoded: what could not be decoded has its initial value and is passed over
void warn_of_implausible(const input::Section& root, const Scene& scene);

}  // namespace earthtop
