// SPDX-License-Identifier: GPL-3.0-or-later
/// An event of a suspension on its way, on the rotating Earth.
#pragma once

#include <optional>
#include <string_view>

namespace earthtop {

enum class GimbalEventKind {
  gimbal_lock_passed,  ///< the angle of the rotor's axis to the outer axis passes through its least, below a degree
  rotor_reversed       ///< the rotor's rate in the body changes its sign
};
constexpr std::string_view to_string(GimbalEventKind kind) {
  return kind == GimbalEventKind::gimbal_lock_passed ? "gimbal_lock_passed" : "rotor_reversed";
}

struct GimbalEvent {
  GimbalEventKind kind = GimbalEventKind::gimbal_lock_passed;
  double t_s = 0;
  double axis_angle_rad = 0;        ///< of the rotor's axis to the line of the outer axis
  double outer_rate_rad_s = 0;      ///< of the outer gimbal, which is fastest near gimbal lock
  std::optional<double> bound_s{};  ///< bound on the error of `t_s`; none where a second integration has no such event
};

}  // namespace earthtop
