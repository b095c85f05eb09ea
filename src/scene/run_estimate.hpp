// SPDX-License-Identifier: GPL-3.0-or-later
/// What a whole run costs, before any of it is done: its estimate, its refusal where it is too dear, and the shares of its
/// phases for those who show how far it is.
#pragma once

#include "earthtop/scene/scene.hpp"

namespace earthtop {

/// `Scene::estimate` and `Scene::require_affordable`.
RunEstimate estimate_run(const Scene& scene);
void refuse_unaffordable(const Scene& scene);

/// Seconds for the derivatives of the drift by so many inputs, followed from the release to `time_s`.
double sensitivity_seconds(const Scene& scene, double time_s, double relative_tolerance, std::size_t inputs);

}  // namespace earthtop
