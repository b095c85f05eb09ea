// SPDX-License-Identifier: GPL-3.0-or-later
/// How the top is released: attitude and rates in the laboratory, converted to initial conditions.
#pragma once

#include "earthtop/frames/earth.hpp"
#include "earthtop/model/body.hpp"
#include "earthtop/model/release_spec.hpp"

namespace earthtop {

/// Attitude and rates at release: q_LB, and the body's rate relative to the frame X that the matching rule names.
template <class T>
struct Release {
  Quaternion<T> q_LB;
  Vec3<T> w_XB_B = Vec3<T>::Zero();  ///< rad/s
  RatesRelativeTo X = RatesRelativeTo::laboratory;
};

/// A release as the equations take it: with its rates in a model's units (NaturalUnits).
template <class T>
struct NaturalRelease {
  Quaternion<T> q_LB;
  Vec3<T> w_XB_B = Vec3<T>::Zero();  ///< rad per unit of time
  RatesRelativeTo X = RatesRelativeTo::laboratory;

  /// The body's inertial rate on the rotating Earth, in body axes.   @param W_L  the Earth's rate
  Vec3<T> inertial_rate_B(const Vec3<T>& W_L) const {
    return X == RatesRelativeTo::inertial ? w_XB_B : Vec3<T>(w_XB_B + transposed_times(rotation_matrix(q_LB), W_L));
  }
};

/// R_LB = Rz(90 deg - azimuth) Ry(tilt) Rz(spin angle): the axis leans by `tilt` toward the compass azimuth. Exact at multiples
/// of 90 degrees.
template <class T>
Quaternion<T> release_attitude(double tilt_deg, double azimuth_deg, double spin_angle_deg);

/// The steady precession rate v (rad/s, counterclockwise about Up) of the non-rotating symmetric top whose angular velocity has
/// the component w3 along the axis:  I1 cos(tilt) v^2 - I3 w3 v + m g l = 0. The slow root is computed without dividing by
/// cos(tilt).
/// @throws ScenarioError with the reason if there is no steady rate
template <class T>
T steady_precession_rate(const Body<T>& body, const Quaternion<T>& q_LB, T gravity, T w3, Precession which);

/// @throws ScenarioError if the steady precession asked for does not exist
template <class T>
Release<T> make_release(const ReleaseSpec& spec, const Body<T>& body, T gravity);
extern template Release<double> make_release(const ReleaseSpec&, const Body<double>&, double);
extern template Release<float80> make_release(const ReleaseSpec&, const Body<float80>&, float80);
extern template Release<float128> make_release(const ReleaseSpec&, const Body<float128>&, float128);

}  // namespace earthtop
