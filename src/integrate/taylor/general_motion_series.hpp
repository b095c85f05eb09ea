// SPDX-License-Identifier: GPL-3.0-or-later
/// The Taylor series of any body's motion in body axes (equations.hpp), for a plain scene.
#pragma once

#include "earthtop/model/equations.hpp"
#include "integrate/state_vectors.hpp"
#include "integrate/taylor/packed_products.hpp"

namespace earthtop {

/// The series of the state q_LB (4), w_IB_B (3).
template <class T>
class GeneralMotionSeries {
 public:
  using State = std::array<T, 7>;

  explicit GeneralMotionSeries(const Model<T>& model)
      : gravity_(model.apparent_gravity_L[2]), principal_(model.I_BP_B.isDiagonal(T(0))) {
    const Vec3<T>&W = model.W_IL_L, &m = model.mass_moment_B;
    rate_ = Four{T(0), W[0], W[1], W[2]};
    rate_plus_ = Four{-W[0], W[1], W[2], W[0]};
    rate_minus_ = Four{W[2], W[2], W[0], W[1]};
    rate_y_ = Four{W[1], T(0), T(0), T(0)};
    moment_plus_ = Four{-m[1], m[2], m[0], T(0)};
    moment_minus_ = Four{m[2], -m[0], m[1], T(0)};
    const Mat3<T>&I = model.I_BP_B, &inverse = model.I_BP_B_inverse;
    for (std::size_t j = 0; j < 3; ++j) {
      const int c = static_cast<int>(j);
      inertia_[j] = Four{I(0, c), I(1, c), I(2, c), T(0)};
      inverse_[j] = Four{inverse(0, c), inverse(1, c), inverse(2, c), T(0)};
    }
    moments_ = Four{I(0, 0), I(1, 1), I(2, 2), T(1)};
  }

  /// Notes |q|, which is constant along the exact motion: its round-off must not scale a torque.
  void start(const State& x) { double_inverse_norm_squared_ = T(2) / load_quaternion(x, 0).squared_norm(); }
  /// Finds the coefficients of the orders 1 to `order`. @param x  the coefficients, with that of order 0
  void expand(State* x, int order) { expand_series(*this, x, order); }

  /// The same, as a part of a function compiled for each processor.
  /// @tparam kWidth  how many numbers the processor's vectors have
  template <int kWidth>
  EARTHTOP_PACK_INLINE void expand_here(State* x, int order) {
    Four q{x[0][0], x[0][1], x[0][2], x[0][3]}, w{x[0][4], x[0][5], x[0][6], T(0)};
    taylor::for_each_order(
        order, [&]<taylor::Place kPlace>(int k) __attribute__((always_inline)) { extend<kPlace, kWidth>(k, q, w, x[k + 1]); });
  }

 private:
  using Four = taylor::Pack<T, 4>;

  /// Finds the coefficients of order k + 1 from those of order k.
  template <taylor::Place kPlace, int kWidth>
  EARTHTOP_PACK_INLINE void extend(int k, Four& q, Four& w, State& next) {
    using taylor::pick;
    Four h = moments_ * w;  // the angular momentum
    if (!principal_) h = inertia_[0] * w[0] + inertia_[1] * w[1] + inertia_[2] * w[2];
    const Four minus_q = -q;
    Four left, right, z_w, x_w, y_w, up_plus, up_minus, euler;
    // q w: the lanes are the sums of the four components. The numbers of q are (w, x, y, z).
    pick<7, 0, 0, 0, T>(q, minus_q, left), pick<2, 0, 1, 2, T>(w, w, right);
    put<kPlace>(k, 0, left, right, z_w);
    pick<5, 2, 3, 1, T>(q, minus_q, left), pick<0, 2, 0, 1, T>(w, w, right);
    put<kPlace>(k, 4, left, right, x_w);
    pick<2, 3, 1, 2, T>(q, q, left), pick<1, 1, 2, 0, T>(w, w, right);
    put<kPlace>(k, 8, left, right, y_w);
    // The vertical as seen from the body, (2 (x z - w y), 2 (y z + w x), |q|^2 - 2 (x^2 + y^2)) / |q|^2; and in the lanes left
    // over, h x w.
    pick<1, 2, 1, 4, T>(q, h, left), pick<3, 3, 1, 6, T>(q, w, right);
    put<kPlace>(k, 12, left, right, up_plus);
    pick<0, 0, 2, 5, T>(q, h, left), pick<2, 1, 2, 4, T>(q, w, right);
    put<kPlace>(k, 16, Four{T(-1), T(1), T(1), T(1)} * left, right, up_minus);
    pick<1, 2, 0, 2, T>(h, h, left), pick<2, 0, 1, 1, T>(w, w, right);
    put<kPlace>(k, 20, left, right, euler);
    products_.template convolve<kPlace, kWidth>(k);

    complete<kPlace>(k, 20, euler), complete<kPlace>(k, 12, up_plus), complete<kPlace>(k, 16, up_minus);
    Four torque = (euler - Four{euler[3], up_plus[3], up_minus[3], T(0)});
    add_gravity_torque<kPlace>(up_plus + up_minus, torque);
    const T order = T(k + 1);
    if (principal_)  // The rounding of an inverse would be the same at every step and add up to a phase error.
      w = torque / moments_ / order;
    else
      w = (inverse_[0] * torque[0] + inverse_[1] * torque[1] + inverse_[2] * torque[2]) / order;

    // dq/dt = (q w_IB_B - W_L q) / 2
    complete<kPlace>(k, 0, z_w), complete<kPlace>(k, 4, x_w), complete<kPlace>(k, 8, y_w);
    Four plus, minus, y;
    pick<1, 3, 1, 2, T>(q, q, plus), pick<3, 2, 3, 1, T>(q, q, minus), pick<2, 2, 2, 2, T>(q, q, y);
    const Four turned = rate_ * q[0] + ((rate_plus_ * plus - rate_y_ * y) - rate_minus_ * minus);
    q = ((z_w + (x_w - y_w)) - turned) / (T(2) * order);
    for (int i = 0; i < 4; ++i) next[static_cast<std::size_t>(i)] = q[i];
    for (std::size_t i = 0; i < 3; ++i) next[4 + i] = w[static_cast<int>(i)];
  }
  /// @param up  x z - w y, y z + w x, x^2 + y^2
  template <taylor::Place kPlace>
  EARTHTOP_PACK_INLINE void add_gravity_torque(const Four& up, Four& torque) const {
    const T s = double_inverse_norm_squared_;
    Four plus, minus;
    if constexpr (kPlace == taylor::Place::first) {
      const Four gravity = Four{s * up[0], s * up[1], s * up[2] - T(1), T(0)} * gravity_;
      taylor::pick<2, 0, 1, 3, T>(gravity, gravity, plus), taylor::pick<1, 2, 0, 3, T>(gravity, gravity, minus);
      torque = torque + (moment_plus_ * plus - moment_minus_ * minus);
    } else {
      taylor::pick<2, 0, 1, 3, T>(up, up, plus), taylor::pick<1, 2, 0, 3, T>(up, up, minus);
      torque = torque + (moment_plus_ * plus - moment_minus_ * minus) * (gravity_ * s);
    }
  }
  template <taylor::Place kPlace>
  EARTHTOP_PACK_INLINE void put(int k, int lane, const Four& left, const Four& right, Four& newest) {
    products_.template put<kPlace, 4>(k, lane, left, right, newest);
  }
  template <taylor::Place kPlace>
  EARTHTOP_PACK_INLINE void complete(int k, int lane, Four& newest) const {
    products_.template complete<kPlace, 4>(k, lane, newest);
  }

  T gravity_;
  bool principal_;
  Four moments_, rate_, rate_plus_, rate_minus_, rate_y_, moment_plus_, moment_minus_;
  std::array<Four, 3> inertia_, inverse_;
  T double_inverse_norm_squared_ = T(2);
  taylor::PackedProducts<T, 24> products_;
};

}  // namespace earthtop
