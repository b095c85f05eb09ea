// SPDX-License-Identifier: GPL-3.0-or-later
/// Scenarios in which one input (scenario/inputs.hpp) is a little larger or smaller.
#pragma once

#include "earthtop/model/body.hpp"
#include "earthtop/scenario/inputs.hpp"
#include "earthtop/scene/scene.hpp"

namespace earthtop {

/// The value of an input that the scene has, in its unit.
double value_of_input(const Scene& scene, std::size_t input);
/// The size of an input in its unit, or of the quantity with which it is compared: a radian for an angle, and a size of the scene
/// for a number that is 0.
double scale_of_input(const Scene& scene, std::size_t input);

/// Changes the body's ratio I3/I1 or the distance of its centre of mass; its other numbers about the pivot stay unchanged.
template <class T>
void move_body(Body<T>& body, InputKind kind, T step) {
  if (kind == InputKind::center_of_mass) {
    const T l = norm(body.p_PBcm_B);
    if (l > T(0))
      body.p_PBcm_B *= (l + step) / l;
    else
      body.p_PBcm_B[2] += step;
    return;
  }
  body.I_BP_B(2, 2) += step * body.I_BP_B(0, 0);
  body.I_BP_B_inverse = body.I_BP_B.inverse();
  body.S_BP_B = body.I_BP_B.trace() / T(2) * Mat3<T>::Identity() - body.I_BP_B;
}

/// Gives a scenario another body, by mass, centre of mass and moments about the pivot.
/// @param body  as Scene::body has it: with the rotor, which the scenario's body does not contain
void set_body(Scenario& scenario, const Scene& scene, const Body<double>& body);

/// A scenario with one input changed, and by how much it was changed, in the input's unit, after rounding.
struct MovedScenario {
  Scenario scenario;
  double change;
};
MovedScenario with_moved_input(const Scene& scene, std::size_t input, double step);

}  // namespace earthtop
