// SPDX-License-Identifier: GPL-3.0-or-later
/// A symmetric wheel in a gimbal that keeps its axis level: one angle and a spin, instead of the constrained motion of a body.
///
/// The axis n is normal to z (Up), p is its rate about z relative to the laboratory and w3 the inertial spin. The gimbal's
/// torque is normal to z and to n, so it drops out of the momentum balance about both. With L = I1 w + (I3 - I1) w3 n and
/// w = W + p z + (w3 - W.n) n these balances are, in a laboratory that turns at W,
///
///   dp/dt = z.tau / I1 - ((I3/I1) w3 - W.n) n.(z x W) - (damping / I1) p ,   dw3/dt = n.tau / I3
///
/// where tau are the torques of gravity, of its gradient and of friction, and a given one. The non-rotating prediction has W =
/// 0. Both motions are pairs (Paired): one of them is integrated, the base; the other is the base and the deviation. So no two
/// nearly equal motions are subtracted.
///
/// The state: [0] cos and [1] sin of half the base's angle since the release   [2] p   [3] w3 minus that at release   [4] spin
/// phase relative to the laboratory minus that of a steady spin   [5] w and [6] y, of the turn (w, epsilon y z) about z from the
/// reference to the rotating motion   and over epsilon: [7] deviation of p   [8] of w3   [9] of the spin phase relative to the
/// laboratory
#pragma once

#include <array>

#include "drift/deviation_state.hpp"
#include "earthtop/model/reduced_torques.hpp"
#include "integrate/group_norms.hpp"

namespace earthtop {

struct CompassShape {
  static constexpr std::size_t kSize = 10;
  static constexpr auto groups() {
    return std::array<ComponentGroup, 8>{
        {{0, 2, 1.0}, {2, 1, 1e-3}, {3, 1, 1e-3}, {4, 1, 2.0}, {5, 1, 1.0}, {6, 2, 1e-5}, {8, 1, 1e-5}, {9, 1, 1e-5}}};
  }
};

/// The components East and North of a level axis, from those at release and cos and sin of half the angle through which it has
/// turned about Up, up to a common factor.
template <class T>
std::array<T, 2> turned_axis(const T& cos_half, const T& sin_half, const T& east, const T& north) {
  using real::conserved;
  const T square = conserved(T(T(1) / (cos_half * cos_half + sin_half * sin_half)));
  const T cosine = square * (cos_half * cos_half - sin_half * sin_half), sine = square * (T(2) * cos_half * sin_half);
  return {cosine * east - sine * north, sine * east + cosine * north};
}

/// The motion of a wheel as its equations read it.
template <class S>
struct CompassMotion {
  S n_east, n_north;  ///< the axis
  S p, w3;
};
/// dp/dt and dw3/dt.
template <class S>
struct CompassRates {
  S p, w3;
};

/// @param T  a number, or a scalar that records operations   @param S  T, or a pair of T
/// @param W_L  the Earth's rate that the motion feels (for a pair: 0 for the reference)   @param t  time
template <class T, class S>
CompassRates<S> compass_rates(const Model<T>& model, const ReducedTop<T>& top, const CompassMotion<S>& x, const Vec3<S>& W_L,
                              const Vec3<S>& field_L, const T& t) {
  const AppliedTorques<T>& applied = model.applied;
  const S& e = x.n_east;
  const S& n = x.n_north;
  const S carried = W_L[0] * e + W_L[1] * n, across = W_L[0] * n - W_L[1] * e;  // W.n and n.(z x W)
  // z.(n x f) = n_east f_north - n_north f_east
  S p = S(top.moment_ratio) * (e * field_L[1] - n * field_L[0]);
  for (const GradientTerm<T>& term : applied.gradient) {
    if (term.strength == T(0)) continue;
    // z.(k u x (Theta u)) = k (I3 - I1) (n.u) (u_east n_north - u_north n_east)
    const Vec3<T>& u = term.direction_L;
    const S along = S(u[0]) * e + S(u[1]) * n, cross = S(u[0]) * n - S(u[1]) * e;
    p += S(term.strength * ((top.I3 - top.I1) / top.I1)) * (along * cross);
  }
  p -= (S(top.spin_ratio) * x.w3 - carried) * across;
  S damping = S(applied.gimbal_damping), spinning = S(T(0));
  if (applied.friction()) {
    const S spin = x.w3 - carried;
    const S coefficient = friction_coefficient(applied, S(x.p * x.p + spin * spin));
    damping += coefficient;
    spinning = -(S(T(1) / top.I3) * spin_friction_coefficient(applied, coefficient, spin)) * spin;
    if (applied.has_viscous_axes()) {
      damping += S(applied.viscous_1);
      spinning -= S(applied.viscous_3 / top.I3) * spin;
    }
  }
  if (applied.given.acts) {
    const Vec3<T> given = applied.given.at(t);
    if (applied.given.in_laboratory) {
      p += S(given[2] / top.I1);
      spinning += S(T(1) / top.I3) * (S(given[0]) * e + S(given[1]) * n);
    } else {
      spinning += S(given[2] / top.I3);
    }
  }
  p -= S(T(1) / top.I1) * damping * x.p;
  return {p, spinning};
}

/// @tparam O  laboratory: the reference is the base; inertial: the rotating motion is
template <class T, Observer O>
struct CompassEquations {
  static_assert(O != Observer::body);
  static constexpr std::size_t kSize = CompassShape::kSize;
  using State = std::array<T, kSize>;

  Model<T> model;
  ReducedTop<T> top;
  T east, north;  ///< the axis at release
  T w3;           ///< inertial spin of the base at release
  T carried;      ///< W.n of the base at release
  EARTHTOP_MEMBERS(model, top, east, north, w3, carried)

  void operator()(const State& x, State& dxdt, T t) const {
    const T& epsilon = model.epsilon;
    const CompassMotion<Paired<T>> both = motions(x);
    const PivotField<T> field = pivot_field<SceneKind::full>(model, t);
    const Vec3<Paired<T>> W_L = paired_vector(Vec3<T>(Vec3<T>::Zero()), model.W_IL_L, model.W_IL_L_scaled);
    const Vec3<Paired<T>> field_L = paired_vector(field.reference_L, field.rotating_L, field.difference_L_scaled);
    const CompassRates<Paired<T>> rates = compass_rates<T, Paired<T>>(model, top, both, W_L, field_L, t);
    const T turning = x[2] / T(2);
    dxdt[0] = -turning * x[1];
    dxdt[1] = turning * x[0];
    dxdt[2] = rates.p.*base();
    dxdt[3] = rates.w3.*base();
    const Paired<T> axial = W_L[0] * both.n_east + W_L[1] * both.n_north;
    dxdt[4] = x[3] + (carried - axial.*base());
    dxdt[5] = -epsilon * epsilon * x[6] * x[7] / T(2);
    dxdt[6] = x[5] * x[7] / T(2);
    dxdt[7] = rates.p.diff;
    dxdt[8] = rates.w3.diff;
    dxdt[9] = x[8] - axial.diff;
  }

  /// The motions of which one is the base.
  CompassMotion<Paired<T>> motions(const State& x) const {
    using real::conserved;
    const T &epsilon = model.epsilon, &w = x[5], &y = x[6];
    const auto [e, n] = turned_axis(x[0], x[1], east, north);
    // (R_z - 1) / epsilon for the turn from the base to the other motion, whose sine has the sign of the base's place.
    const T s = conserved(T(T(2) / (w * w + epsilon * epsilon * y * y)));
    const T wy = s * (w * y), yy = epsilon * s * (y * y);
    const T sign = O == Observer::laboratory ? T(1) : T(-1);
    const T change_e = -sign * wy * n - yy * e, change_n = sign * wy * e - yy * n;
    const auto pair = [&](const T& value, const T& change) {
      if constexpr (O == Observer::laboratory) return Paired<T>(value, value + epsilon * change, change);
      return Paired<T>(value + epsilon * change, value, -change);
    };
    const auto deviating = [&](const T& value, const T& deviation) {
      return pair(value, O == Observer::laboratory ? T(deviation) : T(-deviation));
    };
    return {pair(e, change_e), pair(n, change_n), deviating(x[2], x[7]), deviating(T(w3 + x[3]), x[8])};
  }

 private:
  static constexpr T Paired<T>::*base() { return O == Observer::laboratory ? &Paired<T>::ref : &Paired<T>::rot; }
};

}  // namespace earthtop
