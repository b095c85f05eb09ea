// SPDX-License-Identifier: GPL-3.0-or-later
/// What "auto" means for a scene. The choice knows what one integration costs with given options, and nothing of a whole run.
#pragma once

#include "earthtop/scene/scene.hpp"

namespace earthtop {

/// `Scene::choice`.
MethodChoice choose_method(const Scene& scene);

}  // namespace earthtop
