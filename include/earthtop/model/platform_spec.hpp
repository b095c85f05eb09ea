// SPDX-License-Identifier: GPL-3.0-or-later
/// A platform as a scenario gives it.
#pragma once

#include <array>
#include <memory>
#include <string>

#include "earthtop/frames/angle_table.hpp"

namespace earthtop {

enum class PlatformMotion { constant, ramp, harmonic, table };

/// A platform as a scenario gives it. P is parallel to L when the angle is 0.
struct PlatformSpec {
  PlatformMotion motion = PlatformMotion::constant;
  std::array<double, 3> axis = {0, 0, 1};  ///< in L; of any length but zero
  double rate_rad_s = 0;
  double acceleration_rad_s2 = 0;
  double amplitude_rad = 0;
  double frequency_hz = 0;
  double phase_deg = 0;
  std::array<double, 3> pivot_offset_m = {0, 0, 0};   ///< in P
  std::shared_ptr<const AngleTable> table = nullptr;  ///< for PlatformMotion::table; copies share it
  std::string file = {};                              ///< file of the table, as the scenario names it
  std::string file_sha256 = {};                       ///< hash of that file's bytes

  /// Two tables are equal if their rows are.
  bool operator==(const PlatformSpec& other) const {
    const bool same_table = table == other.table || (table && other.table && *table == *other.table);
    return same_table && motion == other.motion && axis == other.axis && rate_rad_s == other.rate_rad_s &&
           acceleration_rad_s2 == other.acceleration_rad_s2 && amplitude_rad == other.amplitude_rad &&
           frequency_hz == other.frequency_hz && phase_deg == other.phase_deg && pivot_offset_m == other.pivot_offset_m &&
           file == other.file && file_sha256 == other.file_sha256;
  }
};

}  // namespace earthtop
