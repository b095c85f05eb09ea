// SPDX-License-Identifier: GPL-3.0-or-later
/// A Cardan suspension as a scenario gives it: an outer gimbal on an axis fixed in the laboratory or on the platform, and in it, on the
/// inner axis, the body, which is the inner gimbal.
#pragma once

#include <optional>

#include "earthtop/model/body_spec.hpp"

namespace earthtop {

/// The bearing of a gimbal's axis, and what else acts between the two parts that it joins.
struct BearingSpec {
  bool locked = false;
  double viscous_torque_N_m_s = 0;
  double coulomb_torque_N_m = 0;
  double regularisation_rad_s = 0;
  double torsion_N_m_rad = 0;   ///< of a spring or a tape
  double torsion_rest_deg = 0;  ///< angle at which it exerts no torque
  bool operator==(const BearingSpec&) const = default;
};

struct GimbalsSpec {
  double axis_tilt_deg = 0;      ///< of the outer axis, from Up
  double axis_azimuth_deg = 0;   ///< compass azimuth that the outer axis leans toward
  std::optional<BodySpec> ring;  ///< the outer gimbal, in its own axes; none: massless
  BearingSpec outer;
  double axis_skew_deg = 0;  ///< of the inner axis, from the perpendicular to the outer one
  BearingSpec inner;
  bool operator==(const GimbalsSpec&) const = default;
};

}  // namespace earthtop
