// SPDX-License-Identifier: GPL-3.0-or-later
/// A release as a scenario gives it: attitude and rates in the laboratory.
#pragma once

#include <array>
#include <optional>

namespace earthtop {

/// The frame relative to which the rates are given. It also sets the matching rule: both predictions start with equal rates
/// relative to this frame.
enum class RatesRelativeTo { laboratory, inertial };
enum class Precession { none, steady_slow, steady_fast, given };

/// Returns a rate in revolutions per minute as rad/s: the double nearest to rpm pi/30.
double rad_s_from_rpm(double rpm);

/// The release of a Cardan suspension: the angles of both gimbals and their rates (gimbals.hpp).
struct GimbalReleaseSpec {
  double outer_angle_deg = 0, inner_angle_deg = 0;
  double outer_rate_rad_s = 0, inner_rate_rad_s = 0;
  bool operator==(const GimbalReleaseSpec&) const = default;
};

/// A release as a scenario gives it. If given, the quaternion (w, x, y, z) replaces the three angles, and the body rates
/// replace spin and precession.
struct ReleaseSpec {
  double tilt_deg = 0;
  double azimuth_deg = 0;
  double spin_angle_deg = 0;
  std::optional<std::array<double, 4>> quaternion_LB;
  RatesRelativeTo rates_relative_to = RatesRelativeTo::laboratory;
  std::optional<std::array<double, 3>> angular_velocity_body_rad_s;
  double spin_rad_s = 0;
  Precession precession = Precession::none;
  double precession_rate_rad_s = 0;               ///< counterclockwise about Up; for Precession::given
  std::optional<GimbalReleaseSpec> gimbals = {};  ///< replaces all but the frame of the rates
  bool operator==(const ReleaseSpec&) const = default;
};

}  // namespace earthtop
