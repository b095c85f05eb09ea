// SPDX-License-Identifier: GPL-3.0-or-later
/// The top as a rigid body on a fixed pivot: mass, centre of mass and inertia, given or computed from solids, and the
/// conditions for a physically possible body.
#pragma once

#include <string>
#include <vector>

#include "earthtop/error.hpp"
#include "earthtop/model/body_spec.hpp"
#include "earthtop/vectors.hpp"

namespace earthtop {

/// A rigid body on its pivot; all tensors are about the pivot P, in body axes B.
template <class T>
struct Body {
  T mass = T(0);                             ///< kg
  Vec3<T> p_PBcm_B = Vec3<T>::Zero();        ///< pivot to centre of mass (m)
  Mat3<T> I_BP_B = Mat3<T>::Zero();          ///< inertia tensor Theta (kg m^2)
  Mat3<T> S_BP_B = Mat3<T>::Zero();          ///< second moment, integral r r^T dm = (tr Theta / 2) 1 - Theta (kg m^2)
  Mat3<T> I_BP_B_inverse = Mat3<T>::Zero();  ///< inverse of I_BP_B (1/(kg m^2))

  /// Inertia about the centre of mass (kg m^2).
  Mat3<T> I_BBcm_B() const;
};

/// m (r^2 1 - r r^T): the term that is added to an inertia tensor about the centre of mass when the reference point is moved by
/// r (Steiner).
template <class T>
Mat3<T> point_mass_inertia(T mass, const Vec3<T>& r) {
  return mass * (r.dot(r) * Mat3<T>::Identity() - r * r.transpose());
}

template <class T>
Mat3<T> Body<T>::I_BBcm_B() const {
  return I_BP_B - point_mass_inertia(mass, p_PBcm_B);
}

/// Inverse of a symmetric 3x3 tensor by cofactors; for a diagonal tensor every diagonal entry is exactly 1/I.
template <class T>
Mat3<T> symmetric_inverse(const Mat3<T>& m) {
  if (m(0, 1) == T(0) && m(0, 2) == T(0) && m(1, 2) == T(0))
    return Vec3<T>(T(1) / m(0, 0), T(1) / m(1, 1), T(1) / m(2, 2)).asDiagonal();
  const Vec3<T> a = m.col(0), b = m.col(1), c = m.col(2);
  Mat3<T> cofactors;
  cofactors.col(0) = b.cross(c);
  cofactors.col(1) = c.cross(a);
  cofactors.col(2) = a.cross(b);
  const Mat3<T> inverse = cofactors / a.dot(b.cross(c));
  return (inverse + inverse.transpose()) / T(2);
}

/// The body that a specification describes, in any precision: the given doubles are taken as exact.
template <class T>
Body<T> make_body(const BodySpec& spec);
extern template Body<double> make_body(const BodySpec&);
extern template Body<float80> make_body(const BodySpec&);
extern template Body<float128> make_body(const BodySpec&);

/// Names the moments of a diagonal tensor that are 0 to round-off: "I1 and I2 are 0". Empty where there is none, and for a tensor with
/// products of inertia, whose moments have no such names.
std::string missing_moments(const Mat3<double>& inertia);

/// The reasons why a body is unphysical, each one sentence with a JSON pointer below /body. Conditions: the inertia tensor
/// about the pivot is positive definite; the moments about the centre of mass satisfy the triangle inequality, where equality
/// (flat bodies, rods, points) is allowed. Tolerance: 32 eps of the largest pivot moment.
/// @param has_rotor  whether a rotor belongs to the body, whose own tensor about the pivot may then be singular
std::vector<Diagnostic> body_violations(const BodySpec& spec, bool has_rotor = false);

/// The body axis (0, 1, 2) about which a body is a symmetric top: the two other principal moments are exactly equal,
/// products of inertia are exactly zero, and the centre of mass lies exactly on the axis. -1 if there is none.
/// @param center_B  the centre of mass, or any multiple of it
template <class T>
int symmetry_axis(const Mat3<T>& I_BP_B, const Vec3<T>& center_B) {
  if (I_BP_B(0, 1) != T(0) || I_BP_B(0, 2) != T(0) || I_BP_B(1, 2) != T(0)) return -1;
  for (const int axis : {2, 1, 0}) {
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    if (I_BP_B(a, a) == I_BP_B(b, b) && center_B[a] == T(0) && center_B[b] == T(0)) return axis;
  }
  return -1;
}
template <class T>
int symmetry_axis(const Body<T>& body) {
  return symmetry_axis(body.I_BP_B, body.p_PBcm_B);
}

}  // namespace earthtop
