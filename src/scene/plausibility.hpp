// SPDX-License-Identifier: GPL-3.0-or-later
/// Warnings about values that are allowed, but look like a mistake of unit.
#pragma once

#include "earthtop/scene/scene.hpp"
#include "input/section.hpp"

namespace earthtop {

/// Adds the warnings to the findings.
/// @param scene  scene of the decoded values; values that could not be decoded keep their defaults and are not judged
void warn_of_implausible(const input::Section& root, const Scene& scene);

}  // namespace earthtop
