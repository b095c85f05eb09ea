// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/model/gyrostat.hpp"

#include <stdexcept>
#include <utility>

namespace earthtop {
namespace {

template <class T>
Vec3<T> vector(const std::array<double, 3>& v) {
  return {T(v[0]), T(v[1]), T(v[2])};
}
template <class T>
Vec3<T> unit_axis(const RotorSpec& spec) {
  const Vec3<T> axis = vector<T>(spec.axis);
  return axis / norm(axis);
}

/// The rotor's inertia about the pivot.   @param whole  whether with its axial moment
template <class T>
Mat3<T> rotor_inertia(const RotorSpec& spec, bool whole) {
  const Vec3<T> axis_B = unit_axis<T>(spec);
  const Mat3<T> along = axis_B * axis_B.transpose();
  const Mat3<T> across =
      point_mass_inertia(T(spec.mass_kg), vector<T>(spec.center_m)) + T(spec.transverse_kg_m2) * (Mat3<T>::Identity() - along);
  return whole ? Mat3<T>(across + T(spec.axial_kg_m2) * along) : across;
}

/// Adds a number of times the masses that the body carries, or takes them away.
template <class T>
Body<T> changed_by(const Body<T>& body, const std::vector<MovingMassSpec>& specs, int sign) {
  const MovingMasses<T> masses = make_masses<T>(specs, MassCarrier::body, false);
  if (!masses.any()) return body;
  const T factor = T(sign);
  const MassSums<T>& sums = masses.at_release;
  Body<T> made = body;
  for (const MassOnPath<T>& one : masses.masses) made.mass += factor * one.mass;
  made.p_PBcm_B = (body.mass * body.p_PBcm_B + factor * sums.mass_moment) / made.mass;
  made.S_BP_B += factor * sums.second_moment;
  made.I_BP_B += factor * inertia_of(sums.second_moment);
  made.I_BP_B_inverse = symmetric_inverse(made.I_BP_B);
  return made;
}

}  // namespace

template <class T>
Rotor<T> make_rotor(const RotorSpec& spec) {
  Rotor<T> rotor;
  rotor.driven = spec.drive != RotorDrive::none;
  rotor.axis_B = unit_axis<T>(spec);
  rotor.axial = T(spec.axial_kg_m2);
  const Mat3<T> across = Mat3<T>::Identity() - rotor.axis_B * rotor.axis_B.transpose();
  rotor.S_B = (rotor.axial / T(2)) * across +
              (T(spec.transverse_kg_m2) - rotor.axial / T(2)) * (rotor.axis_B * rotor.axis_B.transpose());
  rotor.spin = T(spec.spin_rad_s);
  rotor.viscous = T(spec.viscous_torque_N_m_s);
  rotor.coulomb = T(spec.coulomb_torque_N_m);
  rotor.regularisation = T(spec.regularisation_rad_s);
  switch (spec.drive) {
    case RotorDrive::none: break;
    case RotorDrive::constant: rotor.drive.angle0 = rotor.spin; break;
    case RotorDrive::ramp:
      rotor.drive.angle0 = rotor.spin;
      rotor.drive.rate = T(spec.acceleration_rad_s2);
      break;
    case RotorDrive::harmonic:
      rotor.drive.angle0 = rotor.spin;
      rotor.drive.amplitude = T(spec.amplitude_rad_s);
      rotor.drive.frequency = T(spec.frequency_hz);
      rotor.drive.phase = T(spec.phase_deg) * real::pi<T>() / T(180);
      break;
    case RotorDrive::table:
      if (!spec.table.rows) throw std::invalid_argument("rotor drive \"table\": there is no table");
      rotor.drive.table = std::make_shared<const AngleSpline<T>>(*spec.table.rows);
      break;
  }
  if (rotor.driven) rotor.spin = rotor.driven_rate(T(0));
  return rotor;
}

template <class T>
Body<T> gyrostat_body(const Body<T>& cage, const RotorSpec& spec, bool whole) {
  const T mass = T(spec.mass_kg);
  Body<T> body;
  body.mass = cage.mass + mass;
  body.p_PBcm_B = (cage.mass * cage.p_PBcm_B + mass * vector<T>(spec.center_m)) / body.mass;
  const Mat3<T> of_both = cage.I_BP_B + rotor_inertia<T>(spec, true);
  body.I_BP_B = whole ? of_both : Mat3<T>(cage.I_BP_B + rotor_inertia<T>(spec, false));
  body.S_BP_B = (of_both.trace() / T(2)) * Mat3<T>::Identity() - of_both;
  body.I_BP_B_inverse = symmetric_inverse(body.I_BP_B);
  return body;
}

template <class T>
Body<T> without_rotor(const Body<T>& both, const RotorSpec& spec, bool whole) {
  const T mass = T(spec.mass_kg);
  Body<T> cage;
  cage.mass = both.mass - mass;
  cage.p_PBcm_B = (both.mass * both.p_PBcm_B - mass * vector<T>(spec.center_m)) / cage.mass;
  cage.I_BP_B = both.I_BP_B - rotor_inertia<T>(spec, whole);
  cage.S_BP_B = (cage.I_BP_B.trace() / T(2)) * Mat3<T>::Identity() - cage.I_BP_B;
  cage.I_BP_B_inverse = symmetric_inverse(cage.I_BP_B);
  return cage;
}

template <class T>
void put_rotor(Model<T>& model, Rotor<T> rotor, const NaturalUnits& units) {
  const auto scale = [](T& x, int exponent) { x = real::scale(x, exponent); };
  const int time = units.time_exponent, mass = units.mass_exponent;
  scale(rotor.axial, -mass);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) scale(rotor.S_B(i, j), -mass);
  scale(rotor.spin, time);
  scale(rotor.regularisation, time);
  scale(rotor.rate_unit, time);
  scale(rotor.viscous, time - mass);
  scale(rotor.coulomb, 2 * time - mass);
  rotor.drive = in_time_units(rotor.drive, time);
  model.rotor = std::move(rotor);
  model.kind = SceneKind::gyrostat;
}

template <class T>
Body<T> with_masses(const Body<T>& body, const std::vector<MovingMassSpec>& masses) {
  return changed_by(body, masses, 1);
}
template <class T>
Body<T> without_masses(const Body<T>& all, const std::vector<MovingMassSpec>& masses) {
  return changed_by(all, masses, -1);
}

template <class T>
void put_masses(Model<T>& model, const std::vector<MovingMassSpec>& masses, const NaturalUnits& units) {
  model.masses = in_units(make_masses<T>(masses, MassCarrier::body, true), units.mass_exponent, units.time_exponent);
  if (!model.masses.any() || model.kind == SceneKind::gyrostat) return;
  model.rotor.driven = true;
  model.rotor.axial = T(0);
  model.kind = SceneKind::gyrostat;
}

template <class T>
void put_gimbals(Model<T>& model, const Gimbals<T>& gimbals, const NaturalUnits& units) {
  model.gimbals = in_units(gimbals, units.mass_exponent, units.time_exponent);
  if (!gimbals.has_rotor) model.rotor.driven = true, model.rotor.axial = T(0);  // nothing turns inside the body
  model.kind = SceneKind::suspension;
}

#define EARTHTOP_ROTOR(T)                                                                       \
  template Rotor<T> make_rotor(const RotorSpec&);                                               \
  template Body<T> gyrostat_body(const Body<T>&, const RotorSpec&, bool);                       \
  template Body<T> without_rotor(const Body<T>&, const RotorSpec&, bool);                       \
  template void put_rotor(Model<T>&, Rotor<T>, const NaturalUnits&);                            \
  template Body<T> with_masses(const Body<T>&, const std::vector<MovingMassSpec>&);             \
  template Body<T> without_masses(const Body<T>&, const std::vector<MovingMassSpec>&);          \
  template void put_masses(Model<T>&, const std::vector<MovingMassSpec>&, const NaturalUnits&); \
  template void put_gimbals(Model<T>&, const Gimbals<T>&, const NaturalUnits&);
EARTHTOP_ROTOR(double)
EARTHTOP_ROTOR(float80)
EARTHTOP_ROTOR(float128)
#undef EARTHTOP_ROTOR

}  // namespace earthtop
