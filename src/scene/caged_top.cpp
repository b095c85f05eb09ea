// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/caged_top.hpp"

namespace earthtop {

template <class T>
CagedTop<T>::CagedTop(const Scenario& scenario)
    : release_(scenario.release), spec_(*scenario.rotor), rotor_(make_rotor<T>(spec_)) {
  const Body<T> cage = make_body<T>(scenario.body);
  rigid_ = gyrostat_body(cage, spec_, true);
  const T I3 = rigid_.I_BP_B(2, 2);
  // The bearing turns rotor and cage against each other: ds/dt = -k s (1/C + 1/(I3 - C)).
  slowing_ = rotor_.viscous == T(0) ? T(0) : rotor_.viscous * (T(1) / rotor_.axial + T(1) / (I3 - rotor_.axial));
  share_ = -rotor_.axial / I3;
}

template <class T>
Release<T> CagedTop<T>::release(T gravity) const {
  ReleaseSpec spec = release_;
  const bool is_steady = spec.precession == Precession::steady_slow || spec.precession == Precession::steady_fast;
  if (is_steady) spec.precession = Precession::none;
  Release<T> made = make_release<T>(spec, rigid_, gravity);
  T& w3 = made.w_XB_B[2];
  w3 -= share_ * rotor_.spin;
  if (!is_steady) return made;
  const Vec3<T> up_B = rotation_matrix(made.q_LB).row(2).transpose();
  const T rate = steady_precession_rate(rigid_, made.q_LB, gravity, w3, release_.precession);
  made.w_XB_B = Vec3<T>(rate * up_B[0], rate * up_B[1], w3);
  return made;
}

template <class T>
T CagedTop<T>::rotor_rate(T t) const {
  if (rotor_.driven) return rotor_.driven_rate(t);
  return slowing_ > T(0) ? T(rotor_.spin * real::exp(T(-slowing_ * t))) : rotor_.spin;
}

template <class T>
T CagedTop<T>::rotor_angle(T t) const {
  if (!rotor_.driven) return rotor_.spin * (slowing_ > T(0) ? T(-real::expm1(T(-slowing_ * t)) / slowing_) : t);
  const PrescribedMotion<T>& drive = rotor_.drive;
  T angle = t * (drive.angle0 + t * drive.rate / T(2));
  if (drive.table) angle += drive.table->angle_integral(t);
  if (drive.frequency == T(0)) return angle + t * (drive.amplitude * real::sin(drive.phase));
  // Integral of sin(a t + p): (cos p - cos(a t + p)) / a = 2 sin(a t/2 + p) sin(a t/2) / a
  const T a = T(2) * real::pi<T>() * drive.frequency, half = a * t / T(2);
  return angle + drive.amplitude * (T(2) * real::sin(T(half + drive.phase)) * real::sin(half) / a);
}

template class CagedTop<double>;
template class CagedTop<float80>;
template class CagedTop<float128>;

}  // namespace earthtop
