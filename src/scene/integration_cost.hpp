// SPDX-License-Identifier: GPL-3.0-or-later
/// What one integration costs whose options are known, before any of it is done.
#pragma once

#include "earthtop/scene/scene.hpp"

namespace earthtop {

/// `Scene::work` and `Scene::seconds`.
Work integration_work(const Scene& scene, const IntegrationOptions& options);
double integration_seconds(const Scene& scene, const IntegrationOptions& options);

/// Seconds for one right-hand side of both predictions and the deviation between them, in double and in the general form, with
/// its share of the stepper.
double general_evaluation_seconds(const Scene& scene);

}  // namespace earthtop
