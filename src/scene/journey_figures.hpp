// SPDX-License-Identifier: GPL-3.0-or-later
/// The figures of a journey.
#pragma once

#include "earthtop/scene/scene.hpp"
#include "earthtop/scene/top_figures.hpp"

namespace earthtop {

/// @param scene  must have a journey
JourneyFigures journey_figures_of(const Scene& scene);

/// The azimuth of the horizontal part of a rate in East, North, Up (rad, clockwise from North).
double azimuth_of(const Vec3<double>& rate_L);

}  // namespace earthtop
