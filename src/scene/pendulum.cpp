// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/pendulum.hpp"

#include "earthtop/model/body.hpp"
#include "earthtop/scenario/support.hpp"
#include "scene/caged_top.hpp"

namespace earthtop {

std::optional<SymmetricTop<double>> pendulum_of(const Scene& scene) {
  if (scene.support().kind != SupportKind::pivot || scene.symmetry_axis() != 2 || is_caged_top(scene.scenario()))
    return std::nullopt;
  const double torque_N_m = scene.axial_gravity_torque_N_m();
  if (torque_N_m == 0) return std::nullopt;
  const Body<double>& body = scene.body<double>();
  return SymmetricTop<double>{body.I_BP_B(0, 0), body.I_BP_B(2, 2), torque_N_m};
}

}  // namespace earthtop
