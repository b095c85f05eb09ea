// SPDX-License-Identifier: GPL-3.0-or-later
/// A top whose spherical tip stands on a table: the numbers that the equations of contact need, in the units of its model.
///
/// The body's origin O is the centre of the tip's sphere; C is the centre of mass, r_c = p_OC; r the tip's radius. The table is
/// the plane through the origin of the laboratory with the normal z, so that p_O.z = r, and the contact point P is O - r z. All
/// equations are written in axes H, which are at rest in the laboratory: their axis 3 is z, and they are L's axes turned by the
/// table's tilt about a horizontal axis. A level table's are L's own.
#pragma once

#include "earthtop/model/contact_spec.hpp"
#include "earthtop/model/converted.hpp"
#include "earthtop/model/model.hpp"

namespace earthtop {

/// The air about a top on a table: a torque about the centre of mass that opposes its rate relative to the table, by the laws
/// of applied_torques.hpp, and a force there that opposes its velocity. Below `rate_floor` and `speed_floor` a law that is not
/// linear goes over into a linear one, so that it has no corner where the motion comes to rest: its rate is sqrt(w^2 +
/// floor^2).
template <class S>
struct AirOnTable {
  bool turns = false, has_quadratic = false, has_axes = false, has_drag = false;  ///< which of its torques there are
  bool pulls = false, pulls_by_square = false;  ///< whether it has a force, and a quadratic one
  S viscous = S(0), viscous_1 = S(0), viscous_2 = S(0), viscous_3 = S(0);
  S quadratic = S(0), disc_laminar = S(0), disc_turbulent = S(0);
  S force = S(0), force_by_speed = S(0);  ///< b and c of -(b + c v) v
  S rate_floor = S(0), speed_floor = S(0);
  EARTHTOP_MEMBERS(turns, has_quadratic, has_axes, has_drag, pulls, pulls_by_square, viscous, viscous_1, viscous_2, viscous_3,
                   quadratic, disc_laminar, disc_turbulent, force, force_by_speed, rate_floor, speed_floor)

  bool acts() const { return turns || pulls; }
  bool depends_on_rate() const { return has_quadratic; }
};

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
  AirOnTable<S> air;
  EARTHTOP_MEMBERS(law, has_spinning_friction, has_rolling_resistance, has_gradient, omits_torques, mass, tip_radius, viscosity,
                   coefficient, slip_floor, patch_radius, slip_of_spin, spin_of_slip, moment_factor, spinning_length,
                   rolling_length, rate_floor, p_OC_B, I_BC_B, I_BC_B_inverse, S_BC_B, height_of_center, I1, I3, weights,
                   gradient_H, air)
};

/// Whether a contact has the exact Coulomb law, whose slip stops.
template <class S>
bool has_exact_coulomb(const Contact<S>& contact) {
  return contact.law == ContactLaw::coulomb && contact.slip_floor == S(0);
}

/// @param body  its origin is the centre of the tip's sphere   @param weights  of Coriolis and centrifugal force and torque
/// @param gradient  of gravitation, which exerts a force and a torque; null: left out
template <class T>
Contact<T> make_contact(const ContactSpec& spec, const Body<T>& body, const Site& site, const TorqueWeights<T>& weights,
                        const GravityGradientSpec* gradient, const NaturalUnits& units = {});
extern template Contact<double> make_contact(const ContactSpec&, const Body<double>&, const Site&, const TorqueWeights<double>&,
                                             const GravityGradientSpec*, const NaturalUnits&);
extern template Contact<float80> make_contact(const ContactSpec&, const Body<float80>&, const Site&,
                                              const TorqueWeights<float80>&, const GravityGradientSpec*, const NaturalUnits&);
extern template Contact<float128> make_contact(const ContactSpec&, const Body<float128>&, const Site&,
                                               const TorqueWeights<float128>&, const GravityGradientSpec*, const NaturalUnits&);

/// The air in SI units.   @param spin_rad_s  at release; decides between a laminar and a turbulent disc
template <class T>
AirOnTable<T> make_air_on_table(const AppliedTorquesSpec& spec, const Site& site, double spin_rad_s);
extern template AirOnTable<double> make_air_on_table(const AppliedTorquesSpec&, const Site&, double);
extern template AirOnTable<float80> make_air_on_table(const AppliedTorquesSpec&, const Site&, double);
extern template AirOnTable<float128> make_air_on_table(const AppliedTorquesSpec&, const Site&, double);

/// Returns the same contact in natural units; its numbers are in SI units. Not a digit changes, but of a disc's drag.
template <class T>
Contact<T> in_units(Contact<T> contact, const NaturalUnits& units);
extern template Contact<double> in_units(Contact<double>, const NaturalUnits&);
extern template Contact<float80> in_units(Contact<float80>, const NaturalUnits&);
extern template Contact<float128> in_units(Contact<float128>, const NaturalUnits&);

/// Attitude q_LH of the table's axes: Up turned toward the direction of steepest descent by the tilt. The identity, exactly, for
/// a level table.
template <class T>
Quaternion<T> table_attitude(double tilt_deg, double azimuth_deg);
extern template Quaternion<double> table_attitude(double, double);
extern template Quaternion<float80> table_attitude(double, double);
extern template Quaternion<float128> table_attitude(double, double);

/// Whether the reduced form holds: the body is symmetric about axis 3, on which C lies.
template <class T>
bool is_symmetric(const Contact<T>& contact) {
  return symmetry_axis(contact.I_BC_B, contact.p_OC_B) == 2 && contact.air.viscous_1 == contact.air.viscous_2;
}

/// The same contact in both predictions.
template <class T>
Contact<Paired<T>> paired(const Contact<T>& contact) {
  return converted<Paired<T>>(contact, [](const T& x) { return Paired<T>(x); });
}

}  // namespace earthtop
