// SPDX-License-Identifier: GPL-3.0-or-later
/// The applied torques, which act in addition to gravity and the torques of the Earth's rotation: gravity gradient, friction,
/// air drag, and a gimbal that holds the axis level. Each is off unless a scene asks for it. Every formula is a template on its
/// scalar: with T it gives the torque on one motion; with Paired<T> it gives the torques on both predictions and their
/// difference without cancellation. All in body axes B, about the pivot (N m).
///
/// - gravity gradient: integral r x (Gamma r) dm = sum k_i u_i x (Theta u_i), where Gamma = sum k_i u_i u_i^T + const 1
/// - viscous: -k w_PB, Stokes friction, isotropic
/// - quadratic: -c |w_PB| w_PB, drag, isotropic
/// - disc in air: -c sqrt|w3| w3 laminar, -c |w3|^(4/5) w3 turbulent, along axis 3 [von Karman 1921]
/// - Coulomb pivot: -T w_PB / |w_PB|, dry friction, isotropic
/// - gimbal: lambda z x n, which keeps the axis n normal to z (Up of P); lambda follows from the constraint (d'Alembert)
///
/// w_PB is the body's rate relative to the platform, or relative to the laboratory if there is no platform.
#pragma once

#include <array>

#include "earthtop/frames/earth.hpp"
#include "earthtop/members.hpp"
#include "earthtop/model/applied_torques_spec.hpp"
#include "earthtop/model/paired.hpp"

namespace earthtop {

/// One term k u u^T of a gradient tensor (1/s^2).
template <class T>
struct GradientTerm {
  T strength = T(0);
  Vec3<T> direction_L = Vec3<T>::UnitZ();
  EARTHTOP_MEMBERS(strength, direction_L)
};

/// The coefficients of the applied torques.
template <class T>
struct AppliedTorques {
  bool any = false;
  T viscous = T(0), quadratic = T(0), coulomb = T(0);
  T disc_laminar = T(0), disc_turbulent = T(0);
  std::array<GradientTerm<T>, 2> gradient;
  bool level_axis = false;
  T gimbal_damping = T(0);
  EARTHTOP_MEMBERS(any, viscous, quadratic, coulomb, disc_laminar, disc_turbulent, gradient, level_axis, gimbal_damping)

  /// Whether anything rubs: what is neither the gradient nor the gimbal.
  bool friction() const { return any_number_but(gimbal_damping); }
  /// Whether the friction has a corner where what it brakes comes to rest. All but viscous friction has one.
  bool has_corner() const { return any_number_but(gimbal_damping, viscous); }
  bool has_disc() const { return disc_laminar != T(0) || disc_turbulent != T(0); }

 private:
  /// Whether a coefficient that is a number is not 0, apart from some.
  template <class... Number>
  bool any_number_but(const Number&... left_out) const {
    bool any_acts = false;
    const auto look = ByKind{[&](const T& number) {
                               const bool counts = ((&number != &left_out) && ...);
                               any_acts = any_acts || (counts && number != T(0));
                             },
                             [](const bool&) {}, [](const std::array<GradientTerm<T>, 2>&) {}};
    for_each_member(look, *this);
    return any_acts;
  }
};

/// Reynolds number R^2 |w| / nu of a disc.
double disc_reynolds_number(const AirDragSpec& disc, double spin_rad_s);
/// Whether a disc's flow is turbulent. With DiscFlow::automatic the Reynolds number at this spin decides.
bool is_turbulent(const AirDragSpec& disc, double spin_rad_s);

/// k_1 u_1 u_1^T + k_2 u_2 u_2^T equal to the symmetric tensor up to a multiple of the unit tensor, which exerts no torque.
std::array<GradientTerm<double>, 2> gradient_terms(const Mat3<double>& gradient_L);
/// The gradient tensor that a specification gives at a site (1/s^2).
Mat3<double> gradient_L(const GravityGradientSpec& spec, const Site& site);

/// @param spin_rad_s  spin at release; decides between laminar and turbulent air drag   @param mass_exponent, time_exponent
/// see NaturalUnits
template <class T>
AppliedTorques<T> make_applied_torques(const AppliedTorquesSpec& spec, const Site& site, double spin_rad_s, int mass_exponent,
                                       int time_exponent);
extern template AppliedTorques<double> make_applied_torques(const AppliedTorquesSpec&, const Site&, double, int, int);
extern template AppliedTorques<float80> make_applied_torques(const AppliedTorquesSpec&, const Site&, double, int, int);
extern template AppliedTorques<float128> make_applied_torques(const AppliedTorquesSpec&, const Site&, double, int, int);

/// m v for a matrix of T and a vector of any scalar type that T converts to.
template <class T, class S>
Vec3<S> mixed_times(const Mat3<T>& m, const Vec3<S>& v) {
  Vec3<S> product;
  for (int i = 0; i < 3; ++i) product[i] = S(m(i, 0)) * v[0] + S(m(i, 1)) * v[1] + S(m(i, 2)) * v[2];
  return product;
}

/// The quantities of a motion on which the applied torques depend, in body axes.
template <class S>
struct SeenFromBody {
  Vec3<S> w_IB_B = Vec3<S>::Zero();      ///< inertial rate of the body
  Vec3<S> w_IP_B = Vec3<S>::Zero();      ///< inertial rate of the platform, or of the laboratory if there is none
  Vec3<S> alpha_IP_B = Vec3<S>::Zero();  ///< derivative of w_IP in inertial space; used by the gimbal only
  Vec3<S> up_P_B = Vec3<S>::UnitZ();     ///< axis 3 of the platform
  std::array<Vec3<S>, 2> gradient_B = {Vec3<S>::Zero(), Vec3<S>::Zero()};  ///< directions of the terms of the gradient tensor
  Vec3<S> other_torque_B = Vec3<S>::Zero();  ///< torque of gravity and of omitted effects; used by the gimbal only
};

/// The torque 3 k u x (Theta u) of the gradient tensor k (3 u u^T - 1): the strength of its term is 3 k.
template <class T, class S>
Vec3<S> gravity_gradient_torque(const GradientTerm<T>& term, const Mat3<T>& I_BP_B, const Vec3<S>& direction_B) {
  return S(term.strength) * direction_B.cross(mixed_times(I_BP_B, direction_B));
}

/// c of the friction torque -c w that is the same about all axes: viscous, quadratic and dry.   @param square  w.w
template <class T, class S>
S friction_coefficient(const AppliedTorques<T>& applied, const S& square) {
  using real::sqrt;
  S coefficient = S(applied.viscous);
  if (applied.quadratic != T(0) || applied.coulomb != T(0)) {
    const S rate = sqrt(square);
    coefficient += S(applied.quadratic) * rate;
    if (applied.coulomb != T(0) && is_above_zero(rate)) coefficient += S(applied.coulomb) / rate;
  }
  return coefficient;
}
/// c of the torque -c w3 of a disc in air, for the spin w3.
template <class T, class S>
S disc_drag_coefficient(const AppliedTorques<T>& applied, const S& w3_PB) {
  using real::abs, real::fifth_root, real::sqrt;
  const S spin = abs(w3_PB);
  const S fifth = fifth_root(spin), square = fifth * fifth;
  return S(applied.disc_laminar) * sqrt(spin) + S(applied.disc_turbulent) * square * square;
}
/// c of the torque -c w3 along the axis of a symmetric top.   @param coefficient  of the friction about all axes
template <class T, class S>
S spin_friction_coefficient(const AppliedTorques<T>& applied, const S& coefficient, const S& w3_PB) {
  return applied.has_disc() ? S(coefficient + disc_drag_coefficient(applied, w3_PB)) : coefficient;
}
/// Torques that oppose the rate relative to the platform.
template <class T, class S>
Vec3<S> friction_torque(const AppliedTorques<T>& applied, const Vec3<S>& w_PB_B) {
  const S square = w_PB_B[0] * w_PB_B[0] + w_PB_B[1] * w_PB_B[1] + w_PB_B[2] * w_PB_B[2];
  Vec3<S> torque = S(-friction_coefficient(applied, square)) * w_PB_B;
  if (applied.has_disc()) torque[2] -= disc_drag_coefficient(applied, w_PB_B[2]) * w_PB_B[2];
  return torque;
}

/// The gimbal: its damping, and the constraint torque that holds the axis level. With z = Up of P, h = z x e3 and g = z.e3, the
/// constraint g = 0 and its derivative -w_PB.h = 0 remain satisfied if lambda h is added to the torques on the body, with
///   lambda h.Theta^-1 h = h.(dw_IP/dt) - w_PB.dh/dt - h.Theta^-1 (Theta w x w + tau) - 2 b w_PB.h + b^2 g ,
/// dw_IP/dt = R_BI alpha_IP + w_IP x w_IB and dh/dt = (z x w_PB) x e3 in body axes. The last two terms of the first equation
/// remove violations of the constraint that come from rounding, at the rate b = 1/8 per unit of time; they are zero while it is
/// satisfied.
template <class T, class S>
Vec3<S> gimbal_torque(const AppliedTorques<T>& applied, const Mat3<T>& I_BP_B, const Mat3<T>& I_BP_B_inverse,
                      const SeenFromBody<S>& seen, const Vec3<S>& free_torque_B) {
  const Vec3<S>& z = seen.up_P_B;
  const Vec3<S> w_PB_B = seen.w_IB_B - seen.w_IP_B, axis(S(T(0)), S(T(0)), S(T(1)));
  const S turning = z[0] * w_PB_B[0] + z[1] * w_PB_B[1] + z[2] * w_PB_B[2];
  const Vec3<S> damping = S(S(-applied.gimbal_damping) * turning) * z;
  const Vec3<S> h = z.cross(axis), dh = Vec3<S>(z.cross(w_PB_B)).cross(axis);
  const Vec3<S> carried = seen.alpha_IP_B + seen.w_IP_B.cross(seen.w_IB_B);
  const Vec3<S> L = mixed_times(I_BP_B, seen.w_IB_B);
  const Vec3<S> dw = mixed_times(I_BP_B_inverse, Vec3<S>(L.cross(seen.w_IB_B) + free_torque_B + damping));
  const Vec3<S> yielding = mixed_times(I_BP_B_inverse, h);
  const auto dot = [](const Vec3<S>& a, const Vec3<S>& b) { return S(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]); };
  constexpr double kPull = 0.125;
  const S pull = S(T(kPull * kPull)) * z[2] - S(T(2 * kPull)) * dot(w_PB_B, h);
  const S lambda = (dot(h, carried) - dot(w_PB_B, dh) - dot(h, dw) + pull) / dot(h, yielding);
  return damping + lambda * h;
}

/// The sum of all applied torques.
template <class T, class S>
Vec3<S> applied_torque(const AppliedTorques<T>& applied, const Mat3<T>& I_BP_B, const Mat3<T>& I_BP_B_inverse,
                       const SeenFromBody<S>& seen) {
  Vec3<S> torque = friction_torque(applied, Vec3<S>(seen.w_IB_B - seen.w_IP_B));
  for (std::size_t i = 0; i < 2; ++i)
    if (applied.gradient[i].strength != T(0))
      torque += gravity_gradient_torque(applied.gradient[i], I_BP_B, seen.gradient_B[i]);
  if (applied.level_axis) torque += gimbal_torque(applied, I_BP_B, I_BP_B_inverse, seen, Vec3<S>(torque + seen.other_torque_B));
  return torque;
}

}  // namespace earthtop
