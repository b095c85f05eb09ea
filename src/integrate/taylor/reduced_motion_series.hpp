// SPDX-License-Identifier: GPL-3.0-or-later
/// The Taylor series of a symmetric top's motion without its spin (reduced_top.hpp); it takes two cross products at each order.
#pragma once

#include "earthtop/integrate/motion_integration.hpp"
#include "integrate/inline_all.hpp"
#include "integrate/state_vectors.hpp"
#include "integrate/taylor/products.hpp"

namespace earthtop {

/// The series of the state n, u and, where the attitude is sought, a; in laboratory axes.
template <class T, MotionSought S>
class ReducedMotionSeries {
 public:
  static constexpr bool kAttitude = S == MotionSought::attitude;
  using State = std::array<T, kAttitude ? 9 : 6>;

  ReducedMotionSeries(const ReducedTop<T>& top, const NutationRate<T>& b, const Vec3<T>& W_L, const Vec3<T>& gravity_L)
      : top_(top), b_(b), W_L_(W_L), gravity_L_(gravity_L) {}

  /// Notes |n| and u.n, which are constant along the exact motion: their round-off must neither scale the torque nor spin the
  /// frame.
  void start(const State& x) {
    const Vec3<T> n = load_vector(x, 0), u = load_vector(x, 3);
    moment_ = moment_factor(top_, n);
    u_along_n_ = u.dot(n);
  }
  EARTHTOP_INLINE_ALL void extend(int k, const State& x, State& next) {
    const Vec3<T> n = load_vector(x, 0), u = load_vector(x, 3);
    products_.put_cross(k, 0, u, n);
    Vec3<T> a;
    if constexpr (kAttitude) {
      a = load_vector(x, 6);
      products_.put_cross(k, 6, Vec3<T>(u - u_along_n_ * n), a);
    }
    products_.convolve(k);
    const T factor = T(1) / T(k + 1);
    const Vec3<T> s = products_.cross(0);
    store_vector(factor * (s - W_L_.cross(n)), next, 0);
    store_vector(factor * (moment_ * n.cross(gravity_L_) - b_.value * s - (b_.rest * s + W_L_.cross(u))), next, 3);
    if constexpr (kAttitude) store_vector(factor * (products_.cross(6) - W_L_.cross(a)), next, 6);
  }

 private:
  ReducedTop<T> top_;
  NutationRate<T> b_;
  Vec3<T> W_L_, gravity_L_;
  T moment_ = T(0), u_along_n_ = T(0);
  taylor::Products<T, kAttitude ? 12 : 6> products_;
};

}  // namespace earthtop
