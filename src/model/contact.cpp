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
  return c;
}
template Contact<double> in_units(Contact<double>, const NaturalUnits&);
template Contact<float80> in_units(Contact<float80>, const NaturalUnits&);
template Contact<float128> in_units(Contact<float128>, const NaturalUnits&);

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
