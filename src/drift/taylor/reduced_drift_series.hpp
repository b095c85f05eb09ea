// SPDX-License-Identifier: GPL-3.0-or-later
/// The Taylor series of a symmetric top's reference and deviation without its spin (reduced_drift_system.hpp), in laboratory
/// axes. The equations are quadratic except for the turn of the deviation, whose coefficients are found first.
#pragma once

#include "drift/deviation_state.hpp"
#include "drift/taylor/deviation_turn.hpp"
#include "earthtop/model/reduced_top.hpp"
#include "integrate/inline_all.hpp"

namespace earthtop {

/// The constants of the motion that the reduced deviation equations read.
template <class T>
struct ReducedDriftConstants {
  NutationRate<T> b;                 ///< b of the reference
  T k;                               ///< deviation of the spin, divided by epsilon
  T axis_rate_factor, cross_factor;  ///< factors of s and of n x V in dV/dt
  ReducedDriftConstants(const ReducedTop<T>& top, T w3, T spin_deviation, T epsilon)
      : b(top, w3),
        k(spin_deviation),
        axis_rate_factor((T(1) - top.spin_ratio) * k),
        cross_factor(b.value - epsilon * axis_rate_factor) {}
};

/// The series of the state n, u, a, w, y, V.
template <class T>
class ReducedDriftSeries {
 public:
  using State = std::array<T, 16>;

  ReducedDriftSeries(const Model<T>& model, const ReducedTop<T>& top, const ReducedDriftConstants<T>& constants)
      : model_(model), top_(top), constants_(constants) {}

  void start(const State& x) {
    const Vec3<T> n = load_vector(x, 0), u = load_vector(x, 3);
    moment_ = moment_factor(top_, n);
    u_along_n_ = u.dot(n);
    turn_.start(x[9], load_vector(x, 10), model_.epsilon);
  }

  EARTHTOP_INLINE_ALL void extend(int k, const State& x, State& next) {
    const Vec3<T> n = load_vector(x, 0), u = load_vector(x, 3), a = load_vector(x, 6);
    const Vec3<T> y = load_vector(x, 10), V = load_vector(x, 13);
    const T w = x[9], epsilon = model_.epsilon;
    const Vec3<T>& g_L = model_.apparent_gravity_L;
    first_.put_cross(k, kAxis, u, n);
    first_.put_cross(k, kFrame, Vec3<T>(u - u_along_n_ * n), a);
    first_.put_cross(k, kRates, u, V);
    first_.put_cross(k, kAcross, n, V);
    DeviationTurn<T>::put(first_, k, kTurn, w, y);
    first_.convolve(k);

    const Mat3<T> M = turn_.matrix(first_, kTurn);
    Vec3<T> d = V + constants_.k * n - epsilon * times(M, model_.W_IL_L_scaled);
    if (k == 0) d -= model_.W_IL_L_scaled;
    second_.put_scaled(k, kScalar, w, d);
    second_.put_cross(k, kVector, y, d);
    second_.put_parallel(k, kDot, y, d);
    second_.put_cross(k, kTorque, n, times(M, g_L));
    second_.convolve(k);

    const T factor = T(1) / T(k + 1);
    const Vec3<T> s = first_.cross(kAxis);
    store_vector(factor * s, next, 0);
    store_vector(factor * (moment_ * n.cross(g_L) - constants_.b.value * s - constants_.b.rest * s), next, 3);
    store_vector(factor * first_.cross(kFrame), next, 6);
    next[9] = factor * (-epsilon * epsilon * second_.sum_of_three(kDot) / T(2));
    store_vector(factor * (Vec3<T>(second_.vector(kScalar) + epsilon * second_.cross(kVector)) / T(2)), next, 10);
    store_vector(factor * (first_.cross(kRates) + constants_.axis_rate_factor * s +
                           constants_.cross_factor * first_.cross(kAcross) + moment_ * second_.cross(kTorque)),
                 next, 13);
  }

 private:
  static constexpr int kAxis = 0, kFrame = 6, kRates = 12, kAcross = 18, kTurn = 24;
  static constexpr int kScalar = 0, kVector = 3, kDot = 9, kTorque = 12;
  const Model<T>& model_;
  ReducedTop<T> top_;
  ReducedDriftConstants<T> constants_;
  DeviationTurn<T> turn_;
  T moment_ = T(0), u_along_n_ = T(0);
  taylor::Products<T, kTurn + DeviationTurn<T>::kLanes> first_;
  taylor::Products<T, 18> second_;
};

}  // namespace earthtop
