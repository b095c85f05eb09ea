// SPDX-License-Identifier: GPL-3.0-or-later
/// How a top is released on a table: the velocities that the start names, in both predictions.
#pragma once

#include <optional>

#include "earthtop/model/contact.hpp"
#include "earthtop/model/contact_algebra.hpp"

namespace earthtop {

/// The start on the table, in the model's units and the table's axes H. The attitude of a release (release.hpp) is that relative
/// to the table: tilt and azimuth are about its normal.
template <class T>
struct ContactRelease {
  Quaternion<T> q_LH;
  ContactStart start = ContactStart::tip_at_rest;
  Vec3<T> v_O = Vec3<T>::Zero();  ///< of ContactStart::tip_velocity
  Vec3<T> p_O = Vec3<T>::Zero();  ///< its part along the normal is the tip's radius
  EARTHTOP_MEMBERS(q_LH, start, v_O, p_O)
};

/// Returns the same start in natural units; its numbers are in SI units.
template <class T>
ContactRelease<T> in_units(ContactRelease<T> release, const NaturalUnits& units) {
  release.v_O = units.rate_from_rad_s(release.v_O);
  return release;
}

template <class T>
ContactRelease<T> make_contact_release(const ContactSpec& spec, const NaturalUnits& units) {
  ContactRelease<T> release;
  release.q_LH = table_attitude<T>(spec.table_tilt_deg, spec.table_tilt_azimuth_deg);
  release.start = spec.start;
  if (spec.start == ContactStart::tip_velocity) release.v_O = {T(spec.tip_velocity_m_s[0]), T(spec.tip_velocity_m_s[1]), T(0)};
  release.p_O = {T(spec.tip_position_m[0]), T(spec.tip_position_m[1]), T(spec.tip_radius_m)};
  return in_units(release, units);
}

/// The slip at release, v_O - r w x z with what the start says of v_O.
/// @param w  rate relative to the laboratory   @param r_c  from O to the centre of mass
template <class T>
Vec3<T> slip_at_release(const ContactRelease<T>& release, const Contact<T>& contact, const Vec3<T>& w, const Vec3<T>& r_c) {
  const Vec3<T> z = Vec3<T>::UnitZ();
  Vec3<T> slip = Vec3<T>::Zero();
  switch (release.start) {
    case ContactStart::rolling: break;
    case ContactStart::tip_at_rest: slip = -contact.tip_radius * w.cross(z); break;
    case ContactStart::tip_velocity: slip = release.v_O - contact.tip_radius * w.cross(z); break;
    case ContactStart::center_of_mass_at_rest: slip = -w.cross(Vec3<T>(contact.tip_radius * z + r_c)); break;
  }
  slip[2] = T(0);
  return slip;
}

/// The slip of the rotating motion minus that of the reference, over epsilon, where both start with the same inertial rates: the
/// rotating body then turns at -W more relative to the table, and v_O or v_C is what both share.
template <class T>
Vec3<T> slip_difference_at_release(const ContactRelease<T>& release, const Contact<T>& contact, const Vec3<T>& W_scaled,
                                   const Vec3<T>& r_c) {
  ContactRelease<T> at_rest = release;
  at_rest.v_O = Vec3<T>::Zero();
  return slip_at_release(at_rest, contact, Vec3<T>(-W_scaled), r_c);
}

/// The rate V (counterclockwise about the normal) of a steady precession on a level table without the Earth, of a symmetric top
/// whose angular velocity has the component w3 along its axis; c = cos(tilt):
///   frictionless: I1 c V^2 - I3 w3 V + m g l = 0 ,
///   rolling: V^2 [I1 c + m (l + r c)(r + l c)] - V w3 [I3 + m r (r + l c)] + m g l = 0
/// The slow root is found without the difference of large numbers.
/// @returns none if there is no such rate
template <class T>
std::optional<T> steady_precession_on_table(const Contact<T>& c, T gravity, T cosine, T w3, Precession which) {
  const T l = c.height_of_center, r = c.tip_radius;
  T a = c.I1 * cosine, b = c.I3 * w3;
  const T moment = c.mass * gravity * l;
  if (c.law == ContactLaw::rolling) {
    a += c.mass * (l + r * cosine) * (r + l * cosine);
    b += w3 * c.mass * r * (r + l * cosine);
  }
  const T discriminant = b * b - T(4) * a * moment;
  if (!(discriminant >= T(0))) return std::nullopt;
  const T root = real::sqrt(discriminant), sum = b < T(0) ? b - root : b + root;
  if (sum == T(0) || (which == Precession::steady_fast && a == T(0))) return std::nullopt;
  return which == Precession::steady_fast ? sum / (T(2) * a) : T(2) * moment / sum;
}

/// Attitude and rates at release on a table, relative to the table's axes; see make_release. A steady precession is that on the
/// table.   @throws ScenarioError if the steady precession asked for does not exist
template <class T>
Release<T> make_release_on_table(const ReleaseSpec& spec, const ContactSpec& contact, const Body<T>& body, const Site& site);
extern template Release<double> make_release_on_table(const ReleaseSpec&, const ContactSpec&, const Body<double>&, const Site&);
extern template Release<float80> make_release_on_table(const ReleaseSpec&, const ContactSpec&, const Body<float80>&,
                                                       const Site&);
extern template Release<float128> make_release_on_table(const ReleaseSpec&, const ContactSpec&, const Body<float128>&,
                                                        const Site&);

/// The same on a table whose contact is made, in SI units.
template <class T>
Release<T> make_release_on_table(const ReleaseSpec& spec, const Contact<T>& contact, const Body<T>& body, const Site& site);
extern template Release<double> make_release_on_table(const ReleaseSpec&, const Contact<double>&, const Body<double>&,
                                                      const Site&);
extern template Release<float80> make_release_on_table(const ReleaseSpec&, const Contact<float80>&, const Body<float80>&,
                                                       const Site&);
extern template Release<float128> make_release_on_table(const ReleaseSpec&, const Contact<float128>&, const Body<float128>&,
                                                        const Site&);

/// The model with its gravity and the Earth's rate in the table's axes. Its tide stays in laboratory axes.
template <class T>
Model<T> in_table_axes(const Model<T>& model, const Quaternion<T>& q_LH) {
  Model<T> turned = model;
  const Mat3<T> R_LH = rotation_matrix(q_LH);
  turned.apparent_gravity_L = transposed_times(R_LH, model.apparent_gravity_L);
  turned.W_IL_L_scaled = transposed_times(R_LH, model.W_IL_L_scaled);
  turned.W_IL_L = model.epsilon * turned.W_IL_L_scaled;
  return turned;
}

}  // namespace earthtop
