// SPDX-License-Identifier: GPL-3.0-or-later
/// The applied torques (those besides gravity and the Earth's rotation) as a scenario gives them; their formulas are in
/// applied_torques.hpp.
#pragma once

#include <optional>

namespace earthtop {

/// Boundary layer on a rotating disc: laminar below a Reynolds number of 3e5, turbulent above. `automatic` decides by the spin
/// at release.
enum class DiscFlow { automatic, laminar, turbulent };

/// A disc that turns in still air: both faces count, the edge does not. The defaults are air at 20 deg C and 101325 Pa.
struct AirDragSpec {
  double disc_radius_m = 0;
  double density_kg_m3 = 1.204;
  double kinematic_viscosity_m2_s = 1.516e-5;
  DiscFlow flow = DiscFlow::automatic;
  bool operator==(const AirDragSpec&) const = default;
};

/// The Earth's gravity gradient: only the radial term about the geocentric vertical, the whole tensor of the normal field, or a
/// radial term of given strength about Up.
enum class GradientField { radial, normal, given };
struct GravityGradientSpec {
  GradientField field = GradientField::radial;
  double gm_over_r3_s2 = 0;  ///< for GradientField::given
  bool operator==(const GravityGradientSpec&) const = default;
};

/// A gimbal that holds body axis 3 level on the platform; the axis turns freely about Up, apart from damping.
struct GimbalSpec {
  double damping_N_m_s = 0;
  bool operator==(const GimbalSpec&) const = default;
};

/// The applied torques as a scenario gives them; zero or absent means off.
struct AppliedTorquesSpec {
  double viscous_N_m_s = 0;
  double quadratic_N_m_s2 = 0;
  double coulomb_N_m = 0;
  std::optional<AirDragSpec> air_drag;
  std::optional<GravityGradientSpec> gravity_gradient;
  std::optional<GimbalSpec> gimbal;
  bool operator==(const AppliedTorquesSpec&) const = default;

  bool any() const { return *this != AppliedTorquesSpec{}; }
  /// Whether anything rubs: what is neither the gradient nor the gimbal.
  bool friction() const {
    AppliedTorquesSpec rubbing = *this;
    rubbing.gravity_gradient.reset(), rubbing.gimbal.reset();
    return rubbing.any();
  }
};

}  // namespace earthtop
