// SPDX-License-Identifier: GPL-3.0-or-later
/// The series of a symmetric top's reference and deviation (reduced_drift_system.hpp), for points side by side. The equations
/// are written with as few products as possible:
///
///   dn/dt = s ,  du/dt = (m l / I1) n x g - b s ,  s = u x n ,  da/dt = (u - (u.n) n) x a
///   dV/dt = (u + c n) x V + (1 - r) k s + (m l / I1) n x F ,  c = b + (r - 1) epsilon k ,  F = (D^T g_rot - g) / epsilon
///
/// In laboratory axes D turns at v = V + k n on one side and at W on the other, so that W need not be turned by it:
///   dw/dt = -epsilon^2 y.(v - W) / 2 ,  dy/dt = (w (v - W) + epsilon y x (v + W)) / 2
///   F = (2 / |e|^2) (-w c + epsilon y x c) ,  c = y x g
///
/// In inertial axes D turns at v alone, and gravity g_rot = g + epsilon h turns with the Earth:
///   dh/dt = W x (g + epsilon h) ,  F = h + (2 / |e|^2) (-w c + epsilon y x c) ,  c = y x (g + epsilon h)
///
/// W stands for the Earth's rate over epsilon.
#pragma once

#include "drift/lanes/drift_kernels.hpp"
#include "integrate/lanes/kernel.ipp"

namespace earthtop::lanes {
namespace {

enum class Axes { laboratory, inertial };

template <Axes kAxes>
class DriftSeries {
 public:
  static constexpr bool kInertial = kAxes == Axes::inertial;
  static constexpr int kVariables = kInertial ? kInertialDriftVariables : kLaboratoryDriftVariables;
  static constexpr int kGroupCount = 5;
  static constexpr const Group* kGroups = kDriftGroups;

 private:
  static constexpr int kN = 0, kU = 3, kA = 6, kE = 9, kY = 10, kV = 13, kH = 16;
  // Further series, in this order: u without its part along n; u + c n; the rate d at which D turns, v - W or in inertial axes
  // v; F; and in inertial axes c = y x (g + epsilon h).
  static constexpr int kAcross = kVariables, kCarrier = kAcross + 3, kTurn = kCarrier + 3, kF = kTurn + 3, kC = kF + 3;

 public:
  static constexpr int kStored = kInertial ? kC + 3 : kF + 3;
  using C = Coefficients<kStored>;

  EARTHTOP_LANE_INLINE DriftSeries(const Row* constants, int chunk)
      : b_(load(constants[DriftConstants::b], chunk)),
        b_rest_(load(constants[DriftConstants::b_rest], chunk)),
        k_(load(constants[DriftConstants::k], chunk)),
        of_axis_rate_(load(constants[DriftConstants::axis_rate_factor], chunk)),
        of_cross_(load(constants[DriftConstants::cross_factor], chunk)),
        moment_ratio_(load(constants[DriftConstants::moment_ratio], chunk)),
        gravity_(load(constants[DriftConstants::gravity], chunk)),
        epsilon_(load(constants[DriftConstants::epsilon], chunk)),
        W_{load(constants[DriftConstants::W_scaled], chunk), load(constants[DriftConstants::W_scaled + 1], chunk),
           load(constants[DriftConstants::W_scaled + 2], chunk)} {}

  /// Notes the norms of n and e, and u.n, which are constant along the exact motion: their round-off must neither scale a
  /// torque nor spin the frame.
  EARTHTOP_LANE_INLINE void start(const C& c) {
    const Vec n = c.vector(0, kN), y = c.vector(0, kY);
    const Pack w = c.get(0, kE);
    moment_ = moment_ratio_ * (spread(3.0) - dot(n, n)) / spread(2.0);
    along_ = dot(c.vector(0, kU), n);
    turn_scale_ = spread(2.0) / (w * w + epsilon_ * epsilon_ * dot(y, y));
  }

  EARTHTOP_LANE_INLINE void extend(const C& c, int k) const {
    const Vec n = c.vector(k, kN), u = c.vector(k, kU);
    Vec turn = c.vector(k, kV) + k_ * n;
    if constexpr (!kInertial)
      if (k == 0) turn = turn - W_;
    c.put(k, kAcross, u - along_ * n);
    c.put(k, kCarrier, u + of_cross_ * n);
    c.put(k, kTurn, turn);

    const Pack factor = spread(1.0 / (k + 1)), half = spread(0.5) * factor;
    const TwoVectors frame = reference_turn(c, k);
    const Vec& s = frame.first;
    c.put(k + 1, kN, factor * s);
    const Pack torque = moment_ * gravity_;  // times n x Up: gravity is along the vertical
    c.put(k + 1, kU,
          factor * Vec{torque * n.y - b_ * s.x - b_rest_ * s.x, -torque * n.x - b_ * s.y - b_rest_ * s.y,
                       -b_ * s.z - b_rest_ * s.z});
    c.put(k + 1, kA, factor * frame.second);

    const Deviation deviation = turned_deviation(c, k);
    c.put(k + 1, kE, -epsilon_ * epsilon_ * (half * deviation.dot));
    Vec of_y = deviation.cross;
    if constexpr (!kInertial) of_y = of_y + spread(2.0) * cross(c.vector(k, kY), W_);
    c.put(k + 1, kY, half * (deviation.scaled + epsilon_ * of_y));

    c.put(k, kF, gravity_difference(c, k, deviation));
    const TwoVectors rate = carried_rate(c, k);
    c.put(k + 1, kV, factor * (rate.first + of_axis_rate_ * s + moment_ * rate.second));
    if constexpr (kInertial) {
      Vec h = epsilon_ * cross(W_, c.vector(k, kH));
      if (k == 0) h = h + gravity_ * Vec{W_.y, -W_.x, Pack{}};
      c.put(k + 1, kH, factor * h);
    }
  }

 private:
  // Products with a common factor share a loop, and load it once; the sums and factors of each loop fit into the registers.
  struct TwoVectors {
    Vec first, second;
  };
  /// u x n and (u - (u.n) n) x a.
  EARTHTOP_LANE_INLINE static TwoVectors reference_turn(const C& c, int k) {
    Vec plus{}, minus{}, frame_plus{}, frame_minus{};
    const Pack *of_u = c.at(0) + kAcross, *of_n = c.at(k) + kN, *of_a = c.at(k) + kA;
    for (int j = 0; j <= k; ++j, of_u += kStored, of_n -= kStored, of_a -= kStored) {
      const Vec u{of_u[0], of_u[1], of_u[2]};
      add_cross(u, of_n, plus, minus);
      add_cross(u, of_a, frame_plus, frame_minus);
    }
    return {plus - minus, frame_plus - frame_minus};
  }
  /// (u + c n) x V and n x F.
  EARTHTOP_LANE_INLINE static TwoVectors carried_rate(const C& c, int k) {
    Vec plus{}, minus{}, torque_plus{}, torque_minus{};
    const Pack *of_u = c.at(0) + kCarrier, *of_n = c.at(0) + kN, *of_V = c.at(k) + kV, *of_F = c.at(k) + kF;
    for (int j = 0; j <= k; ++j, of_u += kStored, of_n += kStored, of_V -= kStored, of_F -= kStored) {
      add_cross(Vec{of_u[0], of_u[1], of_u[2]}, of_V, plus, minus);
      add_cross(Vec{of_n[0], of_n[1], of_n[2]}, of_F, torque_plus, torque_minus);
    }
    return {plus - minus, torque_plus - torque_minus};
  }
  /// Products of the deviation e = (w, y) with the rate t at which D turns, and with gravity.
  struct Deviation {
    Vec scaled, cross;  ///< w t, y x t
    Pack dot;           ///< y.t
    Vec gravity;        ///< inertial: y x h; laboratory: -w c + epsilon y x c for a gravity of 1
  };
  EARTHTOP_LANE_INLINE Deviation turned_deviation(const C& c, int k) const {
    Vec scaled{}, plus{}, minus{}, along{}, gravity_plus{}, gravity_minus{};
    const Pack *of_e = c.at(0) + kE, *t = c.at(k) + kTurn;
    const Pack* with = c.at(k) + (kInertial ? kH : kE);
    for (int j = 0; j <= k; ++j, of_e += kStored, t -= kStored, with -= kStored) {
      const Pack w = of_e[0];
      const Vec y{of_e[1], of_e[2], of_e[3]};
      scaled.x += w * t[0], scaled.y += w * t[1], scaled.z += w * t[2];
      along.x += y.x * t[0], along.y += y.y * t[1], along.z += y.z * t[2];
      add_cross(y, t, plus, minus);
      if constexpr (kInertial) {
        add_cross(y, with, gravity_plus, gravity_minus);
      } else {  // c = (y_2, -y_1, 0)
        gravity_plus.x += y.x * with[3], gravity_minus.x += w * with[2];
        gravity_plus.y += y.y * with[3], gravity_minus.y += w * with[1];
        gravity_plus.z += y.x * with[1], gravity_minus.z += y.y * with[2];
      }
    }
    Vec gravity = gravity_plus - gravity_minus;
    if constexpr (!kInertial)
      gravity = {epsilon_ * gravity_plus.x - gravity_minus.x, epsilon_ * gravity_plus.y + gravity_minus.y,
                 -epsilon_ * (gravity_plus.z + gravity_minus.z)};
    return {scaled, plus - minus, along.x + along.y + along.z, gravity};
  }
  /// F, the difference of gravity as seen from the two bodies, divided by epsilon.
  EARTHTOP_LANE_INLINE Vec gravity_difference(const C& c, int k, const Deviation& deviation) const {
    if constexpr (kInertial) {
      const Vec y = c.vector(k, kY), of_h = epsilon_ * deviation.gravity;
      c.put(k, kC, Vec{gravity_ * y.y + of_h.x, of_h.y - gravity_ * y.x, of_h.z});
      Vec scaled{}, plus{}, minus{};
      const Pack *of_e = c.at(0) + kE, *of_c = c.at(k) + kC;
      for (int j = 0; j <= k; ++j, of_e += kStored, of_c -= kStored) {
        const Pack w = of_e[0];
        scaled.x += w * of_c[0], scaled.y += w * of_c[1], scaled.z += w * of_c[2];
        add_cross(Vec{of_e[1], of_e[2], of_e[3]}, of_c, plus, minus);
      }
      return c.vector(k, kH) + turn_scale_ * (epsilon_ * (plus - minus) - scaled);
    } else {
      return turn_scale_ * gravity_ * deviation.gravity;
    }
  }

  Pack b_, b_rest_, k_, of_axis_rate_, of_cross_, moment_ratio_, gravity_, epsilon_;
  Vec W_;
  Pack moment_{}, along_{}, turn_scale_{};
};

}  // namespace
}  // namespace earthtop::lanes

#define EARTHTOP_DRIFT_KERNELS(set)                                                                                        \
  namespace earthtop::lanes {                                                                                              \
  const Kernel kLaboratoryDrift_##set{step_block<DriftSeries<Axes::laboratory>>,                                           \
                                      evaluate_block<DriftSeries<Axes::laboratory>>};                                      \
  const Kernel kInertialDrift_##set{step_block<DriftSeries<Axes::inertial>>, evaluate_block<DriftSeries<Axes::inertial>>}; \
  }
