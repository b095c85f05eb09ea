// SPDX-License-Identifier: GPL-3.0-or-later
/// The applied torques, which act in addition to gravity and the torques of the Earth's rotation: gravity gradient, friction,
/// air drag, an unequal support, a given torque, and a gimbal that holds the axis level. Each is off unless a scene asks for
/// it. Every formula is a template on its scalar: with T it gives the torque on one motion; with Paired<T> it gives the torques
/// on both predictions and their difference without cancellation. All in body axes B, about the pivot (N m).
///
/// - gravity gradient: integral r x (Gamma r) dm = sum k_i u_i x (Theta u_i), where Gamma = sum k_i u_i u_i^T + const 1
/// - viscous: -k w_PB, Stokes friction, isotropic, or with a coefficient for each body axis
/// - quadratic: -c |w_PB| w_PB, drag, isotropic
/// - disc in air: -c sqrt|w3| w3 laminar, -c |w3|^(4/5) w3 turbulent, along axis 3 [von Karman 1921]
/// - Coulomb pivot: -T w_PB / |w_PB|, dry friction, isotropic
/// - unequal support: -n x (K n), with the energy n.K n / 2 of the axis n; K is kappa e e^T for a horizontal direction e
/// - given: a function of time, in body axes or in laboratory axes
/// - gimbal: lambda z x n, which keeps the axis n normal to z (Up of P); lambda follows from the constraint (d'Alembert)
///
/// w_PB is the body's rate relative to the platform, or relative to the laboratory if there is no platform.
#pragma once

#include <array>
#include <memory>
#include <type_traits>

#include "earthtop/frames/earth.hpp"
#include "earthtop/members.hpp"
#include "earthtop/model/applied_torques_spec.hpp"
#include "earthtop/model/mass_path.hpp"
#include "earthtop/model/paired.hpp"

namespace earthtop {

/// One term k u u^T of a gradient tensor (1/s^2).
template <class T>
struct GradientTerm {
  T strength = T(0);
  Vec3<T> direction_L = Vec3<T>::UnitZ();
  EARTHTOP_MEMBERS(strength, direction_L)
};

/// The stiffness K of an unequal support: a tensor of the horizontal directions of the laboratory, a torque (N m).
template <class T>
struct SupportStiffness {
  T east = T(0), east_north = T(0), north = T(0);
  EARTHTOP_MEMBERS(east, east_north, north)

  bool acts() const { return east != T(0) || east_north != T(0) || north != T(0); }
  T largest() const { return real::abs(east) + real::abs(north); }
};

/// A torque as a function of time: (x, y, z), this times sin(2 pi frequency t + phase), or a table of the three components.
template <class T>
struct GivenTorque {
  bool acts = false, in_laboratory = false, oscillates = false;
  T x = T(0), y = T(0), z = T(0);
  T frequency = T(0), phase = T(0);
  std::shared_ptr<const PiecewisePath<T>> table = nullptr;
  EARTHTOP_MEMBERS(acts, in_laboratory, oscillates, x, y, z, frequency, phase, table)

  Vec3<T> at(const T& t) const {
    if (table) return table->place(t);
    const Vec3<T> amplitude(x, y, z);
    return oscillates ? Vec3<T>(real::sin(T(T(2) * real::pi<T>() * frequency * t + phase)) * amplitude) : amplitude;
  }
  /// Whether it is along a body axis and turns with it.
  bool is_along(int axis) const {
    const Vec3<T> amplitude(x, y, z);
    return !in_laboratory && !table && amplitude[(axis + 1) % 3] == T(0) && amplitude[(axis + 2) % 3] == T(0);
  }
};

/// The coefficients of the applied torques. The numbers that are not in a struct are of friction, but for the gimbal's.
template <class T>
struct AppliedTorques {
  bool any = false;
  T viscous = T(0), quadratic = T(0), coulomb = T(0);
  T viscous_1 = T(0), viscous_2 = T(0), viscous_3 = T(0);  ///< further viscous friction of each body axis
  T disc_laminar = T(0), disc_turbulent = T(0);
  std::array<GradientTerm<T>, 2> gradient;
  bool level_axis = false;
  T gimbal_damping = T(0);
  SupportStiffness<T> support;
  GivenTorque<T> given;
  EARTHTOP_MEMBERS(any, viscous, quadratic, coulomb, viscous_1, viscous_2, viscous_3, disc_laminar, disc_turbulent, gradient,
                   level_axis, gimbal_damping, support, given)

  /// Whether anything rubs.
  bool friction() const { return any_number_but(gimbal_damping); }
  /// Whether the friction has a corner where what it brakes comes to rest. All but viscous friction has one.
  bool has_corner() const { return any_number_but(gimbal_damping, viscous, viscous_1, viscous_2, viscous_3); }
  bool is_dry() const { return coulomb != T(0); }
  bool depends_on_rate() const { return quadratic != T(0) || is_dry(); }
  bool has_disc() const { return disc_laminar != T(0) || disc_turbulent != T(0); }
  bool has_viscous_axes() const { return viscous_1 != T(0) || viscous_2 != T(0) || viscous_3 != T(0); }
  T viscous_about(int axis) const { return axis == 0 ? viscous_1 : axis == 1 ? viscous_2 : viscous_3; }
  /// Whether a torque may change the spin of a symmetric top.
  bool changes_spin() const { return friction() || given.acts; }
  /// Whether no torque on a body that is symmetric about this axis depends on the angle through which it has turned about it.
  bool is_symmetric_about(int axis) const {
    return (axis == 2 || !(has_disc() || support.acts())) && viscous_about((axis + 1) % 3) == viscous_about((axis + 2) % 3) &&
           (!given.acts || given.in_laboratory || given.is_along(axis));
  }

 private:
  /// Whether a coefficient that is a number of this struct is not 0, apart from some.
  template <class... Number>
  bool any_number_but(const Number&... left_out) const {
    bool any_acts = false;
    const auto look = [&](const auto& member) {
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(member)>, T>) {
        const bool counts = ((&member != &left_out) && ...);
        any_acts = any_acts || (counts && member != T(0));
      }
    };
    for_each_member(look, *this);
    return any_acts;
  }
};

/// Calls number(a, b...) for each coefficient of applied torques over the same scalar or over several, and gradient(a, b...)
/// for the terms of the gradient. Flags and functions of time are left out.
template <class Number, class Gradient, class... Structs>
void for_each_coefficient(const Number& number, const Gradient& gradient, Structs&... structs) {
  const auto take = [&](auto& first, auto&... others) {
    using Kind = std::remove_const_t<std::remove_reference_t<decltype(first)>>;
    if constexpr (ListsMembers<Kind>)
      for_each_coefficient(number, gradient, first, others...);
    else if constexpr (requires { first.begin(); })
      gradient(first, others...);
    else if constexpr (!std::is_same_v<Kind, bool> && !requires { first.get(); })
      number(first, others...);
  };
  for_each_member(take, structs...);
}

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

/// The stiffness of an unequal support that gives the small swings of a pendulum these periods: with T1 along e and T2 across
/// it, the squares of the rates are as m g l + kappa and m g l, so that kappa = m g l ((T2/T1)^2 - 1).
/// @param weight_torque  m g l; the result is in its unit
template <class T>
SupportStiffness<T> support_of_periods(const UnequalSupportSpec& spec, T weight_torque);
extern template SupportStiffness<double> support_of_periods(const UnequalSupportSpec&, double);
extern template SupportStiffness<float80> support_of_periods(const UnequalSupportSpec&, float80);
extern template SupportStiffness<float128> support_of_periods(const UnequalSupportSpec&, float128);

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
  Vec3<S> east_B = Vec3<S>::UnitX(), north_B = Vec3<S>::UnitY();           ///< axes 1 and 2 of the laboratory
  Vec3<S> given_B = Vec3<S>::Zero();                                       ///< the given torque
  Vec3<S> other_torque_B = Vec3<S>::Zero();  ///< torque of gravity and of omitted effects; used by the gimbal only
};

/// The torque 3 k u x (Theta u) of the gradient tensor k (3 u u^T - 1): the strength of its term is 3 k.
template <class T, class S>
Vec3<S> gravity_gradient_torque(const GradientTerm<T>& term, const Mat3<T>& I_BP_B, const Vec3<S>& direction_B) {
  return S(term.strength) * direction_B.cross(mixed_times(I_BP_B, direction_B));
}

/// The torque -n x (K n) of an unequal support.   @param n  body axis 3, and East and North, in the axes of the result
template <class T, class S>
Vec3<S> support_torque(const SupportStiffness<T>& K, const Vec3<S>& n, const Vec3<S>& east, const Vec3<S>& north) {
  const S n_east = east[0] * n[0] + east[1] * n[1] + east[2] * n[2],
          n_north = north[0] * n[0] + north[1] * n[1] + north[2] * n[2];
  const Vec3<S> pull =
      S(S(K.east) * n_east + S(K.east_north) * n_north) * east + S(S(K.east_north) * n_east + S(K.north) * n_north) * north;
  return pull.cross(n);
}
/// Its energy n.K n / 2.
template <class T>
T support_energy(const SupportStiffness<T>& K, const T& n_east, const T& n_north) {
  return (n_east * (K.east * n_east + T(2) * K.east_north * n_north) + n_north * K.north * n_north) / T(2);
}

/// c of the friction torque -c w that is the same about all axes: viscous, quadratic and dry.   @param square  w.w
/// @tparam Friction  AppliedTorques, or the air about a top on a table (contact.hpp)
template <class Friction, class S>
S friction_coefficient(const Friction& applied, const S& square) {
  using real::sqrt;
  S coefficient = S(applied.viscous);
  if (applied.depends_on_rate()) {
    const S rate = sqrt(square);
    coefficient += S(applied.quadratic) * rate;
    if constexpr (requires { applied.coulomb; })
      if (applied.is_dry() && is_above_zero(rate)) coefficient += S(applied.coulomb) / rate;
  }
  return coefficient;
}
/// c of the torque -c w3 of a disc in air, for the spin w3.
template <class Friction, class S>
S disc_drag_coefficient(const Friction& applied, const S& w3_PB) {
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
  if (applied.has_viscous_axes())
    for (int i = 0; i < 3; ++i) torque[i] -= S(applied.viscous_about(i)) * w_PB_B[i];
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
  if (applied.support.acts()) {
    const Vec3<S> axis(S(T(0)), S(T(0)), S(T(1)));
    torque += support_torque(applied.support, axis, seen.east_B, seen.north_B);
  }
  if (applied.given.acts) torque += seen.given_B;
  if (applied.level_axis) torque += gimbal_torque(applied, I_BP_B, I_BP_B_inverse, seen, Vec3<S>(torque + seen.other_torque_B));
  return torque;
}

}  // namespace earthtop
