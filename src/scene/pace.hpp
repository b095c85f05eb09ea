// SPDX-License-Identifier: GPL-3.0-or-later
/// The rates of a scene and how long they last: what decides how many steps its integrations take.
#pragma once

#include "earthtop/scene/scene.hpp"

namespace earthtop {

PlatformDemand demand_of(const Scene& scene);

/// `Scene::fastest_rate_rad_s`.
double fastest_rate_of(const Scene& scene);

struct Paced {
  Pace pace;
  StiffFriction stiffest;
};
Paced paced(const Scene& scene);

}  // namespace earthtop
