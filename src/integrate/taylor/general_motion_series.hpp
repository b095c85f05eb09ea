// SPDX-License-Identifier: GPL-3.0-or-later
/// The Taylor series of any body's motion in body axes (equations.hpp), for a plain scene.
#pragma once

#include "earthtop/model/equations.hpp"
#include "integrate/state_vectors.hpp"
#include "integrate/taylor/attitude_series.hpp"
#include "integrate/taylor/packed_products.hpp"

namespace earthtop {

/// The series of the state q_LB (4), w_IB_B (3).
template <class T>
class GeneralMotionSeries {
 public:
  using State = std::array<T, 7>;

  explicit GeneralMotionSeries(const Model<T>& model)
      : gravity_(model.apparent_gravity_L[2]), principal_(model.I_BP_B.isDiagonal(T(0))) {
    const Vec3<T> h = model.W_IL_L / T(2), &m = model.mass_moment_B;
    half_rate_ = Four{T(0), h[0], h[1], h[2]};
    half_rate_plus_ = Four{-h[0], h[1], h[2], h[0]};
    half_rate_minus_ = Four{h[2], h[2], h[0], h[1]};
    half_rate_y_ = Four{h[1], T(0), T(0), T(0)};
    moment_plus_ = Four{m[1], m[2], m[0], T(0)};
    moment_minus_ = Four{m[2], m[0], m[1], T(0)};
    for (std::size_t j = 0; j < 3; ++j) {
      const int c = static_cast<int>(j);
      const Mat3<T>&I = model.I_BP_B, &inverse = model.I_BP_B_inverse;
      inertia_[j] = Four{I(0, c), I(1, c), I(2, c), T(0)};
      inverse_[j] = Four{inverse(0, c), inverse(1, c), inverse(2, c), T(0)};
    }
    moments_ = Four{model.I_BP_B(0, 0), model.I_BP_B(1, 1), model.I_BP_B(2, 2), T(1)};
  }

  void start(const State& x) { attitude_.start(load_quaternion(x, 0)); }
  /// Finds the coefficients of the orders 1 to `order`. @param x  the coefficients, with that of order 0
  void expand(State* x, int order) { expand_series(*this, x, order); }

  /// The same, as a part of a function compiled for each processor.
  EARTHTOP_PACK_INLINE void expand_here(State* x, int order) {
    Four q{x[0][0], x[0][1], x[0][2], x[0][3]}, w{x[0][4], x[0][5], x[0][6], T(0)};
    extend<true>(0, q, w, x[1]);
    for (int k = 1; k < order; ++k) extend<false>(k, q, w, x[k + 1]);
  }

 private:
  using Four = taylor::Pack<T, 4>;

  /// Finds the coefficients of order k + 1 from those of order k.
  template <bool kFirst>
  EARTHTOP_PACK_INLINE void extend(int k, Four& q, Four& w, State& next) {
    using taylor::pick;
    Four h = moments_ * w;  // the angular momentum
    if (!principal_) h = inertia_[0] * w[0] + inertia_[1] * w[1] + inertia_[2] * w[2];
    const Four minus_q = -q;
    Four left, right, z_w, x_w, y_w, up_plus, up_minus, euler;
    // q w: the lanes are the sums of the four components. The numbers of q are (w, x, y, z).
    pick<7, 0, 0, 0, T>(q, minus_q, left), pick<2, 0, 1, 2, T>(w, w, right);
    put<kFirst>(k, 0, left, right, z_w);
    pick<5, 2, 3, 1, T>(q, minus_q, left), pick<0, 2, 0, 1, T>(w, w, right);
    put<kFirst>(k, 4, left, right, x_w);
    pick<2, 3, 1, 2, T>(q, q, left), pick<1, 1, 2, 0, T>(w, w, right);
    put<kFirst>(k, 8, left, right, y_w);
    // The vertical as seen from the body, (2 (x z - w y), 2 (y z + w x), |q|^2 - 2 (x^2 + y^2)) / |q|^2; and in the lanes left
    // over, h x w.
    pick<1, 2, 1, 4, T>(q, h, left), pick<3, 3, 1, 6, T>(q, w, right);
    put<kFirst>(k, 12, left, right, up_plus);
    pick<0, 0, 2, 5, T>(q, h, left), pick<2, 1, 2, 4, T>(q, w, right);
    put<kFirst>(k, 16, Four{T(-1), T(1), T(1), T(1)} * left, right, up_minus);
    pick<1, 2, 0, 2, T>(h, h, left), pick<2, 0, 1, 1, T>(w, w, right);
    put<kFirst>(k, 20, left, right, euler);
    products_.template convolve<kFirst>(k);

    const T order = T(k + 1);
    add_inner<kFirst>(20, euler), add_inner<kFirst>(12, up_plus), add_inner<kFirst>(16, up_minus);
    const T s = attitude_.double_inverse_norm_squared();
    const Four gravity = gravity_ * (Four{T(0), T(0), T(kFirst ? 1 : 0), T(0)} + Four{s, s, -s, T(0)} * (up_plus + up_minus));
    Four gravity_plus, gravity_minus;
    pick<2, 0, 1, 3, T>(gravity, gravity, gravity_plus), pick<1, 2, 0, 3, T>(gravity, gravity, gravity_minus);
    const Four torque = (euler - Four{euler[3], up_plus[3], up_minus[3], T(0)}) +
                        (moment_plus_ * gravity_plus - moment_minus_ * gravity_minus);
    if (principal_)  // the rounding of an inverse would be the same at every step and add up to a phase error
      w = torque / moments_ / order;
    else
      w = (inverse_[0] * torque[0] + inverse_[1] * torque[1] + inverse_[2] * torque[2]) / order;

    // dq/dt = (q w_IB_B - W_L q) / 2
    add_inner<kFirst>(0, z_w), add_inner<kFirst>(4, x_w), add_inner<kFirst>(8, y_w);
    const Four half_product = (z_w + (x_w - y_w)) / T(2);
    Four plus, minus, y;
    pick<1, 3, 1, 2, T>(q, q, plus), pick<3, 2, 3, 1, T>(q, q, minus), pick<2, 2, 2, 2, T>(q, q, y);
    const Four turned = (half_rate_plus_ * plus - half_rate_y_ * y) - half_rate_minus_ * minus;
    q = ((half_product - q[0] * half_rate_) - turned) / order;
    for (int i = 0; i < 4; ++i) next[static_cast<std::size_t>(i)] = q[i];
    for (int i = 0; i < 3; ++i) next[static_cast<std::size_t>(4 + i)] = w[i];
  }
  template <bool kFirst>
  EARTHTOP_PACK_INLINE void put(int k, int lane, const Four& left, const Four& right, Four& outer) {
    products_.template put<kFirst, 4>(k, lane, left, right, outer);
  }
  template <bool kFirst>
  EARTHTOP_PACK_INLINE void add_inner(int lane, Four& outer) const {
    products_.template add_inner<kFirst, 4>(lane, outer);
  }

  T gravity_;
  bool principal_;
  // Packs are stored as arrays: what holds packs has to be aligned as they are.
  Four moments_, half_rate_, half_rate_plus_, half_rate_minus_, half_rate_y_, moment_plus_, moment_minus_;
  std::array<Four, 3> inertia_, inverse_;
  AttitudeSeries<T> attitude_;
  taylor::PackedProducts<T, 24> products_;
};

}  // namespace earthtop
