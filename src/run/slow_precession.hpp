// SPDX-License-Identifier: GPL-3.0-or-later
/// The slow precession of a fast symmetric top, and what the Earth's rate changes of it, where friction or a given torque along the axis
/// changes the spin, or a table without friction carries the tip.
#pragma once

#include <optional>

#include "earthtop/model/applied_torques.hpp"
#include "earthtop/vectors.hpp"

namespace earthtop {

/// A symmetric top whose axis precesses slowly and hardly nutates. The moments are about the pivot; on a table without friction they
/// are about the centre of mass.
struct SlowTop {
  double I1 = 0, I3 = 0, mgl = 0;
  double tilting =
      0;  ///< the largest moment that resists a change of the tilt: on a table the centre of mass moves up and down, too
  AppliedTorques<double> applied;           ///< friction, and a given torque along the axis
  Vec3<double> W_L = Vec3<double>::Zero();  ///< the Earth's rate (rad/s), without a part to the East
  double cos_tilt = 0, azimuth_rad = 0;     ///< of the axis at release; the azimuth is counterclockwise from East
  Vec3<double> w_L = Vec3<double>::Zero();  ///< rate at release (rad/s)
  bool in_laboratory = true;                ///< whether this rate is that in the laboratory in both predictions
};

/// The precession of the non-rotating prediction, and what the Earth changes of it.
struct SlowPrecession {
  double first_rad_s = 0, last_rad_s = 0;  ///< rates of precession, counterclockwise about Up
  double last_spin_rad_s = 0;
  double turned_rad = 0;    ///< azimuth by which the axis has precessed
  double drift_rad = 0;     ///< drift of the azimuth, counterclockwise
  double left_out_rad = 0;  ///< size of what the theory leaves out of the drift
  double period_s = 0;      ///< of the nutation at the end
  double smallness = 0;     ///< largest of |p/nutation|, which the theory takes as small
};

/// With p the rate of precession, S = I3 w3 and u = cos(tilt), a top without nutation has
///   I1 u p^2 - S p + m g l = 0 ,   L_Up = I1 p (1 - u^2) + S u ,
/// and the Hamiltonian H(L_Up, S) - W.L, whose derivatives give the azimuth's rate and dL_Up/dt; friction and a torque along the
/// axis add to dL_Up/dt and dS/dt. The drift is the difference of two such motions, with and without the Earth.
/// @returns nothing where the top is not fast, comes near the vertical, or would need too many steps
std::optional<SlowPrecession> slow_precession(const SlowTop& top, double duration_s);

}  // namespace earthtop
