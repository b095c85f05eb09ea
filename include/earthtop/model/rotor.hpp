// SPDX-License-Identifier: GPL-3.0-or-later
/// A rotor that turns in the body: a symmetric part on an axis c that is fixed there. As it is symmetric, neither its angle nor the place
/// of its centre along c matters to the motion: it adds its inertia to the body's, and a momentum about c.
///
/// | rotor          | inertia I_BP_B of the model | momentum inside the body           | its rate                        |
/// | free           | Theta0, without C c c^T     | h c, h = C (w.c + sigma)            | Q_c c, the torque of its bearing |
/// | driven         | Theta, with C c c^T         | C sigma(t) c                        | C dsigma/dt c                   |
///
/// where C is its axial moment, sigma its rate relative to the body and w the body's rate: relative to inertial space, or to the
/// laboratory where the momentum is that of rates relative to the laboratory. The total momentum is I w + (momentum inside).
///
/// Masses that move in the body (moving_masses.hpp) add their own momentum l to that inside the body, to its rate dl/dt + (dTheta/dt) w in
/// the equation for w, and to the velocity moment their J. They are the same in both motions and for every observer.
///
/// In [F] (torques.hpp) the velocity moment of a rigid body vanishes for an observer who sits in it. That of a rotor does not: with
/// r' = sigma c x rho its J is -(C sigma / 2) [c]x, whose Coriolis torque is -w x (C sigma c), the gyroscopic torque.
#pragma once

#include <type_traits>

#include "earthtop/frames/prescribed_motion.hpp"
#include "earthtop/members.hpp"
#include "earthtop/model/moving_masses.hpp"
#include "earthtop/model/paired.hpp"
#include "earthtop/model/torques.hpp"

namespace earthtop {

template <class T>
struct Rotor {
  bool driven = false;                ///< whether a motor gives it its rate
  Vec3<T> axis_B = Vec3<T>::UnitZ();  ///< c, a unit vector
  T axial = T(1);                     ///< C, its moment of inertia about c
  Mat3<T> S_B = Mat3<T>::Zero();      ///< its second moment about its own centre
  T spin = T(0);                      ///< its rate relative to the body at release
  T viscous = T(0);                   ///< torque of the bearing over the rate
  T coulomb = T(0);                   ///< torque of dry friction in the bearing
  T regularisation = T(0);            ///< rate below which dry friction is like viscous friction
  PrescribedMotion<T> drive = {};     ///< the rate of a driven rotor (rad/s) as a function of time, in place of an angle
  T rate_unit = T(1);                 ///< 1 rad/s in the model's units
  EARTHTOP_MEMBERS(driven, axis_B, axial, S_B, spin, viscous, coulomb, regularisation, drive, rate_unit)

  T driven_rate(const T& t) const { return rate_unit * drive.angle(t); }
  T driven_acceleration(const T& t) const { return rate_unit * drive.angle_rate(t); }
};

/// The torque of the bearing on the rotor about its axis: -k sigma - T sigma / sqrt(sigma^2 + delta^2).
/// @tparam S  T, or a pair of T   @param sigma  the rotor's rate relative to the body
template <class T, class S>
S bearing_torque(const Rotor<T>& rotor, const S& sigma) {
  S torque = S(-rotor.viscous) * sigma;
  if (rotor.coulomb == T(0)) return torque;
  using real::sqrt;
  return torque - S(rotor.coulomb) * (sigma / sqrt(S(sigma * sigma + S(rotor.regularisation * rotor.regularisation))));
}

/// The velocity moment of a rotor relative to the body, -(C sigma / 2) [c]x.
template <class T>
Mat3<T> spin_velocity_moment(const Rotor<T>& rotor, const T& sigma) {
  return cross_matrix(Vec3<T>((-rotor.axial * sigma / T(2)) * rotor.axis_B));
}

/// What turns or moves inside the body in one motion: nothing, or a rotor and masses.
struct NothingInside {};
template <class T>
struct RotorInside {
  Vec3<T> momentum_B;         ///< see the table above
  Vec3<T> momentum_rate_B;    ///< its rate, seen from the body
  Mat3<T> velocity_moment_B;  ///< relative to the body
  T spin;                     ///< sigma
  T torque;                   ///< of the bearing, Q_c; 0 for a driven rotor
  const MassSums<T>* masses;  ///< of what moves in the body; null if nothing does
};
/// @param h  momentum about the axis; not read for a driven rotor   @param w_B  the body's rate that belongs to it, a function of
/// the momentum inside the body   @param masses  the sums over masses that move in the body at this time; null without any
template <class T, class Rate>
RotorInside<T> rotor_inside(const Rotor<T>& rotor, const T& h, const T& t, const MassSums<T>* masses, const Rate& w_B) {
  RotorInside<T> inside;
  inside.spin = rotor.driven ? rotor.driven_rate(t) : T(0);
  inside.masses = masses;
  inside.momentum_B = (rotor.driven ? T(rotor.axial * inside.spin) : h) * rotor.axis_B;
  if (masses) inside.momentum_B += masses->momentum;
  if (!rotor.driven) inside.spin = h / rotor.axial - rotor.axis_B.dot(w_B(inside.momentum_B));
  inside.torque = rotor.driven ? T(0) : bearing_torque(rotor, inside.spin);
  inside.momentum_rate_B = (rotor.driven ? T(rotor.axial * rotor.driven_acceleration(t)) : inside.torque) * rotor.axis_B;
  inside.velocity_moment_B = spin_velocity_moment(rotor, inside.spin);
  if (masses) inside.momentum_rate_B += masses->momentum_rate, inside.velocity_moment_B += masses->velocity_moment;
  return inside;
}
/// The same in both motions.
template <class T>
struct RotorInsideBoth {
  RotorInside<T> reference;
  Vec3<T> rotating_B;           ///< momentum of the rotating motion
  Vec3<T> difference_B_scaled;  ///< of the momenta, over epsilon
  Mat3<T> velocity_moment_B;    ///< of the rotating motion
  Paired<T> spin, torque;
};
/// @param h  momentum about the axis in both   @param w_B, Dw_B  functions: the reference's rate from the momentum inside the body, and
/// the difference of the rates over epsilon from that of the momenta
template <class T, class Rate, class Difference>
RotorInsideBoth<T> rotor_inside_both(const Rotor<T>& rotor, const Paired<T>& h, const T& epsilon, const T& t,
                                     const MassSums<T>* masses, const Rate& w_B, const Difference& Dw_B) {
  RotorInsideBoth<T> both;
  both.reference = rotor_inside(rotor, h.ref, t, masses, w_B);
  both.difference_B_scaled = (rotor.driven ? T(0) : h.diff) * rotor.axis_B;
  both.rotating_B = both.reference.momentum_B + epsilon * both.difference_B_scaled;
  const T difference = rotor.driven ? T(0) : T(h.diff / rotor.axial - rotor.axis_B.dot(Dw_B(both.difference_B_scaled)));
  both.spin = Paired<T>::apart(both.reference.spin, difference, epsilon);
  both.torque = rotor.driven ? Paired<T>(T(0)) : bearing_torque(rotor, both.spin);
  both.velocity_moment_B = spin_velocity_moment(rotor, both.spin.rot);
  if (masses) both.velocity_moment_B += masses->velocity_moment;
  return both;
}

template <class Inside>
inline constexpr bool kTurnsInside = !std::is_same_v<Inside, NothingInside>;

/// A total momentum without that of what turns or moves inside the body, which leaves I w.
template <class T, class Inside>
Vec3<T> without_inside(const Vec3<T>& momentum_B, const Inside& inside) {
  if constexpr (kTurnsInside<Inside>)
    return momentum_B - inside.momentum_B;
  else
    return momentum_B;
}
/// The same of the difference of two momenta over epsilon.
template <class T, class Inside>
Vec3<T> without_difference(const Vec3<T>& difference_B_scaled, const Inside& inside) {
  if constexpr (kTurnsInside<Inside>)
    return difference_B_scaled - inside.difference_B_scaled;
  else
    return difference_B_scaled;
}

/// The velocity moment (torques.hpp) of all parts in axes A, from which R_AB turns to the body's.
/// @param S_BP_A, w_AB_A  second moment of all, and the body's rate in the observing frame
template <class T, class Inside>
Mat3<T> velocity_moment(const Mat3<T>& S_BP_A, const Vec3<T>& w_AB_A, const Mat3<T>& R_AB, const Inside& inside) {
  if constexpr (kTurnsInside<Inside>)
    return velocity_moment(S_BP_A, w_AB_A) + turned_tensor(R_AB, inside.velocity_moment_B);
  else
    return velocity_moment(S_BP_A, w_AB_A);
}
/// The same in body axes.
template <class T, class Inside>
Mat3<T> velocity_moment_B(const Mat3<T>& S_BP_B, const Vec3<T>& w_AB_B, const Inside& inside) {
  if constexpr (kTurnsInside<Inside>)
    return velocity_moment(S_BP_B, w_AB_B) + inside.velocity_moment_B;
  else
    return velocity_moment(S_BP_B, w_AB_B);
}

}  // namespace earthtop
