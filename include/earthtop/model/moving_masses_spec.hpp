// SPDX-License-Identifier: GPL-3.0-or-later
/// Masses that motors move on given paths, as a scenario gives them.
#pragma once

#include <array>
#include <vector>

#include "earthtop/frames/angle_table.hpp"

namespace earthtop {

/// The part that carries a mass, in whose axes its path is given: the body, or the outer gimbal.
enum class MassCarrier { body, outer };

enum class MassMotion { fixed, harmonic, circle, waypoints, table };

/// One mass; all vectors from the pivot, in the axes of its carrier.
struct MovingMassSpec {
  double mass_kg = 0;
  MassCarrier carrier = MassCarrier::body;
  MassMotion motion = MassMotion::fixed;
  std::array<double, 3> center_m = {0, 0, 0};     ///< where a fixed mass is, and the middle of a harmonic motion or of a circle
  std::array<double, 3> amplitude_m = {0, 0, 0};  ///< of a harmonic motion
  std::array<double, 3> start_m = {0, 0, 0};      ///< of a circle: from its centre to the mass at the phase 0
  std::array<double, 3> axis = {0, 0, 1};         ///< of a circle, across `start_m`; of any length but zero
  double frequency_hz = 0;                        ///< of a circle with its sign, which is that of the turn about the axis
  double phase_deg = 0;
  std::vector<double> times_s = {};                  ///< of waypoints: ascending, from 0 on
  std::vector<std::array<double, 3>> points_m = {};  ///< one for each time
  std::array<FiledTable, 3> coordinates = {};        ///< of a table, which is one file: its three coordinates (m)

  bool operator==(const MovingMassSpec&) const = default;
  bool moves() const { return motion != MassMotion::fixed; }
};

}  // namespace earthtop
