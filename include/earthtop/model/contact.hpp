// SPDX-License-Identifier: GPL-3.0-or-later
/// A top whose spherical tip stands on a table: the numbers that the equations of contact need, in the units of its model.
///
/// The body's origin O is the centre of the tip's sphere; C is the centre of mass, r_c = p_OC; r the tip's radius. The table is
/// the plane through the origin of the laboratory with the normal z, so that p_O.z = r, and the contact point P is O - r z. All
/// equations are written in axes H, which are at rest in the laboratory: their axis 3 is z, and they are L's axes turned by the
/// table's tilt about a horizontal axis. A level table's are L's own.
#pragma once

#include "earthtop/model/contact_spec.hpp"
#include "earthtop/model/model.hpp"

namespace earthtop {

/// Body and contact. Every number is of the scalar S of the formulas, so that the change of a motion with a coefficient follows
/// by pairs through the same formulas.
/// @tparam S  a number, Paired, or a scalar that records operations
template <class S>
struct Contact {
  ContactLaw law = ContactLaw::frictionless;
  bool has_spinning_friction = false, has_rolling_resistance = false, has_gradient = false;
  bool omits_torques = false;  ///< whether one of the weights is not 1

  S mass = S(1);
  S tip_radius = S(0);
  S viscosity = S(0);                               ///< k of `viscous` (mass/time), mu_v of `viscous_load` (time/m)
  S coefficient = S(0);                             ///< mu
  S slip_floor = S(0);                              ///< regularisation of `coulomb` (m/time)
  S patch_radius = S(0);                            ///< R of `contensou` (m)
  S slip_of_spin = S(0);                            ///< a = 8/(3 pi) of `contensou`
  S spin_of_slip = S(0);                            ///< b = 15 pi/16
  S moment_factor = S(0);                           ///< 3 pi/16
  S spinning_length = S(0), rolling_length = S(0);  ///< c_s, c_r (m)
  S rate_floor = S(0);                              ///< their regularisation (1/time)

  // The body about its centre of mass, in body axes.
  Vec3<S> p_OC_B;  ///< from O to the centre of mass (m)
  Mat3<S> I_BC_B, I_BC_B_inverse, S_BC_B;
  // The same for a body that is symmetric about axis 3: position of C along it, and the moments normal to it and along it.
  S height_of_center = S(0), I1 = S(1), I3 = S(1);

  TorqueWeights<S> weights;  ///< of force and torque together
  Mat3<S> gradient_H;        ///< gradient of gravitation (1/time^2)
};

/// @param body  its origin is the centre of the tip's sphere   @param weights  of Coriolis and centrifugal force and torque
/// @param gradient  of gravitation, which exerts a force and a torque; null: left out
template <class T>
Contact<T> make_contact(const ContactSpec& spec, const Body<T>& body, const Site& site, const TorqueWeights<T>& weights,
                        const GravityGradientSpec* gradient, const NaturalUnits& units = {});
extern template Contact<double> make_contact(const ContactSpec&, const Body<double>&, const Site&, const TorqueWeights<double>&,
                                             const GravityGradientSpec*, const NaturalUnits&);
extern template Contact<long double> make_contact(const ContactSpec&, const Body<long double>&, const Site&,
                                                  const TorqueWeights<long double>&, const GravityGradientSpec*,
                                                  const NaturalUnits&);
extern template Contact<float128> make_contact(const ContactSpec&, const Body<float128>&, const Site&,
                                               const TorqueWeights<float128>&, const GravityGradientSpec*, const NaturalUnits&);

/// Attitude q_LH of the table's axes: Up turned toward the direction of steepest descent by the tilt. The identity, exactly, for
/// a level table.
template <class T>
Quaternion<T> table_attitude(double tilt_deg, double azimuth_deg);
extern template Quaternion<double> table_attitude(double, double);
extern template Quaternion<long double> table_attitude(double, double);
extern template Quaternion<float128> table_attitude(double, double);

/// Whether the reduced form holds: the body is symmetric about axis 3, on which C lies.
template <class T>
bool is_symmetric(const Contact<T>& contact) {
  return symmetry_axis(contact.I_BC_B, contact.p_OC_B) == 2;
}

/// The same contact over another scalar.
/// @param to  the number as a scalar of the other kind
template <class S, class T, class To>
Contact<S> converted(const Contact<T>& c, const To& to) {
  const auto vector = [&](const Vec3<T>& v) { return Vec3<S>(to(v[0]), to(v[1]), to(v[2])); };
  const auto matrix = [&](const Mat3<T>& m) {
    Mat3<S> made;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) made(i, j) = to(m(i, j));
    return made;
  };
  Contact<S> s;
  s.law = c.law;
  s.has_spinning_friction = c.has_spinning_friction, s.has_rolling_resistance = c.has_rolling_resistance;
  s.has_gradient = c.has_gradient, s.omits_torques = c.omits_torques;
  s.mass = to(c.mass), s.tip_radius = to(c.tip_radius);
  s.viscosity = to(c.viscosity), s.coefficient = to(c.coefficient), s.slip_floor = to(c.slip_floor);
  s.patch_radius = to(c.patch_radius), s.slip_of_spin = to(c.slip_of_spin), s.spin_of_slip = to(c.spin_of_slip);
  s.moment_factor = to(c.moment_factor);
  s.spinning_length = to(c.spinning_length), s.rolling_length = to(c.rolling_length), s.rate_floor = to(c.rate_floor);
  s.p_OC_B = vector(c.p_OC_B);
  s.I_BC_B = matrix(c.I_BC_B), s.I_BC_B_inverse = matrix(c.I_BC_B_inverse), s.S_BC_B = matrix(c.S_BC_B);
  s.height_of_center = to(c.height_of_center), s.I1 = to(c.I1), s.I3 = to(c.I3);
  s.weights = {to(c.weights.coriolis), to(c.weights.transverse), to(c.weights.centrifugal)};
  s.gradient_H = matrix(c.gradient_H);
  return s;
}
/// The same contact in both predictions.
template <class T>
Contact<Paired<T>> paired(const Contact<T>& contact) {
  return converted<Paired<T>>(contact, [](const T& x) { return Paired<T>(x); });
}

}  // namespace earthtop
