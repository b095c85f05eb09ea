// SPDX-License-Identifier: GPL-3.0-or-later
/// The forces on a top whose tip touches a table: friction under each law, the air, the field on the centre of mass, and the
/// torques about it that are not the table's. Each formula is a template on its scalar S: with Paired<T> it gives both
/// predictions and their difference without cancellation. Vectors are in any axes A that all arguments share.
///
/// Friction is affine in the normal force N: force F = N phi + F0, moment M = N mh, by
///
/// | law          | F                                    | M                                                          |
/// | frictionless | 0                                    | 0                                                          |
/// | viscous      | -k v_P                               | 0                                                          |
/// | viscous_load | -mu_v N v_P                          | 0                                                          |
/// | coulomb      | -mu N v_P / sqrt(v_P^2 + eps^2)      | 0                                                          |
/// | contensou    | -mu N v_P / sqrt(v_P^2 + (a u)^2)    | -(3 pi/16) mu N R u / sqrt(u^2 + (b v_P)^2) z , u = R w.z  |
/// | rolling      | of the constraint v_P = 0            | 0                                                          |
///
/// with a = 8/(3 pi), b = 15 pi/16: both limits, of slip and of spin, are those of a patch of radius R under Hertz pressure.
/// Under any law, spinning friction adds -c_s N w_z/sqrt(w_z^2 + floor^2) z, and rolling resistance the same for w's horizontal
/// part. w is the rate relative to the table, v_P the velocity of the body's point at P relative to it.
#pragma once

#include "earthtop/model/contact.hpp"
#include "earthtop/model/contact_algebra.hpp"

namespace earthtop {

/// Friction as an affine function of the normal force.
template <class S>
struct Friction {
  Vec3<S> force_per_normal, force;  ///< phi and F0
  Vec3<S> moment_per_normal;        ///< mh
};

/// The action of the table on the body.
template <class S>
struct ContactReaction {
  S normal_force = S(0);
  /// The denominator of the normal force, times the mass. It is positive; at 0 and below no unique force exists (Painleve's paradox).
  S denominator = S(1);
  Vec3<S> friction;  ///< F
  Vec3<S> moment;    ///< M
};

/// The surroundings of the body at one time.
template <class S>
struct ContactSurroundings {
  Vec3<S> normal;   ///< z of the table
  Vec3<S> gravity;  ///< apparent gravity and tide at the origin of the laboratory
  Vec3<S> W;        ///< the Earth's rate; 0 for a motion without it
  Mat3<S> gradient;
};

/// x / sqrt(x.x + floor^2), and 0 where both are 0.
template <class S>
Vec3<S> regularised_direction(const Vec3<S>& x, const S& floor_squared) {
  using real::sqrt;
  const S square = inner(x, x) + floor_squared;
  if (!is_above_zero(square)) return Vec3<S>(S(0) * x);
  return S(S(1) / sqrt(square)) * x;
}

/// @param v_P  slip   @param w  rate of the body relative to the table
template <class S>
Friction<S> friction(const Contact<S>& contact, const Vec3<S>& v_P, const Vec3<S>& w, const Vec3<S>& normal) {
  using real::sqrt;
  const Vec3<S> zero(S(0), S(0), S(0));
  Friction<S> f{zero, zero, zero};
  const S w_z = inner(w, normal);
  switch (contact.law) {
    case ContactLaw::frictionless:
    case ContactLaw::rolling: break;
    case ContactLaw::viscous: f.force = S(-contact.viscosity) * v_P; break;
    case ContactLaw::viscous_load: f.force_per_normal = S(-contact.viscosity) * v_P; break;
    case ContactLaw::coulomb:
      f.force_per_normal = S(-contact.coefficient) * regularised_direction(v_P, S(contact.slip_floor * contact.slip_floor));
      break;
    case ContactLaw::contensou: {
      const S R_squared = contact.patch_radius * contact.patch_radius, spin_squared = w_z * w_z;
      const S a_squared = contact.slip_of_spin * contact.slip_of_spin, b_squared = contact.spin_of_slip * contact.spin_of_slip;
      f.force_per_normal = S(-contact.coefficient) * regularised_direction(v_P, S(S(a_squared * R_squared) * spin_squared));
      const S square = R_squared * spin_squared + b_squared * inner(v_P, v_P);
      if (is_above_zero(square))
        f.moment_per_normal = S(S(-contact.moment_factor * contact.coefficient * R_squared) * (w_z / sqrt(square))) * normal;
      break;
    }
  }
  const S floor_squared = contact.rate_floor * contact.rate_floor;
  if (contact.has_spinning_friction)
    f.moment_per_normal -= contact.spinning_length * regularised_direction(Vec3<S>(w_z * normal), floor_squared);
  if (contact.has_rolling_resistance)
    f.moment_per_normal -= contact.rolling_length * regularised_direction(Vec3<S>(w - w_z * normal), floor_squared);
  return f;
}

/// The torque of the air about the centre of mass.   @param w_B  rate relative to the table, in body axes as the result
template <class S>
Vec3<S> air_torque_B(const AirOnTable<S>& air, const Vec3<S>& w_B) {
  using real::sqrt;
  const S floor_squared = air.rate_floor * air.rate_floor;
  Vec3<S> torque = S(-friction_coefficient(air, S(inner(w_B, w_B) + floor_squared))) * w_B;
  if (air.has_drag) torque[2] -= disc_drag_coefficient(air, S(sqrt(S(w_B[2] * w_B[2] + floor_squared)))) * w_B[2];
  if (air.has_axes) {
    const Vec3<S> by_axis(air.viscous_1, air.viscous_2, air.viscous_3);
    for (int i = 0; i < 3; ++i) torque[i] -= by_axis[i] * w_B[i];
  }
  return torque;
}
/// The same of a body symmetric about n, in any axes: -c w - (d + k3 - k1) (n.w) n with c + k1 across the axis.
template <class S>
Vec3<S> air_torque_beside_axis(const AirOnTable<S>& air, const Vec3<S>& w, const Vec3<S>& n) {
  using real::sqrt;
  const S floor_squared = air.rate_floor * air.rate_floor, spin = inner(w, n);
  S across = friction_coefficient(air, S(inner(w, w) + floor_squared)), along = S(0);
  if (air.has_drag) along += disc_drag_coefficient(air, S(sqrt(S(spin * spin + floor_squared))));
  if (air.has_axes) across += air.viscous_1, along += air.viscous_3 - air.viscous_1;
  return S(-across) * w - S(along * spin) * n;
}
/// The acceleration that the force of the air gives the centre of mass.   @param v_C  relative to the laboratory
template <class S>
Vec3<S> air_acceleration(const Contact<S>& contact, const Vec3<S>& v_C) {
  using real::sqrt;
  const AirOnTable<S>& air = contact.air;
  S coefficient = air.force;
  if (air.pulls_by_square) coefficient += air.force_by_speed * sqrt(S(inner(v_C, v_C) + air.speed_floor * air.speed_floor));
  return S(S(-1) * (coefficient / contact.mass)) * v_C;
}

/// The acceleration -2 W x v_C - W x (W x p_C) + Gamma p_C that a field uniform in inertial space, seen from the laboratory, and
/// the gradient of gravitation give the centre of mass besides apparent gravity.
/// @param p_C, v_C  position and velocity of C relative to the laboratory
template <class S>
Vec3<S> field_beside_gravity(const Contact<S>& contact, const ContactSurroundings<S>& around, const Vec3<S>& p_C,
                             const Vec3<S>& v_C) {
  Vec3<S> a = S(S(-2) * contact.weights.coriolis) * Vec3<S>(around.W.cross(v_C)) -
              contact.weights.centrifugal * Vec3<S>(around.W.cross(Vec3<S>(around.W.cross(p_C))));
  if (contact.has_gradient) a += times(around.gradient, p_C);
  return a;
}
/// The Coriolis and centrifugal accelerations of C that a scene leaves out.
template <class S>
Vec3<S> left_out_acceleration(const Contact<S>& contact, const Vec3<S>& W, const Vec3<S>& p_C, const Vec3<S>& v_C) {
  return S(S(-2) * (S(1) - contact.weights.coriolis)) * Vec3<S>(W.cross(v_C)) -
         S(S(1) - contact.weights.centrifugal) * Vec3<S>(W.cross(Vec3<S>(W.cross(p_C))));
}

/// The torque integral r x (Gamma r) dm of the gradient of gravitation about C.   @param S_BC  second moment about C
template <class S>
Vec3<S> gradient_torque(const Mat3<S>& gradient, const Mat3<S>& S_BC) {
  Vec3<S> torque(S(0), S(0), S(0));
  for (int j = 0; j < 3; ++j) torque += Vec3<S>(S_BC.col(j)).cross(Vec3<S>(gradient.col(j)));
  return torque;
}

/// The part of a vector in the table's plane.
template <class S>
Vec3<S> in_table_plane(const Vec3<S>& x, const Vec3<S>& normal) {
  return x - inner(x, normal) * normal;
}

}  // namespace earthtop
