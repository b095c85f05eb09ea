// SPDX-License-Identifier: GPL-3.0-or-later
/// A rotor in the body as a scenario gives it.
#pragma once

#include <array>

#include "earthtop/frames/angle_table.hpp"

namespace earthtop {

/// What gives a rotor its rate: nothing but its bearing, or a motor that keeps it at a given one.
enum class RotorDrive { none, constant, ramp, harmonic, table };

/// All vectors in body axes.
struct RotorSpec {
  double mass_kg = 0;
  double axial_kg_m2 = 0;                      ///< about its axis
  double transverse_kg_m2 = 0;                 ///< across it, about its own centre
  std::array<double, 3> axis = {0, 0, 1};      ///< of any length but zero
  std::array<double, 3> center_m = {0, 0, 0};  ///< its centre, from the pivot
  double spin_rad_s = 0;  ///< rate relative to the body, at release or of its drive; not of a table, which has it
  RotorDrive drive = RotorDrive::none;
  double acceleration_rad_s2 = 0;  ///< of a ramp
  double amplitude_rad_s = 0;      ///< of a harmonic drive, with the next two
  double frequency_hz = 0;
  double phase_deg = 0;
  double viscous_torque_N_m_s = 0;  ///< of the bearing, with the next two
  double coulomb_torque_N_m = 0;
  double regularisation_rad_s = 0;
  FiledTable table = {};  ///< of rates, for RotorDrive::table

  bool operator==(const RotorSpec&) const = default;
  bool has_friction() const { return viscous_torque_N_m_s != 0 || coulomb_torque_N_m != 0; }
};

}  // namespace earthtop
