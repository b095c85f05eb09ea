// SPDX-License-Identifier: GPL-3.0-or-later
/// A platform as a scenario gives it.
#pragma once

#include <array>

#include "earthtop/frames/angle_table.hpp"

namespace earthtop {

/// `course`: a vehicle that turns with the course of the laboratory's journey.
enum class PlatformMotion { constant, ramp, harmonic, table, course };

/// A platform as a scenario gives it. P is parallel to L when the angle is 0.
struct PlatformSpec {
  PlatformMotion motion = PlatformMotion::constant;
  std::array<double, 3> axis = {0, 0, 1};  ///< in L; of any length but zero
  double rate_rad_s = 0;
  double acceleration_rad_s2 = 0;
  double amplitude_rad = 0;
  double frequency_hz = 0;
  double phase_deg = 0;
  std::array<double, 3> pivot_offset_m = {0, 0, 0};  ///< in P
  FiledTable table = {};                             ///< of angles, for PlatformMotion::table

  bool operator==(const PlatformSpec&) const = default;
};

}  // namespace earthtop
