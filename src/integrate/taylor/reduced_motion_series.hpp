// SPDX-License-Identifier: GPL-3.0-or-later
/// The Taylor series of a symmetric top's motion without its spin (reduced_top.hpp); it takes two cross products at each order.
#pragma once

#include "earthtop/integrate/motion_integration.hpp"
#include "integrate/state_vectors.hpp"
#include "integrate/taylor/packed_products.hpp"

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
  /// Finds the coefficients of the orders 1 to `order`. @param x  the coefficients, with that of order 0
  void expand(State* x, int order) { expand_series(*this, x, order); }

  /// The same, as a part of a function compiled for each processor.
  /// @tparam kWidth  how many numbers the processor's vectors have
  template <int kWidth>
  EARTHTOP_PACK_INLINE void expand_here(State* x, int order) {
    Term term;
    for (std::size_t i = 0; i < 3; ++i) {
      term.axis_and_frame[i] = Pair{x[0][i], T(0)};
      if constexpr (kAttitude) term.axis_and_frame[i] = Pair{x[0][i], x[0][6 + i]};
      term.u[static_cast<int>(i)] = x[0][3 + i];
    }
    taylor::for_each_order(
        order, [&]<taylor::Place kPlace>(int k) __attribute__((always_inline)) { extend<kPlace, kWidth>(k, term, x[k + 1]); });
  }

 private:
  using Pair = taylor::Pack<T, 2>;
  /// The coefficients of one order.
  struct Term {
    std::array<Pair, 3> axis_and_frame;  ///< n and a, side by side
    Vec3<T> u;
  };

  /// Finds the coefficients of order k + 1 from those of order k.
  template <taylor::Place kPlace, int kWidth>
  EARTHTOP_PACK_INLINE void extend(int k, Term& x, State& next) {
    std::array<Pair, 3> rates, turned;
    Vec3<T> n, s;
    for (int i = 0; i < 3; ++i) {
      n[i] = x.axis_and_frame[static_cast<std::size_t>(i)][0];
      rates[static_cast<std::size_t>(i)] = Pair{x.u[i], x.u[i] - u_along_n_ * n[i]};
    }
    taylor::CrossTerms<T, 2> terms;
    products_.template put_cross<kPlace, 2>(k, 0, rates, x.axis_and_frame, terms);
    products_.template convolve<kPlace, kWidth>(k);
    products_.template complete_cross<kPlace, 2>(k, 0, terms, turned);
    const T factor = T(1) / T(k + 1);
    for (int i = 0; i < 3; ++i) s[i] = turned[static_cast<std::size_t>(i)][0];
    x.u = factor * (moment_ * n.cross(gravity_L_) - b_.value * s - (b_.rest * s + W_L_.cross(x.u)));
    const std::array<Pair, 3> before = x.axis_and_frame;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, l = (i + 2) % 3;
      const Pair carried = both(W_L_[static_cast<int>(j)]) * before[l] - both(W_L_[static_cast<int>(l)]) * before[j];
      x.axis_and_frame[i] = both(factor) * (turned[i] - carried);
      next[i] = x.axis_and_frame[i][0];
      next[3 + i] = x.u[static_cast<int>(i)];
      if constexpr (kAttitude) next[6 + i] = x.axis_and_frame[i][1];
    }
  }
  EARTHTOP_PACK_INLINE static Pair both(T value) { return Pair{value, value}; }

  ReducedTop<T> top_;
  NutationRate<T> b_;
  Vec3<T> W_L_, gravity_L_;
  T moment_ = T(0), u_along_n_ = T(0);
  taylor::PackedProducts<T, 12> products_;
};

}  // namespace earthtop
