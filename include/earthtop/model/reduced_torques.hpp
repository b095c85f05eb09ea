// SPDX-License-Identifier: GPL-3.0-or-later
/// The torques on a symmetric top in axes that do not spin with it: gravity, gravity gradient, friction and air drag. None of
/// them depends on the angle through which the top has turned about its axis, so that the reduced form (reduced_top.hpp) holds
/// with them: only the spin, constant without them, gets an equation of its own. The formulas are templates on the scalar, as
/// those in body axes are (applied_torques.hpp).
#pragma once

#include "earthtop/model/applied_torques.hpp"
#include "earthtop/model/reduced_top.hpp"

namespace earthtop {

/// The quantities of a motion on which the torques depend, all in the same axes A.
template <class S>
struct SeenBesideAxis {
  Vec3<S> n;      ///< the axis of symmetry
  Vec3<S> w_IB;   ///< inertial rate of the body
  Vec3<S> w_IP;   ///< inertial rate of the platform, or of the laboratory if there is none
  Vec3<S> field;  ///< acceleration field at the pivot: apparent gravity, tide, less the pivot's acceleration
  std::array<Vec3<S>, 2> gradient;  ///< directions of the terms of the gradient tensor
};

/// What the torques do to a symmetric top.
template <class S>
struct AxisTorques {
  Vec3<S> across;  ///< torque normal to the axis, divided by I1
  S along;         ///< torque along the axis, divided by I3: the rate of change of the spin
};

/// @param mass_moment  (m l / I1), see moment_factor
template <class T, class S>
AxisTorques<S> axis_torques(const ReducedTop<T>& top, const AppliedTorques<T>& applied, const S& mass_moment,
                            const SeenBesideAxis<S>& seen) {
  const auto dot = [](const Vec3<S>& a, const Vec3<S>& b) { return S(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]); };
  AxisTorques<S> torques{Vec3<S>(mass_moment * Vec3<S>(seen.n.cross(seen.field))), S(T(0))};
  for (std::size_t i = 0; i < 2; ++i) {
    if (applied.gradient[i].strength == T(0)) continue;
    // k u x (Theta u) with Theta = I1 + (I3 - I1) n n^T
    const Vec3<S>& u = seen.gradient[i];
    const T factor = applied.gradient[i].strength * ((top.I3 - top.I1) / top.I1);
    torques.across += S(S(factor) * dot(seen.n, u)) * Vec3<S>(u.cross(seen.n));
  }
  if (!applied.friction()) return torques;
  const Vec3<S> w_PB = seen.w_IB - seen.w_IP;
  const S spin = dot(seen.n, w_PB), coefficient = friction_coefficient(applied, w_PB);
  torques.across -= S(coefficient * S(T(1) / top.I1)) * Vec3<S>(w_PB - spin * seen.n);
  S along = coefficient;
  if (applied.disc_laminar != T(0) || applied.disc_turbulent != T(0)) along += disc_drag_coefficient(applied, spin);
  torques.along = -(along * S(T(1) / top.I3)) * spin;
  return torques;
}

}  // namespace earthtop
