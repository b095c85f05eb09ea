// SPDX-License-Identifier: GPL-3.0-or-later
/// The series of any body's reference and deviation in body axes, for points side by side:
///
///   dq/dt = q w_ref / 2 ,  Theta dw_ref/dt = (Theta w_ref) x w_ref + m r x g_B
///   dp/dt = p x w_rot + (Theta w_ref) x Dw + m r x F ,  Dw = Theta^-1 p ,  w_rot = w_ref + epsilon Dw
///   F = (R_rot^T g_rot - R_ref^T g) / epsilon
///
/// Seen from the laboratory (deviation.hpp) the attitude deviation (w, epsilon y) turns at Dw on one side and at W_B = R_ref^T
/// W on the other, so that W need not be turned by it:
///   dw/dt = -epsilon^2 y.d / 2 ,  dy/dt = w d / 2 + y x (w_ref + epsilon (Dw + W_B) / 2) ,  d = Dw - W_B
///   F = (2 / |e|^2) (-w c + epsilon y x c) ,  c = y x g_B
///
/// Seen from inertial space it turns at Dw alone (above, d = Dw and W_B = 0), and gravity g + epsilon h turns with the Earth.
/// W, g and h as seen from the reference body are integrated too, instead of being derived from q:
///   dW_B/dt = W_B x w_ref ,  dg_B/dt = g_B x w_ref ,  dh_B/dt = h_B x w_ref + W_B x (g_B + epsilon h_B)
///   F = h_B + (2 / |e|^2) (-w c + epsilon y x c) ,  c = y x (g_B + epsilon h_B)
///
/// W stands for the Earth's rate over epsilon.
#pragma once

#include "drift/lanes/general_drift_kernels.hpp"
#include "integrate/lanes/kernel.ipp"

namespace earthtop::lanes {
namespace {

enum class SeenFrom { laboratory, inertial };

template <SeenFrom kFrom>
class GeneralDriftSeries {
 public:
  static constexpr bool kInertial = kFrom == SeenFrom::inertial;
  static constexpr int kCoordinates = 0;
  static constexpr int kVariables = kInertial ? kInertialBodyDriftVariables : kBodyDriftVariables;
  static constexpr int kGroupCount = kInertial ? 7 : 4;
  static constexpr const Group* kGroups = kInertial ? kInertialBodyDriftGroups : kBodyDriftGroups;

 private:
  static constexpr int kQ = 0, kRate = 4, kE = 7, kY = 8, kP = 11;
  static constexpr int kWB = 14, kGB = 17, kHB = 20;  // inertial only
  // Further series, in this order: Theta w_ref; Dw; w_rot; d; the factor of y x ... in dy/dt; gravity g_B + epsilon h_B; c.
  static constexpr int kL = kVariables, kDw = kL + 3, kRotating = kDw + 3, kD = kRotating + 3, kMean = kD + 3,
                       kGravity = kMean + 3, kC = kGravity + 3;

 public:
  static constexpr int kStored = kC + 3;
  using C = Coefficients<kStored>;

  EARTHTOP_LANE_INLINE GeneralDriftSeries(const Row* constants, int chunk)
      : inertia_(vector(constants, GeneralDriftConstants::inertia, chunk)),
        inertia_beside_(vector(constants, GeneralDriftConstants::inertia_beside, chunk)),
        inverse_reciprocal_(vector(constants, GeneralDriftConstants::inverse_reciprocal, chunk)),
        inverse_beside_(vector(constants, GeneralDriftConstants::inverse_beside, chunk)),
        mass_moment_(vector(constants, GeneralDriftConstants::mass_moment, chunk)),
        gravity_(load(constants[GeneralDriftConstants::gravity], chunk)),
        epsilon_(load(constants[GeneralDriftConstants::epsilon], chunk)),
        W_(vector(constants, GeneralDriftConstants::W_scaled, chunk)) {}

  /// Notes the norms of q and e, which are constant along the exact motion: their round-off must not scale a torque.
  EARTHTOP_LANE_INLINE void start(const C& c) {
    Pack of_q{};
    for (int i = 0; i < 4; ++i) of_q += c.get(0, kQ + i) * c.get(0, kQ + i);
    inverse_norm_squared_ = spread(1.0) / of_q;
    const Vec y = c.vector(0, kY);
    turn_scale_ = spread(2.0) / (c.get(0, kE) * c.get(0, kE) + epsilon_ * epsilon_ * dot(y, y));
  }

  EARTHTOP_LANE_INLINE void extend(const C& c, int k) const {
    const Vec w_ref = c.vector(k, kRate), Dw = inverse_times(c.vector(k, kP));
    c.put(k, kL, inertia_times(w_ref));
    c.put(k, kDw, Dw);
    c.put(k, kRotating, w_ref + epsilon_ * Dw);
    const Pack factor = spread(1.0 / (k + 1)), half = spread(0.5) * factor;
    put_attitude(c, k, half);

    Vec W_B{}, g_B, all_gravity;
    if constexpr (kInertial) {
      g_B = c.vector(k, kGB);
      all_gravity = g_B + epsilon_ * c.vector(k, kHB);
      c.put(k, kGravity, all_gravity);
      put_what_turns(c, k, factor);
    } else {
      const Seen seen = seen_from_body(c, k);
      W_B = seen.W;
      g_B = all_gravity = seen.gravity;
      c.put(k, kGravity, all_gravity);
    }
    c.put(k, kD, Dw - W_B);
    c.put(k, kMean, w_ref + spread(0.5) * epsilon_ * (Dw + W_B));

    const Deviation deviation = turned_deviation(c, k);
    c.put(k + 1, kE, -epsilon_ * epsilon_ * (half * deviation.dot));
    c.put(k + 1, kY, half * deviation.scaled + factor * deviation.turned);
    c.put(k, kC, deviation.c);
    const Vec F = gravity_difference(c, k);

    const Rates rates = momentum_rates(c, k);
    c.put(k + 1, kRate, factor * inverse_times(rates.reference + cross(mass_moment_, g_B)));
    c.put(k + 1, kP, factor * (rates.deviation + cross(mass_moment_, F)));
  }

 private:
  EARTHTOP_LANE_INLINE static Vec vector(const Row* constants, int row, int chunk) {
    return {load(constants[row], chunk), load(constants[row + 1], chunk), load(constants[row + 2], chunk)};
  }
  /// The product of v with a symmetric matrix that is zero on the diagonal and has the elements m beside it.
  EARTHTOP_LANE_INLINE static Vec beside_times(const Vec& m, const Vec& v) {
    return {m.x * v.y + m.y * v.z, m.x * v.x + m.z * v.z, m.y * v.x + m.z * v.y};
  }
  EARTHTOP_LANE_INLINE Vec inertia_times(const Vec& v) const {
    return Vec{inertia_.x * v.x, inertia_.y * v.y, inertia_.z * v.z} + beside_times(inertia_beside_, v);
  }
  EARTHTOP_LANE_INLINE Vec inverse_times(const Vec& v) const {
    return Vec{v.x / inverse_reciprocal_.x, v.y / inverse_reciprocal_.y, v.z / inverse_reciprocal_.z} +
           beside_times(inverse_beside_, v);
  }

  /// Puts in dq/dt = q w_ref / 2.
  EARTHTOP_LANE_INLINE static void put_attitude(const C& c, int k, Pack half) {
    Vec scaled{}, along{}, plus{}, minus{};
    const Pack *q = c.at(0) + kQ, *w = c.at(k) + kRate;
    for (int j = 0; j <= k; ++j, q += kStored, w -= kStored) {
      const Pack s = q[0];
      const Vec v{q[1], q[2], q[3]};
      scaled.x += s * w[0], scaled.y += s * w[1], scaled.z += s * w[2];
      along.x += v.x * w[0], along.y += v.y * w[1], along.z += v.z * w[2];
      add_cross(v, w, plus, minus);
    }
    c.put(k + 1, kQ, -half * (along.x + along.y + along.z));
    c.put(k + 1, kQ + 1, half * (scaled + (plus - minus)));
  }

  struct Seen {
    Vec W, gravity;
  };
  /// The Earth's rate and gravity, which is vertical, as seen from the reference body:
  /// R_LB^T u = ((w^2 - v^2) u + 2 v (v.u) - 2 w v x u) / |q|^2 for q = (w, v).
  EARTHTOP_LANE_INLINE Seen seen_from_body(const C& c, int k) const {
    Vec vv{}, mixed{}, wv{};
    Pack ww{};
    const Pack *a = c.at(0) + kQ, *b = c.at(k) + kQ;
    for (int j = 0; j <= k; ++j, a += kStored, b -= kStored) {
      ww += a[0] * b[0];
      wv.x += a[0] * b[1], wv.y += a[0] * b[2], wv.z += a[0] * b[3];
      vv.x += a[1] * b[1], vv.y += a[2] * b[2], vv.z += a[3] * b[3];
      mixed.x += a[1] * b[2], mixed.y += a[2] * b[3], mixed.z += a[3] * b[1];
    }
    const Pack two = spread(2.0), difference = ww - (vv.x + vv.y + vv.z);
    const Vec along{vv.x * W_.x + mixed.x * W_.y + mixed.z * W_.z, mixed.x * W_.x + vv.y * W_.y + mixed.y * W_.z,
                    mixed.z * W_.x + mixed.y * W_.y + vv.z * W_.z};
    const Pack s = two * inverse_norm_squared_ * gravity_;
    Vec gravity{s * (mixed.z - wv.y), s * (mixed.y + wv.x), -s * (vv.x + vv.y)};
    if (k == 0) gravity.z = gravity.z + gravity_;
    return {inverse_norm_squared_ * (difference * W_ + two * along - two * cross(wv, W_)), gravity};
  }

  /// Puts in the time derivatives of W, g and h as seen from the reference body.
  EARTHTOP_LANE_INLINE static void put_what_turns(const C& c, int k, Pack factor) {
    Vec W_plus{}, W_minus{}, g_plus{}, g_minus{}, h_plus{}, h_minus{};
    const Pack *w = c.at(0) + kRate, *with = c.at(k);
    for (int j = 0; j <= k; ++j, w += kStored, with -= kStored) {
      const Vec rate{w[0], w[1], w[2]};
      add_cross(rate, with + kWB, W_plus, W_minus);
      add_cross(rate, with + kGB, g_plus, g_minus);
    }
    const Pack* W = c.at(0) + kWB;
    w = c.at(0) + kRate, with = c.at(k);
    for (int j = 0; j <= k; ++j, w += kStored, W += kStored, with -= kStored) {
      add_cross(Vec{W[0], W[1], W[2]}, with + kGravity, h_plus, h_minus);
      add_cross(Vec{w[0], w[1], w[2]}, with + kHB, h_minus, h_plus);  // h x w_ref
    }
    c.put(k + 1, kWB, factor * (W_minus - W_plus));
    c.put(k + 1, kGB, factor * (g_minus - g_plus));
    c.put(k + 1, kHB, factor * (h_plus - h_minus));
  }

  /// Products that the equations of the deviation need.
  struct Deviation {
    Vec scaled;  ///< w d
    Pack dot;    ///< y.d
    Vec turned;  ///< y x (w_ref + epsilon (Dw + W_B) / 2)
    Vec c;       ///< y x gravity
  };
  EARTHTOP_LANE_INLINE static Deviation turned_deviation(const C& c, int k) {
    Vec scaled{}, along{}, plus{}, minus{}, c_plus{}, c_minus{};
    const Pack *e = c.at(0) + kE, *with = c.at(k);
    for (int j = 0; j <= k; ++j, e += kStored, with -= kStored) {
      const Pack w = e[0], *d = with + kD;
      const Vec y{e[1], e[2], e[3]};
      scaled.x += w * d[0], scaled.y += w * d[1], scaled.z += w * d[2];
      along.x += y.x * d[0], along.y += y.y * d[1], along.z += y.z * d[2];
      add_cross(y, with + kMean, plus, minus);
      add_cross(y, with + kGravity, c_plus, c_minus);
    }
    return {scaled, along.x + along.y + along.z, plus - minus, c_plus - c_minus};
  }
  /// F, the difference of gravity as seen from the two bodies, divided by epsilon.
  EARTHTOP_LANE_INLINE Vec gravity_difference(const C& c, int k) const {
    Vec scaled{}, plus{}, minus{};
    const Pack *e = c.at(0) + kE, *of_c = c.at(k) + kC;
    for (int j = 0; j <= k; ++j, e += kStored, of_c -= kStored) {
      const Pack w = e[0];
      scaled.x += w * of_c[0], scaled.y += w * of_c[1], scaled.z += w * of_c[2];
      add_cross(Vec{e[1], e[2], e[3]}, of_c, plus, minus);
    }
    Vec F = turn_scale_ * (epsilon_ * (plus - minus) - scaled);
    if constexpr (kInertial) F = F + c.vector(k, kHB);
    return F;
  }

  struct Rates {
    Vec reference, deviation;
  };
  /// The torque-free parts of the rates: (Theta w_ref) x w_ref, and p x w_rot + (Theta w_ref) x Dw.
  EARTHTOP_LANE_INLINE static Rates momentum_rates(const C& c, int k) {
    Vec plus{}, minus{}, p_plus{}, p_minus{};
    const Pack *left = c.at(0), *with = c.at(k);
    for (int j = 0; j <= k; ++j, left += kStored, with -= kStored) {
      const Vec L{left[kL], left[kL + 1], left[kL + 2]};
      add_cross(L, with + kRate, plus, minus);
      add_cross(L, with + kDw, p_plus, p_minus);
      add_cross(Vec{left[kP], left[kP + 1], left[kP + 2]}, with + kRotating, p_plus, p_minus);
    }
    return {plus - minus, p_plus - p_minus};
  }

  Vec inertia_, inertia_beside_, inverse_reciprocal_, inverse_beside_, mass_moment_;
  Pack gravity_, epsilon_;
  Vec W_;
  Pack inverse_norm_squared_{}, turn_scale_{};
};

}  // namespace
}  // namespace earthtop::lanes

#define EARTHTOP_GENERAL_DRIFT_KERNELS(set)                                                      \
  namespace earthtop::lanes {                                                                    \
  const Kernel kBodyDrift_##set{step_block<GeneralDriftSeries<SeenFrom::laboratory>>,            \
                                evaluate_block<GeneralDriftSeries<SeenFrom::laboratory>>};       \
  const Kernel kInertialBodyDrift_##set{step_block<GeneralDriftSeries<SeenFrom::inertial>>,      \
                                        evaluate_block<GeneralDriftSeries<SeenFrom::inertial>>}; \
  }
