// SPDX-License-Identifier: GPL-3.0-or-later
/// The series of a symmetric top's reference q and deviation delta (spherical_top_drift.hpp), for points side by side:
///
///   q''     = (Gamma z - c) q + Gamma k q k / 2 - mu q' k
///   delta'' = (Gamma z - c) delta + phi Q + Gamma k delta k / 2 - mu delta' k + E ,  Q = q + epsilon delta
///
/// with phi = Gamma zeta - j - tau / 2, z = 1 - 2 |beta|^2 and zeta = -2 beta_delta.(beta + beta_Q) + n_Q.h, where beta is the pair of the components 1 and 2
/// of a quaternion, and n_Q is the axis of Q. In laboratory axes h = 0,
///
///   E = -w (Q' + mu Q k / 2) ,  tau = w.lambda ,  tau' = -2 Gamma (Q3 (wx Q2 - wy Q1) - Q0 (wx Q1 + wy Q2))
///
/// and in inertial axes, where gravity turns with the Earth,
///
///   E = Gamma h Q k / 2 ,  h' = w x (k + epsilon h) ,  tau = w.l_Q ,  tau' = Gamma n_Q.h'
///
/// w stands for the Earth's rate over epsilon, k for the vertical and for body axis 3. Either way tau is 2 <Q' + mu Q k / 2, w Q>.
/// A point's series of h ends where its terms are far below round-off; the loops over it end with the last point's, and add
/// zeros for the others.
#pragma once

#include "drift/lanes/drift_kernels.hpp"
#include "integrate/lanes/kernel.ipp"

namespace earthtop::lanes {
namespace {

enum class Axes { laboratory, inertial };

/// The four components of a quaternion.
struct Four {
  Pack w, x, y, z;
};
EARTHTOP_LANE_INLINE Four four_at(const Pack* p) { return {p[0], p[1], p[2], p[3]}; }
/// The product of a vector and a quaternion.
EARTHTOP_LANE_INLINE Four times(const Vec& v, const Four& q) {
  return {-(v.x * q.x + v.y * q.y + v.z * q.z), q.w * v.x + (v.y * q.z - v.z * q.y), q.w * v.y + (v.z * q.x - v.x * q.z),
          q.w * v.z + (v.x * q.y - v.y * q.x)};
}

EARTHTOP_LANE_INLINE Four sum(const Four& a, const Four& b) { return {a.w + b.w, a.x + b.x, a.y + b.y, a.z + b.z}; }
EARTHTOP_LANE_INLINE Four scaled(Pack a, const Four& q) { return {a * q.w, a * q.x, a * q.y, a * q.z}; }
EARTHTOP_LANE_INLINE Four times_k(const Four& q) { return {-q.z, q.y, -q.x, q.w}; }
EARTHTOP_LANE_INLINE Vec opposite(const Vec& v) { return {-v.x, -v.y, -v.z}; }

template <Axes kAxes>
class DriftSeries {
 public:
  static constexpr bool kInertial = kAxes == Axes::inertial;
  static constexpr int kVariables = kInertial ? kInertialDriftVariables : kLaboratoryDriftVariables;
  static constexpr int kCoordinates = 8;
  static constexpr int kGroupCount = 2;
  static constexpr const Group* kGroups = kDriftGroups;

 private:
  static constexpr int kQ = 0, kDelta = 4, kH = 8;
  // Further series: Q; beta + beta_Q; the factors f = Gamma z of q, phi, and f + epsilon phi, with which phi Q + f delta is
  // phi q + (f + epsilon phi) delta. In laboratory axes: wx Q2 - wy Q1 and wx Q1 + wy Q2. In inertial axes: n_Q; and h'.
  static constexpr int kRotating = kInertial ? kH + 3 : kH, kBetas = kRotating + 4, kF = kBetas + 2, kPhi = kF + 1;
  static constexpr int kWhole = kPhi + 1, kAcross = kWhole + 1, kN = kWhole + 1, kHRate = kN + 3;

 public:
  static constexpr int kStored = kInertial ? kHRate + 3 : kAcross + 2;
  using C = Coefficients<kStored>;

  EARTHTOP_LANE_INLINE DriftSeries(const Row* constants, int chunk)
      : gravity_(load(constants[DriftConstants::gravity], chunk)),
        c_(load(constants[DriftConstants::c], chunk)),
        c_rest_(load(constants[DriftConstants::c_rest], chunk)),
        j_(load(constants[DriftConstants::j], chunk)),
        epsilon_(load(constants[DriftConstants::epsilon], chunk)),
        b_(load(constants[DriftConstants::b], chunk)),
        mu_(load(constants[DriftConstants::mu], chunk)),
        w_{load(constants[DriftConstants::W_scaled], chunk), load(constants[DriftConstants::W_scaled + 1], chunk),
           load(constants[DriftConstants::W_scaled + 2], chunk)} {
    if constexpr (kInertial) {
      last_term_ = load(constants[DriftConstants::last_term], chunk);
      for (int i = 0; i < kWidth; ++i)
        if (last_term_[i] > static_cast<double>(terms_)) terms_ = static_cast<int>(last_term_[i]);
    }
  }

  EARTHTOP_LANE_INLINE void start(const C& c) {
    put_rotating(c, 0), put_rotating(c, 1);
    const Four Q = four_at(c.at(0) + kRotating), Q1 = four_at(c.at(1) + kRotating), wQ = times(w_, Q), Qk = times_k(Q);
    const Pack of_rate = Q1.w * wQ.w + Q1.x * wQ.x + Q1.y * wQ.y + Q1.z * wQ.z;
    tau_ = spread(2.0) * of_rate + mu_ * (Qk.w * wQ.w + Qk.x * wQ.x + Qk.y * wQ.y + Qk.z * wQ.z);
  }
  EARTHTOP_LANE_INLINE void extend(const C& c, int k) {
    const Heights heights = find_heights(c, k);
    Pack z = spread(-2.0) * heights.z, zeta = spread(-2.0) * heights.zeta, tau_rate;
    if constexpr (kInertial) {
      const Vec n{spread(2.0) * heights.n_x, spread(2.0) * heights.n_y, z + epsilon_ * zeta + spread(k == 0 ? 1.0 : 0.0)};
      c.put(k, kN, n);
      extend_vertical(c, k);
      const Products of_h = vertical_products(c, k);
      zeta += of_h.along;
      tau_rate = gravity_ * of_h.along_rate;
    } else {
      tau_rate = spread(-2.0) * gravity_ * heights.across;
    }
    Pack phi = gravity_ * zeta - spread(0.5) * tau_;
    if (k == 0) z += spread(1.0), phi -= j_;
    const Pack f = gravity_ * z;
    c.put(k, kF, f), c.put(k, kPhi, phi), c.put(k, kWhole, f + epsilon_ * phi);
    tau_ = tau_rate * spread(1.0 / (k + 1));

    const Forces forces = find_forces(c, k);
    const Pack half = spread(0.5) * gravity_, factor = spread(1.0 / ((k + 1.0) * (k + 2.0))), order = spread(k + 1.0);
    put(c, k + 2, kQ, factor, sum(forces.of_q, linear(c, k, kQ, half)));
    const Four of_delta = sum(forces.of_delta, linear(c, k, kDelta, half));
    Four of_earth;
    if constexpr (kInertial) {
      of_earth = scaled(half, times_k(vertical_turned(c, k)));
    } else {
      const Four rate = scaled(order, four_at(c.at(k + 1) + kRotating));
      of_earth = times(opposite(w_), sum(rate, scaled(spread(0.5) * mu_, times_k(four_at(c.at(k) + kRotating)))));
    }
    put(c, k + 2, kDelta, factor, sum(of_delta, of_earth));
    put_rotating(c, k + 2);
  }

  /// The axis of the reference turns, and so does the deviation of the rotating body from it, seen from the reference. Their
  /// second coefficients are known only roughly: the axis goes round with the nutation.
  EARTHTOP_LANE_INLINE void turns(const C& c, Pack& first, Pack& second) const {
    const Four q = four_at(c.at(0) + kQ), d = four_at(c.at(0) + kDelta);
    const Four q1 = four_at(c.at(1) + kQ), d1 = four_at(c.at(1) + kDelta);
    const Pack whole = spread(4.0) * (q1.w * q1.w + q1.x * q1.x + q1.y * q1.y + q1.z * q1.z), along = b_ - mu_;
    const Pack across = larger(whole - along * along, Pack{});
    // The derivative of q^* delta, whose components are those of the deviation over epsilon.
    const Pack w = (q1.w * d.w + q1.x * d.x + q1.y * d.y + q1.z * d.z) + (q.w * d1.w + q.x * d1.x + q.y * d1.y + q.z * d1.z);
    const Pack x =
        (q1.w * d.x - q1.x * d.w - (q1.y * d.z - q1.z * d.y)) + (q.w * d1.x - q.x * d1.w - (q.y * d1.z - q.z * d1.y));
    const Pack y =
        (q1.w * d.y - q1.y * d.w - (q1.z * d.x - q1.x * d.z)) + (q.w * d1.y - q.y * d1.w - (q.z * d1.x - q.x * d1.z));
    const Pack z =
        (q1.w * d.z - q1.z * d.w - (q1.x * d.y - q1.y * d.x)) + (q.w * d1.z - q.z * d1.w - (q.x * d1.y - q.y * d1.x));
    const Pack apart = epsilon_ * epsilon_ * (w * w + x * x + y * y + z * z);
    first = larger(across, apart);
    second = spread(0.25) * ((b_ * b_ + across) * first + gravity_ * gravity_);
  }

 private:
  EARTHTOP_LANE_INLINE static void put(const C& c, int k, int at, Pack factor, const Four& q) {
    Pack* p = c.at(k) + at;
    p[0] = factor * q.w, p[1] = factor * q.x, p[2] = factor * q.y, p[3] = factor * q.z;
  }
  /// Gamma k q k / 2 - c q - mu q' k of order k.
  EARTHTOP_LANE_INLINE Four linear(const C& c, int k, int at, Pack half) const {
    const Four q = four_at(c.at(k) + at), next = four_at(c.at(k + 1) + at);
    const Pack turn = mu_ * spread(k + 1.0);
    return {turn * next.z - half * q.w - c_rest_ * q.w - c_ * q.w, half * q.x - turn * next.y - c_rest_ * q.x - c_ * q.x,
            half * q.y + turn * next.x - c_rest_ * q.y - c_ * q.y, -turn * next.w - half * q.z - c_rest_ * q.z - c_ * q.z};
  }
  /// The series that follow from the coefficients of order k of q and delta alone.
  EARTHTOP_LANE_INLINE void put_rotating(const C& c, int k) const {
    const Four q = four_at(c.at(k) + kQ), d = four_at(c.at(k) + kDelta);
    const Four Q{q.w + epsilon_ * d.w, q.x + epsilon_ * d.x, q.y + epsilon_ * d.y, q.z + epsilon_ * d.z};
    Pack* p = c.at(k) + kRotating;
    p[0] = Q.w, p[1] = Q.x, p[2] = Q.y, p[3] = Q.z;
    c.put(k, kBetas, q.x + Q.x), c.put(k, kBetas + 1, q.y + Q.y);
    if constexpr (!kInertial) c.put(k, kAcross, w_.x * Q.y - w_.y * Q.x), c.put(k, kAcross + 1, w_.x * Q.x + w_.y * Q.y);
  }

  /// Products that give the heights of both axes, and what else of the axes is needed; without their factors of 2.
  struct Heights {
    Pack z, zeta;
    Pack across;    ///< laboratory axes: the part of tau'
    Pack n_x, n_y;  ///< inertial axes: of n_Q
  };
  EARTHTOP_LANE_INLINE static Heights find_heights(const C& c, int k) {
    Pack zeta1{}, zeta2{}, a{}, b{}, d{}, e{};
    const Pack *up = c.at(0), *down = c.at(k);
    for (int j = 0; j <= k; ++j, up += kStored, down -= kStored) {
      zeta1 += up[kDelta + 1] * down[kBetas], zeta2 += up[kDelta + 2] * down[kBetas + 1];
      const Pack w = up[kRotating], z = up[kRotating + 3];
      if constexpr (kInertial) {
        a += z * down[kRotating + 1], b += w * down[kRotating + 2];
        d += z * down[kRotating + 2], e += w * down[kRotating + 1];
      } else {
        a += z * down[kAcross], b += w * down[kAcross + 1];
      }
    }
    const Pack z = square(c, k), zeta = zeta1 + zeta2;
    if constexpr (kInertial) return {z, zeta, Pack{}, a + b, d - e};
    return {z, zeta, a - b, Pack{}, Pack{}};
  }
  /// |beta|^2, whose products come in pairs.
  EARTHTOP_LANE_INLINE static Pack square(const C& c, int k) {
    Pack sum1{}, sum2{};
    const Pack *up = c.at(0) + kQ, *down = c.at(k) + kQ;
    for (int j = 0; 2 * j < k; ++j, up += kStored, down -= kStored) sum1 += up[1] * down[1], sum2 += up[2] * down[2];
    const Pack twice = spread(2.0) * (sum1 + sum2);
    return k % 2 == 0 ? twice + (up[1] * up[1] + up[2] * up[2]) : twice;
  }

  struct Forces {
    Four of_q, of_delta;
  };
  /// f q, and phi q + (f + epsilon phi) delta.
  EARTHTOP_LANE_INLINE static Forces find_forces(const C& c, int k) {
    Forces s{};
    Four phi_q{};
    const Pack *up = c.at(0), *down = c.at(k);
    for (int j = 0; j <= k; ++j, up += kStored, down -= kStored) {
      const Pack f = up[kF], phi = up[kPhi], whole = up[kWhole];
      const Four q = four_at(down + kQ);
      s.of_q.w += f * q.w, s.of_q.x += f * q.x, s.of_q.y += f * q.y, s.of_q.z += f * q.z;
      phi_q.w += phi * q.w, phi_q.x += phi * q.x, phi_q.y += phi * q.y, phi_q.z += phi * q.z;
      s.of_delta.w += whole * down[kDelta], s.of_delta.x += whole * down[kDelta + 1];
      s.of_delta.y += whole * down[kDelta + 2], s.of_delta.z += whole * down[kDelta + 3];
    }
    s.of_delta = sum(s.of_delta, phi_q);
    return s;
  }

  /// h' of order k and h of order k + 1; zero beyond the point's last term.
  EARTHTOP_LANE_INLINE void extend_vertical(const C& c, int k) const {
    Vec rate = epsilon_ * lanes::cross(w_, c.vector(k, kH));
    if (k == 0) rate = rate + Vec{w_.y, -w_.x, Pack{}};
    const Pack counts = spread(static_cast<double>(k)) < last_term_ ? spread(1.0) : Pack{};
    c.put(k, kHRate, counts * rate);
    c.put(k + 1, kH, (counts * spread(1.0 / (k + 1))) * rate);
  }
  struct Products {
    Pack along, along_rate;  ///< n_Q.h and n_Q.h'
  };
  EARTHTOP_LANE_INLINE Products vertical_products(const C& c, int k) const {
    Pack along{}, along_rate{};
    for (int j = 0; j <= k && j <= terms_; ++j) {
      const Vec n = c.vector(k - j, kN);
      along += dot(c.vector(j, kH), n), along_rate += dot(c.vector(j, kHRate), n);
    }
    return {along, along_rate};
  }
  /// h Q.
  EARTHTOP_LANE_INLINE Four vertical_turned(const C& c, int k) const {
    Four s{};
    for (int j = 0; j <= k && j <= terms_; ++j) s = sum(s, times(c.vector(j, kH), four_at(c.at(k - j) + kRotating)));
    return s;
  }

  Pack gravity_, c_, c_rest_, j_, epsilon_, b_, mu_;
  Vec w_;
  Pack last_term_{}, tau_{};
  int terms_ = 0;
};

}  // namespace
}  // namespace earthtop::lanes

#define EARTHTOP_DRIFT_KERNELS(set)                                                                                        \
  namespace earthtop::lanes {                                                                                              \
  const Kernel kLaboratoryDrift_##set{step_block<DriftSeries<Axes::laboratory>>,                                           \
                                      evaluate_block<DriftSeries<Axes::laboratory>>};                                      \
  const Kernel kInertialDrift_##set{step_block<DriftSeries<Axes::inertial>>, evaluate_block<DriftSeries<Axes::inertial>>}; \
  }
