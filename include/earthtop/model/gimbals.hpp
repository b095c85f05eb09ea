// SPDX-License-Identifier: GPL-3.0-or-later
/// A Cardan suspension (gimbals_spec.hpp): the geometry, the outer gimbal and the bearings.
///
///   R_PA = R_0 Rz(alpha),  R_0 = Rz(90 deg - azimuth) Ry(tilt)      outer gimbal A; its axis 3 is the outer axis a
///   R_PB = R_PA Rx(skew) Ry(beta)                                   body B; its axis 2 is the inner axis b
///
/// P is the platform, or the laboratory where there is none. Axis 1 of A is normal to both axes.
#pragma once

#include "earthtop/members.hpp"
#include "earthtop/model/gimbals_spec.hpp"
#include "earthtop/model/moving_masses.hpp"
#include "earthtop/model/platform.hpp"
#include "earthtop/model/release_spec.hpp"

namespace earthtop {

/// The torque of a bearing: -k r - T r / sqrt(r^2 + d^2) - D (angle - rest), where r is the rate about its axis.
template <class T>
struct Bearing {
  bool locked = false;
  T viscous = T(0), coulomb = T(0), regularisation = T(0);
  T torsion = T(0), rest = T(0);
  EARTHTOP_MEMBERS(locked, viscous, coulomb, regularisation, torsion, rest)
};
/// @tparam S  T, or a pair of T
template <class T, class S>
S bearing_torque(const Bearing<T>& bearing, const S& angle, const S& rate) {
  S torque = S(-bearing.viscous) * rate;
  if (!(bearing.torsion == T(0))) torque -= S(bearing.torsion) * (angle - S(bearing.rest));
  if (bearing.coulomb == T(0)) return torque;
  using real::sqrt;
  return torque - S(bearing.coulomb) * (rate / sqrt(S(rate * rate + S(bearing.regularisation * bearing.regularisation))));
}

/// The angles of both gimbals and their rates.
template <class T>
struct GimbalAngles {
  T outer = T(0), inner = T(0);            ///< alpha, beta
  T outer_rate = T(0), inner_rate = T(0);  ///< relative to the part that carries the axis
  EARTHTOP_MEMBERS(outer, inner, outer_rate, inner_rate)
};

/// Moments about the point where the axes meet of all that a gimbal carries: inertia, second moment, mass moment.
template <class T>
struct GimbalMoments {
  Mat3<T> I = Mat3<T>::Zero(), S = Mat3<T>::Zero();
  Vec3<T> mass_moment = Vec3<T>::Zero();
  EARTHTOP_MEMBERS(I, S, mass_moment)
};

template <class T>
struct Gimbals {
  Quaternion<T> q_P0 = {};             ///< R_0 of the table above
  Mat3<T> R_P0 = Mat3<T>::Identity();  ///< the same
  T skew_cos = T(1), skew_sin = T(0);
  Quaternion<T> q_skew = {};  ///< the turn by the skew
  GimbalMoments<T> ring;      ///< of the outer gimbal with the masses on it at t = 0, in its axes A
  MovingMasses<T> masses;     ///< that move on it
  Bearing<T> outer, inner;
  GimbalAngles<T> release;  ///< the rates as given
  bool has_rotor = false;
  EARTHTOP_MEMBERS(q_P0, R_P0, skew_cos, skew_sin, q_skew, ring, masses, outer, inner, release, has_rotor)
};

/// The suspension in SI units.   @param masses  all that ride on either gimbal; those of the outer one are taken
template <class T>
Gimbals<T> make_gimbals(const GimbalsSpec& spec, const GimbalReleaseSpec& release, const std::vector<MovingMassSpec>& masses,
                        bool has_rotor);
/// The same in a model's units.
template <class T>
Gimbals<T> in_units(Gimbals<T> gimbals, int mass_exponent, int time_exponent);

/// The attitude R_PB, as a quaternion that is continuous in both angles.
template <class T>
Quaternion<T> gimbal_attitude(const Gimbals<T>& gimbals, const T& outer, const T& inner) {
  const auto turn = [](int axis, const T& angle) {
    const SinCos<T> half = real::sin_cos(T(angle / T(2)));
    Quaternion<T> q{half.cos, Vec3<T>::Zero()};
    q.v[axis] = half.sin;
    return q;
  };
  return gimbals.q_P0 * turn(2, outer) * gimbals.q_skew * turn(1, inner);
}

#define EARTHTOP_GIMBALS(T)                                                                                                 \
  extern template Gimbals<T> make_gimbals(const GimbalsSpec&, const GimbalReleaseSpec&, const std::vector<MovingMassSpec>&, \
                                          bool);                                                                            \
  extern template Gimbals<T> in_units(Gimbals<T>, int, int);
EARTHTOP_GIMBALS(double)
EARTHTOP_GIMBALS(float80)
EARTHTOP_GIMBALS(float128)
#undef EARTHTOP_GIMBALS

}  // namespace earthtop
