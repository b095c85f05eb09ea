// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/model/contact.hpp"

#include <cmath>
#include <utility>

#include "earthtop/frames/degrees.hpp"
#include "earthtop/model/contact_algebra.hpp"

namespace earthtop {
namespace {

template <class T>
Mat3<T> scaled(const Mat3<T>& m, int exponent) {
  Mat3<T> made;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) made(i, j) = real::scale(m(i, j), exponent);
  return made;
}

/// The inverse of a symmetric matrix, exactly symmetric. It is found near 1, where no product of three moments is too small.
template <class T>
Mat3<T> inverse_of(const Mat3<T>& m) {
  int exponent = 0;
  std::frexp(static_cast<double>(m.trace()), &exponent);
  const Mat3<T> near_1 = scaled(m, -exponent);
  Mat3<T> inverse;
  for (int j = 0; j < 3; ++j) inverse.col(j) = solved<T>(near_1, Vec3<T>::Unit(j));
  const Mat3<T> transposed = inverse.transpose();
  return scaled<T>((inverse + transposed) / T(2), -exponent);
}

}  // namespace

template <class T>
Quaternion<T> table_attitude(double tilt_deg, double azimuth_deg) {
  // Up turns toward the direction of descent (sin A, cos A, 0) about the axis Up x descent = (-cos A, sin A, 0).
  const SinCos<T> half = sin_cos_degrees(T(tilt_deg) / T(2)), azimuth = sin_cos_degrees(T(azimuth_deg));
  return {half.cos, Vec3<T>(-half.sin * azimuth.cos, half.sin * azimuth.sin, T(0))};
}
template Quaternion<double> table_attitude(double, double);
template Quaternion<float80> table_attitude(double, double);
template Quaternion<float128> table_attitude(double, double);

template <class T>
Contact<T> in_units(Contact<T> c, const NaturalUnits& units) {
  const int mass = units.mass_exponent, time = units.time_exponent;
  c.mass = real::scale(c.mass, -mass);
  c.viscosity = real::scale(c.viscosity, c.law == ContactLaw::viscous_load ? -time : time - mass);
  c.slip_floor = real::scale(c.slip_floor, time), c.rate_floor = real::scale(c.rate_floor, time);
  c.I_BC_B = scaled(c.I_BC_B, -mass), c.I_BC_B_inverse = scaled(c.I_BC_B_inverse, mass), c.S_BC_B = scaled(c.S_BC_B, -mass);
  c.I1 = real::scale(c.I1, -mass), c.I3 = real::scale(c.I3, -mass);
  c.gradient_H = scaled(c.gradient_H, 2 * time);
  AirOnTable<T>& air = c.air;
  for (T* k : {&air.viscous, &air.viscous_1, &air.viscous_2, &air.viscous_3, &air.force}) *k = real::scale(*k, time - mass);
  for (T* k : {&air.quadratic, &air.force_by_speed}) *k = real::scale(*k, -mass);
  // As in applied_torques.cpp: the rate enters with the power 3/2 or 9/5.
  if (air.has_drag) {
    air.disc_laminar = real::scale(air.disc_laminar, -mass) * real::pow(T(2), T(time) / T(2));
    air.disc_turbulent = real::scale(air.disc_turbulent, -mass) * real::pow(T(2), T(time) / T(5));
  }
  air.rate_floor = real::scale(air.rate_floor, time), air.speed_floor = real::scale(air.speed_floor, time);
  return c;
}
template Contact<double> in_units(Contact<double>, const NaturalUnits&);
template Contact<float80> in_units(Contact<float80>, const NaturalUnits&);
template Contact<float128> in_units(Contact<float128>, const NaturalUnits&);

template <class T>
AirOnTable<T> make_air_on_table(const AppliedTorquesSpec& spec, const Site& site, double spin_rad_s) {
  constexpr double kRateFloor = 0.01, kSpeedFloor = 1e-3;  // rad/s, m/s: slower than anything of a top that is looked at
  AppliedTorquesSpec rubbing = spec;
  rubbing.gravity_gradient.reset(), rubbing.air_force.reset();
  const AppliedTorques<T> torques = make_applied_torques<T>(rubbing, site, spin_rad_s, 0, 0);
  AirOnTable<T> air;
  air.turns = torques.friction();
  air.has_quadratic = torques.quadratic != T(0), air.has_axes = torques.has_viscous_axes(), air.has_drag = torques.has_disc();
  air.viscous = torques.viscous, air.quadratic = torques.quadratic;
  air.viscous_1 = torques.viscous_1, air.viscous_2 = torques.viscous_2, air.viscous_3 = torques.viscous_3;
  air.disc_laminar = torques.disc_laminar, air.disc_turbulent = torques.disc_turbulent;
  if (const auto& force = spec.air_force) {
    air.force = T(force->linear_N_s_m), air.force_by_speed = T(force->quadratic_N_s2_m2);
    air.pulls = air.force != T(0) || air.force_by_speed != T(0), air.pulls_by_square = air.force_by_speed != T(0);
  }
  if (air.acts()) air.rate_floor = T(kRateFloor), air.speed_floor = T(kSpeedFloor);
  return air;
}
template AirOnTable<double> make_air_on_table(const AppliedTorquesSpec&, const Site&, double);
template AirOnTable<float80> make_air_on_table(const AppliedTorquesSpec&, const Site&, double);
template AirOnTable<float128> make_air_on_table(const AppliedTorquesSpec&, const Site&, double);

template <class T>
Contact<T> make_contact(const ContactSpec& spec, const Body<T>& body, const Site& site, const TorqueWeights<T>& weights,
                        const GravityGradientSpec* gradient, const NaturalUnits& units) {
  Contact<T> c;
  c.law = spec.law;
  c.has_spinning_friction = spec.spinning_friction_m != 0, c.has_rolling_resistance = spec.rolling_resistance_m != 0;
  c.mass = body.mass;
  c.tip_radius = T(spec.tip_radius_m);
  if (spec.law == ContactLaw::viscous) c.viscosity = T(spec.sliding_viscosity_N_s_m);
  if (spec.law == ContactLaw::viscous_load) c.viscosity = T(spec.sliding_viscosity_s_m);
  c.coefficient = T(spec.friction_coefficient);
  c.slip_floor = T(spec.regularisation_m_s);
  c.patch_radius = T(spec.patch_radius_m);
  c.slip_of_spin = T(8) / (T(3) * real::pi<T>());
  c.spin_of_slip = T(15) * real::pi<T>() / T(16);
  c.moment_factor = T(3) * real::pi<T>() / T(16);
  c.spinning_length = T(spec.spinning_friction_m), c.rolling_length = T(spec.rolling_resistance_m);
  c.rate_floor = T(spec.regularisation_rad_s);

  c.p_OC_B = body.p_PBcm_B;
  c.I_BC_B = body.I_BBcm_B();
  c.I_BC_B_inverse = inverse_of(c.I_BC_B);
  c.S_BC_B = (c.I_BC_B.trace() / T(2)) * Mat3<T>::Identity() - c.I_BC_B;
  c.height_of_center = c.p_OC_B[2], c.I1 = c.I_BC_B(0, 0), c.I3 = c.I_BC_B(2, 2);

  c.weights = weights;
  c.omits_torques = weights.coriolis != T(1) || weights.centrifugal != T(1);
  c.has_gradient = gradient != nullptr;
  c.gradient_H = Mat3<T>::Zero();
  if (gradient != nullptr) {
    const Mat3<T> R_LH = rotation_matrix(table_attitude<T>(spec.table_tilt_deg, spec.table_tilt_azimuth_deg));
    const Mat3<double> in_L = gradient_L(*gradient, site);
    Mat3<T> exact;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) exact(i, j) = T(in_L(i, j));
    c.gradient_H = turned_tensor<T>(R_LH.transpose(), exact);
  }
  return in_units(std::move(c), units);
}
template Contact<double> make_contact(const ContactSpec&, const Body<double>&, const Site&, const TorqueWeights<double>&,
                                      const GravityGradientSpec*, const NaturalUnits&);
template Contact<float80> make_contact(const ContactSpec&, const Body<float80>&, const Site&, const TorqueWeights<float80>&,
                                       const GravityGradientSpec*, const NaturalUnits&);
template Contact<float128> make_contact(const ContactSpec&, const Body<float128>&, const Site&, const TorqueWeights<float128>&,
                                        const GravityGradientSpec*, const NaturalUnits&);

}  // namespace earthtop
