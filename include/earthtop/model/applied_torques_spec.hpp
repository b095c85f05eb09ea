// SPDX-License-Identifier: GPL-3.0-or-later
/// The applied torques (those besides gravity and the Earth's rotation) as a scenario gives them; their formulas are in
/// applied_torques.hpp.
#pragma once

#include <array>
#include <optional>

#include "earthtop/frames/angle_table.hpp"

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

/// A support that is stiffer, or softer, along a horizontal direction e of the laboratory: its energy is kappa (n.e)^2 / 2,
/// with body axis 3 as n. Of a pendulum the periods of its small swings may be given in place of kappa.
struct UnequalSupportSpec {
  double kappa_N_m = 0;
  std::optional<std::array<double, 2>> periods_s = {};  ///< along e, and across it: only their ratio counts
  double azimuth_deg = 0;                               ///< compass azimuth of e
  bool operator==(const UnequalSupportSpec&) const = default;
};

/// A torque that is given as a function of time, in body axes or in laboratory axes: constant, harmonic (its amplitude times
/// sin(2 pi f t + phase)), or a table of its three components.
enum class TorqueCourse { constant, harmonic, table };
enum class TorqueAxes { body, laboratory };
struct GivenTorqueSpec {
  TorqueCourse course = TorqueCourse::constant;
  TorqueAxes axes = TorqueAxes::body;
  std::array<double, 3> torque_N_m = {0, 0, 0};
  double frequency_hz = 0, phase_deg = 0;
  std::array<FiledTable, 3> components = {};  ///< of TorqueCourse::table (N m); all of them from one file
  bool operator==(const GivenTorqueSpec&) const = default;
};

/// The force of the air on a top that stands on a table, at its centre of mass: -(b + c |v|) v for its velocity v.
struct AirForceSpec {
  double linear_N_s_m = 0, quadratic_N_s2_m2 = 0;
  bool operator==(const AirForceSpec&) const = default;
};

/// The applied torques as a scenario gives them; zero or absent means off.
struct AppliedTorquesSpec {
  double viscous_N_m_s = 0;
  double quadratic_N_m_s2 = 0;
  double coulomb_N_m = 0;
  std::optional<AirDragSpec> air_drag;
  std::optional<GravityGradientSpec> gravity_gradient;
  std::optional<GimbalSpec> gimbal;
  std::optional<std::array<double, 3>> viscous_by_axis_N_m_s = {};  ///< of each body axis apart; `viscous_N_m_s` is then 0
  std::optional<UnequalSupportSpec> unequal_support = {};
  std::optional<GivenTorqueSpec> given_torque = {};
  std::optional<AirForceSpec> air_force = {};
  bool operator==(const AppliedTorquesSpec&) const = default;

  bool any() const { return *this != AppliedTorquesSpec{}; }
  /// Whether anything rubs: what is neither the gradient nor the gimbal, a support or a given torque.
  bool friction() const {
    AppliedTorquesSpec rubbing = *this;
    rubbing.gravity_gradient.reset(), rubbing.gimbal.reset(), rubbing.unequal_support.reset(), rubbing.given_torque.reset();
    return rubbing.any();
  }
  /// Whether nothing acts but an unequal support, whose energy depends on the axis alone.
  bool support_alone() const {
    AppliedTorquesSpec others = *this;
    others.unequal_support.reset();
    return unequal_support && !others.any();
  }
};

}  // namespace earthtop
