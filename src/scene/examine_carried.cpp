// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of a body that a platform or a gimbal carries.
#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "earthtop/model/release.hpp"
#include "scene/support_laws.hpp"

namespace earthtop {

/// Checks that the periods of an unequal support are those of a pendulum: by them its stiffness is found.
void PivotLaws::check(const input::Section& root, const Scene& scene) const {
  const auto& support = scene.scenario().effects.applied.unequal_support;
  if (!support || !support->periods_s) return;
  if (scene.symmetry_axis() == 2 && scene.axial_gravity_torque_N_m() != 0) return;
  root.section("effects")
      .section("unequal_support")
      .refuse("periods_s",
              "are those of a pendulum that is symmetric about body axis 3, with its centre of mass on it, under gravity; give "
              "kappa_N_m");
}

void PlatformLaws::check(const input::Section& root, const Scene& scene) const {
  const AppliedTorquesSpec& applied = scene.scenario().effects.applied;
  const auto refuse = [&](const char* key) {
    root.section("effects").refuse_key(key, "is not available on a platform; leave one of the two out");
  };
  if (applied.gimbal) refuse("gimbal");
  if (applied.coulomb_N_m != 0) refuse("coulomb_torque_N_m");
}

/// Checks that a gimbal that holds the axis level gets an axis that is level and a rate that keeps it level.
void GimbalLaws::check(const input::Section& root, const Scene& scene) const {
  const input::Section effects = root.section("effects");
  constexpr double kLevel = 1e-12;
  const Scenario& scenario = scene.scenario();
  const Release<double>& release = scene.release<double>();
  const Mat3<double> R_LB = rotation_matrix(release.q_LB);
  const Vec3<double> up_B = R_LB.row(2).transpose();
  if (scenario.effects.applied.coulomb_N_m != 0)
    return effects.refuse_key("coulomb_torque_N_m", "is not available with a gimbal; give the gimbal a damping instead");
  if (std::abs(up_B[2]) > kLevel)
    return effects.refuse("gimbal", fmt::format("holds body axis 3 level, and the release tilts it by {:.6g} deg; give "
                                                "/release/tilt_deg 90, or leave the gimbal out",
                                                real::atan2(real::hypot(up_B[0], up_B[1]), up_B[2]) * 180 / std::numbers::pi));
  if (scenario.release.rates_relative_to == RatesRelativeTo::inertial)
    return effects.refuse(
        "gimbal",
        "holds body axis 3 level in the laboratory, and rates that are the same in inertial space would let it "
        "leave the level; give /release/rates_relative_to \"laboratory\"");
  const double leaving = release.w_XB_B.dot(up_B.cross(Vec3<double>::UnitZ()));
  if (std::abs(leaving) > kLevel * norm(release.w_XB_B))
    effects.refuse("gimbal", fmt::format("holds body axis 3 level, and the release turns it out of the level at {:.6g} rad/s; "
                                         "give rates about axis 3 and Up only",
                                         std::abs(leaving)));
}

}  // namespace earthtop
