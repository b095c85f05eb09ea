// SPDX-License-Identifier: GPL-3.0-or-later
/// The torques beside gravity and the Earth's as a scenario gives them; their formulas are in applied_torques.hpp.
#pragma once

#include <optional>

namespace earthtop {

/// Boundary layer on a rotating disc: laminar below a Reynolds number of 3e5, turbulent above; automatic decides at release.
enum class DiscFlow { automatic, laminar, turbulent };

/// A disc that turns in still air, both sides wetted, edge not counted. Air at 20 deg C and 101325 Pa if not given.
struct AirDragSpec {
  double disc_radius_m = 0;
  double density_kg_m3 = 1.204;
  double kinematic_viscosity_m2_s = 1.516e-5;
  DiscFlow flow = DiscFlow::automatic;
  bool operator==(const AirDragSpec&) const = default;
};

/// The Earth's gravity gradient: the radial term about the geocentric vertical, the whole tensor of the normal field, or a
/// radial term of given strength about Up.
enum class GradientField { radial, normal, given };
struct GravityGradientSpec {
  GradientField field = GradientField::radial;
  double gm_over_r3_s2 = 0;  ///< of a given one
  bool operator==(const GravityGradientSpec&) const = default;
};

/// Holds body axis 3 level on the platform; it turns freely about Up but for damping.
struct GimbalSpec {
  double damping_N_m_s = 0;
  bool operator==(const GimbalSpec&) const = default;
};

/// The torques as a scenario gives them; 0 and none: off.
struct AppliedTorquesSpec {
  double viscous_N_m_s = 0;
  double quadratic_N_m_s2 = 0;
  double coulomb_N_m = 0;
  std::optional<AirDragSpec> air_drag;
  std::optional<GravityGradientSpec> gravity_gradient;
  std::optional<GimbalSpec> gimbal;
  bool operator==(const AppliedTorquesSpec&) const = default;

  bool any() const {
    return viscous_N_m_s != 0 || quadratic_N_m_s2 != 0 || coulomb_N_m != 0 || air_drag || gravity_gradient || gimbal;
  }
  bool friction() const { return viscous_N_m_s != 0 || quadratic_N_m_s2 != 0 || coulomb_N_m != 0 || air_drag; }
};

}  // namespace earthtop
