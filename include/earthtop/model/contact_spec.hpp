// SPDX-License-Identifier: GPL-3.0-or-later
/// The contact of a top's spherical tip with a table, as a scenario gives it; the formulas are in contact_forces.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

namespace earthtop {

/// The law of sliding friction between tip and table; see contact_forces.hpp for the formulas. `rolling` is the constraint of no
/// slip.
enum class ContactLaw : std::uint8_t { frictionless, viscous, viscous_load, coulomb, contensou, rolling };

/// The point that is at rest at the release: the centre of the tip's sphere, the contact point (rolling without slip), or the centre of
/// mass (horizontally); or the velocity of the centre of the tip's sphere is given.
enum class ContactStart : std::uint8_t { tip_at_rest, rolling, center_of_mass_at_rest, tip_velocity };

/// A contact as a scenario gives it. A coefficient that its law does not use is ignored here; scenarios refuse it.
struct ContactSpec {
  double tip_radius_m = 0;  ///< 0: a point
  ContactLaw law = ContactLaw::frictionless;
  double sliding_viscosity_N_s_m = 0;  ///< k of `viscous`
  double sliding_viscosity_s_m = 0;    ///< mu_v of `viscous_load`
  double friction_coefficient = 0;     ///< mu of `coulomb` and `contensou`
  double regularisation_m_s = 0;       ///< slip below which `coulomb` is proportional to it; 0: the exact law
  double patch_radius_m = 0;           ///< radius of the contact patch of `contensou`
  /// mu_s of `rolling`: the largest friction over normal force that it may need; it decides nothing in the motion.
  std::optional<double> static_coefficient = {};
  double spinning_friction_m = 0;   ///< c_s: moment about the normal over normal force, under any law
  double rolling_resistance_m = 0;  ///< c_r: moment about horizontal axes over normal force, under any law
  double regularisation_rad_s = 0;  ///< rate below which these two moments are proportional to it
  ContactStart start = ContactStart::tip_at_rest;
  std::array<double, 2> tip_velocity_m_s = {0, 0};  ///< along axes 1 and 2 of the table (East, North if it is level)
  std::array<double, 2> tip_position_m = {0, 0};
  std::optional<double> max_tilt_deg = {};  ///< tilt from the normal at which rim or stem touches the table
  double table_tilt_deg = 0;                ///< angle of the table's normal to Up
  double table_tilt_azimuth_deg = 0;        ///< compass direction of steepest descent
  bool operator==(const ContactSpec&) const = default;
};

}  // namespace earthtop
