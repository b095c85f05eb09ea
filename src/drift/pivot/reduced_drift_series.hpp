// SPDX-License-Identifier: GPL-3.0-or-later
/// The Taylor series of a symmetric top's reference and deviation without its spin (reduced_drift_system.hpp), in laboratory or
/// in inertial axes. The equations are quadratic except for the turn of the deviation, whose coefficients are found first. In
/// inertial axes gravity turns with the Earth; its coefficients follow from dG/dt = W x G.
#pragma once

#include "drift/deviation_state.hpp"
#include "earthtop/integrate/options.hpp"
#include "earthtop/model/equations.hpp"
#include "earthtop/model/reduced_top.hpp"
#include "integrate/state_vectors.hpp"
#include "integrate/taylor/packed_products.hpp"

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
/// @tparam O  laboratory or inertial
template <class T, Observer O>
class ReducedDriftSeries {
 public:
  using State = std::array<T, 16>;

  ReducedDriftSeries(const Model<T>& model, const ReducedTop<T>& top, const ReducedDriftConstants<T>& constants)
      : model_(model),
        top_(top),
        constants_(constants),
        epsilon_(model.epsilon),
        W_{model.W_IL_L_scaled[0], model.W_IL_L_scaled[1], model.W_IL_L_scaled[2], T(0)},
        g_{model.apparent_gravity_L[0], model.apparent_gravity_L[1], model.apparent_gravity_L[2], T(0)} {}

  /// Notes |n|, u.n and the norm of the deviation, which are constant along the exact motion.
  void start(const State& x, T t) {
    if constexpr (O == Observer::inertial) turn_gravity(t);
    const Vec3<T> n = load_vector(x, 0), u = load_vector(x, 3), y = load_vector(x, 10);
    moment_ = moment_factor(top_, n);
    u_along_n_ = u.dot(n);
    turn_scale_ = T(2) / (x[9] * x[9] + epsilon_ * epsilon_ * y.dot(y));
  }
  /// Finds the coefficients of the orders 1 to `order`. @param x  the coefficients, with that of order 0
  void expand(State* x, int order) { expand_series(*this, x, order); }

  /// The same, as a part of a function compiled for each processor.
  /// @tparam kWidth  how many numbers the processor's vectors have
  template <int kWidth>
  EARTHTOP_PACK_INLINE void expand_here(State* x, int order) {
    const State& at = x[0];
    Term term{{at[0], at[1], at[2], T(0)},    {at[3], at[4], at[5], T(0)},    {at[6], at[7], at[8], T(0)},
              {at[10], at[11], at[12], T(0)}, {at[13], at[14], at[15], T(0)}, at[9]};
    taylor::for_each_order(
        order, [&]<taylor::Place kPlace>(int k) __attribute__((always_inline)) {
          extend<kPlace, kWidth>(k, term);
          store(term, x[k + 1]);
        });
  }

 private:
  using Four = taylor::Pack<T, 4>;
  /// The coefficients of one order; vectors take three of four numbers.
  struct Term {
    Four n, u, a, y, V;
    T w;
  };
  /// A vector with its components moved round, as the factors of a cross product.
  struct Moved {
    Four yzx, zxy;
    EARTHTOP_PACK_INLINE explicit Moved(const Four& v) {
      taylor::pick<1, 2, 0, 3, T>(v, v, yzx), taylor::pick<2, 0, 1, 3, T>(v, v, zxy);
    }
  };
  struct Cross {
    Four plus, minus;
  };

  /// Finds the coefficients of order k + 1 from those of order k.
  template <taylor::Place kPlace, int kWidth>
  EARTHTOP_PACK_INLINE void extend(int k, Term& x) {
    const Moved n(x.n), u(x.u), across(x.u - x.n * u_along_n_), a(x.a), V(x.V), y(x.y);
    const Four w{x.w, x.w, x.w, T(0)};
    Cross axis, frame, rates, across_axis;
    Four wy, yy, mixed;
    put_cross<kPlace>(first_, k, kAxis, u, n, axis);
    put_cross<kPlace>(first_, k, kFrame, across, a, frame);
    put_cross<kPlace>(first_, k, kRates, u, V, rates);
    put_cross<kPlace>(first_, k, kAcross, n, V, across_axis);
    first_.template put<kPlace, 4>(k, kTurn, w, x.y, wy);
    first_.template put<kPlace, 4>(k, kTurn + 4, x.y, x.y, yy);
    first_.template put<kPlace, 4>(k, kTurn + 8, x.y, y.yzx, mixed);
    first_.template convolve<kPlace, kWidth>(k);

    first_.template complete<kPlace, 4>(k, kTurn, wy);
    first_.template complete<kPlace, 4>(k, kTurn + 4, yy);
    first_.template complete<kPlace, 4>(k, kTurn + 8, mixed);
    std::array<Four, 3> M;
    turn_matrix(wy * turn_scale_, yy * (turn_scale_ * epsilon_), mixed * (turn_scale_ * epsilon_), M);
    Four d = x.V + x.n * constants_.k, change = M[0] * g_[0] + M[1] * g_[1] + M[2] * g_[2];
    if constexpr (O == Observer::laboratory) {
      d = d - (M[0] * W_[0] + M[1] * W_[1] + M[2] * W_[2]) * epsilon_;
      if constexpr (kPlace == taylor::Place::first) d = d - W_;
    } else {
      // The rotating top's gravity minus the reference's: turned back by the deviation, and turned by the Earth, or both.
      const Four& c = gravity_change_[static_cast<std::size_t>(k)];
      std::array<Four, 3> both;
      for (std::size_t i = 0; i < 3; ++i) {
        const T ci = c[static_cast<int>(i)];
        turned_.template put<kPlace, 4>(k, 4 * static_cast<int>(i), M[i], Four{ci, ci, ci, T(0)}, both[i]);
      }
      turned_.template convolve<kPlace, kWidth>(k);
      for (std::size_t i = 0; i < 3; ++i) turned_.template complete<kPlace, 4>(k, 4 * static_cast<int>(i), both[i]);
      change = (change + c) + (both[0] + both[1] + both[2]) * epsilon_;
    }
    const Moved turned_gravity(change), d_moved(d);
    Four scaled, dots;
    Cross vector, torque;
    second_.template put<kPlace, 4>(k, kScalar, w, d, scaled);
    second_.template put<kPlace, 4>(k, kDot, x.y, d, dots);
    put_cross<kPlace>(second_, k, kVector, y, d_moved, vector);
    put_cross<kPlace>(second_, k, kTorque, n, turned_gravity, torque);
    second_.template convolve<kPlace, kWidth>(k);

    const T factor = T(1) / T(k + 1);
    Four s, v;
    complete_cross<kPlace>(first_, k, kAxis, axis, s);
    const Moved g(g_);
    x.u = (((n.yzx * g.zxy - n.zxy * g.yzx) * moment_ - s * constants_.b.value) - s * constants_.b.rest) * factor;
    x.n = s * factor;
    complete_cross<kPlace>(first_, k, kFrame, frame, v);
    x.a = v * factor;
    second_.template complete<kPlace, 4>(k, kDot, dots);
    x.w = factor * (-epsilon_ * epsilon_ * (dots[0] + dots[1] + dots[2]) / T(2));
    second_.template complete<kPlace, 4>(k, kScalar, scaled);
    complete_cross<kPlace>(second_, k, kVector, vector, v);
    x.y = (scaled + v * epsilon_) * (factor / T(2));
    complete_cross<kPlace>(first_, k, kRates, rates, v);
    x.V = v + s * constants_.axis_rate_factor;
    complete_cross<kPlace>(first_, k, kAcross, across_axis, v);
    x.V = x.V + v * constants_.cross_factor;
    complete_cross<kPlace>(second_, k, kTorque, torque, v);
    x.V = (x.V + v * moment_) * factor;
  }

  /// The coefficients of (R_NL(t) - 1) g / epsilon, the change of gravity by the Earth's turn since the release.
  void turn_gravity(T t) {
    const Vec3<T>&g = model_.apparent_gravity_L, &W = model_.W_IL_L_scaled;
    const LaboratoryTurn<T> turn = laboratory_turn(model_, t);
    Vec3<T> change = turn_minus_one_scaled(turn.w, turn.v_scaled, epsilon_, g), gravity = g + epsilon_ * change;
    for (std::size_t k = 0; k < gravity_change_.size(); ++k) {
      gravity_change_[k] = Four{change[0], change[1], change[2], T(0)};
      change = W.cross(gravity) / T(k + 1);
      gravity = epsilon_ * change;
    }
  }

  template <taylor::Place kPlace, class Products>
  EARTHTOP_PACK_INLINE static void put_cross(Products& products, int k, int lane, const Moved& a, const Moved& b,
                                             Cross& newest) {
    products.template put<kPlace, 4>(k, lane, a.yzx, b.zxy, newest.plus);
    products.template put<kPlace, 4>(k, lane + 4, a.zxy, b.yzx, newest.minus);
  }
  template <taylor::Place kPlace, class Products>
  EARTHTOP_PACK_INLINE static void complete_cross(const Products& products, int k, int lane, Cross& newest, Four& cross) {
    products.template complete<kPlace, 4>(k, lane, newest.plus);
    products.template complete<kPlace, 4>(k, lane + 4, newest.minus);
    cross = newest.plus - newest.minus;
  }

  /// The columns of M = (R(e)^T - 1) / epsilon = s (-w [y]x + epsilon (y y^T - y.y)), where s = 2/|e|^2, for the deviation
  /// quaternion e = (w, epsilon y).
  /// @param wy  s w y   @param yy  s epsilon y_i y_i   @param mixed  s epsilon y_i y_(i+1)
  EARTHTOP_PACK_INLINE static void turn_matrix(const Four& wy, const Four& yy, const Four& mixed, std::array<Four, 3>& M) {
    using taylor::pick;
    Four w_moved, yy_first, yy_second, part;
    pick<2, 0, 1, 3, T>(wy, wy, w_moved);
    pick<1, 0, 0, 3, T>(yy, yy, yy_first), pick<2, 2, 1, 3, T>(yy, yy, yy_second);
    const Four less = mixed - w_moved, more = mixed + w_moved, diagonal = -yy_first - yy_second;
    pick<0, 0, 6, 3, T>(less, more, part), pick<4, 1, 2, 3, T>(part, diagonal, M[0]);
    pick<4, 0, 1, 3, T>(less, more, part), pick<0, 5, 2, 3, T>(part, diagonal, M[1]);
    pick<2, 5, 0, 3, T>(less, more, part), pick<0, 1, 6, 3, T>(part, diagonal, M[2]);
  }
  EARTHTOP_PACK_INLINE static void store(const Term& x, State& to) {
    for (int i = 0; i < 3; ++i) {
      const auto at = static_cast<std::size_t>(i);
      to[at] = x.n[i], to[3 + at] = x.u[i], to[6 + at] = x.a[i], to[10 + at] = x.y[i], to[13 + at] = x.V[i];
    }
    to[9] = x.w;
  }

  static constexpr int kAxis = 0, kFrame = 8, kRates = 16, kAcross = 24, kTurn = 32;
  static constexpr int kScalar = 0, kDot = 4, kVector = 8, kTorque = 16;
  const Model<T>& model_;
  ReducedTop<T> top_;
  ReducedDriftConstants<T> constants_;
  T epsilon_, moment_ = T(0), u_along_n_ = T(0), turn_scale_ = T(2);
  Four W_, g_;
  taylor::PackedProducts<T, 44> first_;
  taylor::PackedProducts<T, 24> second_;
  // Only in inertial axes:
  taylor::PackedProducts<T, 12> turned_;
  std::array<Four, taylor::kMostOrder<T>> gravity_change_{};
};

}  // namespace earthtop
