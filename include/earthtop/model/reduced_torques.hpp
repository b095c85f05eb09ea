// SPDX-License-Identifier: GPL-3.0-or-later
/// The torques on a symmetric top in axes that do not spin with it: gravity, gravity gradient, an unequal support, a given
/// torque, friction and air drag. None of them depends on the angle through which the top has turned about its axis, so that
/// the reduced form (reduced_top.hpp) holds with them: only the spin, constant without them, gets an equation of its own. The
/// formulas are templates on the scalar, as those in body axes are (applied_torques.hpp).
#pragma once

#include "earthtop/model/applied_torques.hpp"
#include "earthtop/model/reduced_top.hpp"

namespace earthtop {

/// The quantities of a motion on which the torques depend, all in the same axes A.
template <class S>
struct SeenBesideAxis {
  Vec3<S> n;                        ///< the axis of symmetry
  Vec3<S> u;                        ///< inertial rate of the body normal to the axis
  S w3;                             ///< that along the axis
  Vec3<S> w_IP;                     ///< inertial rate of the platform, or of the laboratory if there is none
  Vec3<S> field;                    ///< acceleration field at the pivot: apparent gravity, tide, minus the pivot's acceleration
  std::array<Vec3<S>, 2> gradient;  ///< directions of the terms of the gradient tensor
  Vec3<S> east, north;              ///< axes 1 and 2 of the laboratory
  Vec3<S> given;                    ///< the given torque, where it is given in laboratory axes
  S given_along;                    ///< where it is given in body axes: along the axis
};

/// Sets the directions of the torques that act, and the given torque.   @param see  takes a vector that is at rest in the
/// laboratory to the axes A
template <class T, class S, class See>
void see_torques(const ReducedTop<T>& top, const Model<T>& model, const T& t, const See& see, SeenBesideAxis<S>& seen) {
  const AppliedTorques<T>& applied = model.applied;
  for (std::size_t i = 0; i < 2; ++i)
    if (applied.gradient[i].strength != T(0)) seen.gradient[i] = see(applied.gradient[i].direction_L);
  if (applied.support.acts()) seen.east = see(Vec3<T>(Vec3<T>::UnitX())), seen.north = see(Vec3<T>(Vec3<T>::UnitY()));
  if (!applied.given.acts) return;
  const Vec3<T> given = applied.given.at(t);
  if (applied.given.in_laboratory)
    seen.given = see(given);
  else
    seen.given_along = S(given[top.axis]);
}

/// The effect of the torques on a symmetric top.
template <class S>
struct AxisTorques {
  Vec3<S> across;  ///< torque normal to the axis, divided by I1
  S along;         ///< torque along the axis, divided by I3: the rate of change of the spin
};

/// @param mass_moment  (m l / I1), see moment_factor
template <class T, class S>
AxisTorques<S> axis_torques(const ReducedTop<T>& top, const Model<T>& model, const S& mass_moment,
                            const SeenBesideAxis<S>& seen) {
  const AppliedTorques<T>& applied = model.applied;
  const auto dot = [](const Vec3<S>& a, const Vec3<S>& b) { return S(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]); };
  AxisTorques<S> torques{Vec3<S>(mass_moment * Vec3<S>(seen.n.cross(seen.field))), S(T(0))};
  for (std::size_t i = 0; i < 2; ++i) {
    if (applied.gradient[i].strength == T(0)) continue;
    // k u x (Theta u) with Theta = I1 + (I3 - I1) n n^T
    const Vec3<S>& u = seen.gradient[i];
    const T factor = applied.gradient[i].strength * ((top.I3 - top.I1) / top.I1);
    torques.across += S(S(factor) * dot(seen.n, u)) * Vec3<S>(u.cross(seen.n));
  }
  if (applied.support.acts()) {
    // The torques of the stiffness along East and North and between them: K_EE n_E (E x n), K_EN (n_N E + n_E N) x n, K_NN n_N (N x n)
    const SupportStiffness<T>& K = applied.support;
    const S n_east = dot(seen.n, seen.east), n_north = dot(seen.n, seen.north);
    const S of_east = S(K.east / top.I1) * n_east + S(K.east_north / top.I1) * n_north;
    const S of_north = S(K.east_north / top.I1) * n_east + S(K.north / top.I1) * n_north;
    torques.across += of_east * Vec3<S>(seen.east.cross(seen.n)) + of_north * Vec3<S>(seen.north.cross(seen.n));
  }
  if (applied.given.acts && applied.given.in_laboratory) {
    const S along = dot(seen.given, seen.n);
    torques.across += S(T(1) / top.I1) * Vec3<S>(seen.given - along * seen.n);
    torques.along += S(T(1) / top.I3) * along;
  } else if (applied.given.acts) {
    torques.along += S(T(1) / top.I3) * seen.given_along;
  }
  if (!applied.friction()) return torques;
  // The rate relative to the platform, normal to the axis and along it.
  const S carried = dot(seen.n, seen.w_IP), spin = seen.w3 - carried;
  const Vec3<S> across = seen.u - Vec3<S>(seen.w_IP - carried * seen.n);
  const S coefficient = friction_coefficient(applied, S(dot(across, across) + spin * spin));
  torques.across -= S(coefficient * S(T(1) / top.I1)) * across;
  torques.along -= (spin_friction_coefficient(applied, coefficient, spin) * S(T(1) / top.I3)) * spin;
  if (applied.has_viscous_axes()) {
    torques.across -= S(applied.viscous_about((top.axis + 1) % 3) / top.I1) * across;
    torques.along -= S(applied.viscous_about(top.axis) / top.I3) * spin;
  }
  return torques;
}

/// Whether friction has no corner on the way of a symmetric top's motion, so that the equations have a Taylor series throughout.
/// Dry friction, quadratic drag and a disc's drag have one where the spin that they brake, which is relative to the platform or
/// the laboratory, goes through zero. With a carrier's rate of at most c the relative spin is at most w3 + c, and at least w3 - c.
///   Friction other than dry takes at most `decay` of w3 + c, and as its coefficient falls with the rate, w3 + c keeps
/// exp(-decay) of itself or more: above 2 c the relative spin keeps its sign, and 3 c has a margin for the Coriolis torque that a
/// scene leaves out, which changes w3 by at most twice the Earth's rate. Dry friction does not fall with the spin: there all of
/// friction together may take half of w3.
/// @param I3, w3  moment about the axis, and inertial spin at release   @param carrier_rate  largest rate of the platform, and of
/// the Earth   @param fastest_rate, duration  upper bound of all rates, and duration, of the whole motion
template <class T>
bool friction_stays_smooth(const AppliedTorques<T>& applied, T I3, T w3, T carrier_rate, T fastest_rate, T duration) {
  if (!applied.has_corner()) return true;
  constexpr double kOfTheRate = 0.05, kDry = 0.5, kOther = 4, kOfTheCarrier = 3;
  const T spin = real::abs(w3), relative = spin + carrier_rate;
  if (!(spin > T(kOfTheRate) * fastest_rate && relative > T(kOfTheCarrier) * carrier_rate)) return false;
  AppliedTorques<T> falling = applied;
  falling.coulomb = T(0);
  const T coefficient =
      spin_friction_coefficient(applied, friction_coefficient(falling, T(fastest_rate * fastest_rate)), relative);
  const T decay = (coefficient + applied.viscous_3) * duration / I3;
  if (applied.coulomb != T(0)) return applied.coulomb * duration / I3 + decay * relative <= T(kDry) * spin;
  return decay <= T(kOther) && relative * real::exp(-decay) > T(kOfTheCarrier) * carrier_rate;
}

}  // namespace earthtop
