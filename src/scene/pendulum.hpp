// SPDX-License-Identifier: GPL-3.0-or-later
/// Which scenes are pendulums: those of which swing_of (closed_form/swing.hpp) tells the ellipse.
#pragma once

#include <optional>

#include "earthtop/closed_form/state.hpp"
#include "earthtop/scene/scene.hpp"

namespace earthtop {

/// The pendulum of a scene: a rigid body on a pivot at rest in the laboratory, symmetric about axis 3, on which its centre of mass lies.
/// Friction may damp it. @returns nothing for other scenes
std::optional<SymmetricTop<double>> pendulum_of(const Scene& scene);

}  // namespace earthtop
