// SPDX-License-Identifier: GPL-3.0-or-later
/// Checks of a scene's contact with a table that need its body and release.
#pragma once

#include "earthtop/scene/scene.hpp"
#include "input/section.hpp"

namespace earthtop {

/// Refuses a contact that has no motion, or none that can be followed: a body without extent about its centre of mass, a rim that
/// touches at the release, a table that would have to pull, no unique force (Painleve's paradox), a slip that dies out too fast.
/// @param scene  must have a contact and a release
void check_contact(const input::Section& root, const Scene& scene);

/// Warns of lengths and coefficients that look like a mistake of unit.
void warn_of_contact(const input::Section& contact, const Scene& scene);

/// The rate (1/s) at which friction lets a small slip die out at the release, as steps of an explicit method have to follow it;
/// infinite where a law has a corner there, and 0 without sliding friction. @param scene  must have a contact and a release
double slip_relaxation_rate_per_s(const Scene& scene);

}  // namespace earthtop
