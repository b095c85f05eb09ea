/// The series of a symmetric top's reference and deviation (reduced_drift_system.hpp), for points side by side, with as few
/// products as the equations leave:
///
///   dn/dt = s ,  du/dt = (m l / I1) n x g - b s ,  s = u x n ,  da/dt = (u - (u.n) n) x a
///   dV/dt = (u + c n) x V + (1 - r) k s + (m l / I1) n x F ,  c = b + (r - 1) epsilon k ,  F = (D^T g_rot - g) / epsilon
///
/// In laboratory axes D turns at v = V + k n on one side and at W on the other, which spares the turn of W:
///   dw/dt = -epsilon^2 y.(v - W) / 2 ,  dy/dt = (w (v - W) + epsilon y x (v + W)) / 2
///   F = (2 / |e|^2) (-w c + epsilon y x c) ,  c = y x g
///
/// In inertial axes it turns at v alone, and g_rot = g + epsilon h turns with the Earth:
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
  // u without its part along n; u + c n; the rate that D is turned at; F; and in inertial axes y x (g + epsilon h).
  static constexpr int kAcross = kVariables, kCarrier = kAcross + 3, kTurn = kCarrier + 3, kF = kTurn + 3, kC = kF + 3;

 public:
  static constexpr int kStored = kInertial ? kC + 3 : kF + 3;
  using C = Coefficients<kStored>;

  EARTHTOP_LANE_INLINE DriftSeries(const Row* constants, int chunk)
      : b_(load(constants[DriftConstants::b], chunk)),
        b_rest_(load(constants[DriftConstants::b_rest], chunk)),
        k_(load(constants[DriftConstants::k], chunk)),
        of_axis_rate_(load(constants[DriftConstants::of_axis_rate], chunk)),
        of_cross_(load(constants[DriftConstants::of_cross], chunk)),
        moment_ratio_(load(constants[DriftConstants::moment_ratio], chunk)),
        gravity_(load(constants[DriftConstants::gravity], chunk)),
        epsilon_(load(constants[DriftConstants::epsilon], chunk)),
        W_{load(constants[DriftConstants::W_scaled], chunk), load(constants[DriftConstants::W_scaled + 1], chunk),
           load(constants[DriftConstants::W_scaled + 2], chunk)} {}

  /// The norms of n and e, and u.n, are constant along the exact motion; their round-off must neither scale a torque nor spin
  /// the frame.
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
    c.put(k, kF, gravity_difference(c, k));

    const Pack factor = spread(1.0 / (k + 1)), half = spread(0.5) * factor;
    const Vec s = c.cross(k, kU, kN);
    c.put(k + 1, kN, factor * s);
    const Pack torque = moment_ * gravity_;  // n x g of a gravity along the vertical
    c.put(k + 1, kU,
          factor * Vec{torque * n.y - b_ * s.x - b_rest_ * s.x, -torque * n.x - b_ * s.y - b_rest_ * s.y,
                       -b_ * s.z - b_rest_ * s.z});
    c.put(k + 1, kA, factor * c.cross(k, kAcross, kA));

    const Turned turned = turned_deviation(c, k);
    c.put(k + 1, kE, -epsilon_ * epsilon_ * (half * turned.dot));
    Vec of_y = turned.cross;
    if constexpr (!kInertial) of_y = of_y + spread(2.0) * cross(c.vector(k, kY), W_);
    c.put(k + 1, kY, half * (turned.scaled + epsilon_ * of_y));

    c.put(k + 1, kV, factor * (c.cross(k, kCarrier, kV) + of_axis_rate_ * s + moment_ * c.cross(k, kN, kF)));
    if constexpr (kInertial) {
      Vec h = epsilon_ * cross(W_, c.vector(k, kH));
      if (k == 0) h = h + gravity_ * Vec{W_.y, -W_.x, Pack{}};
      c.put(k + 1, kH, factor * h);
    }
  }

 private:
  struct Turned {
    Vec scaled, cross;
    Pack dot;
  };
  /// w t, y x t and y.t of the rate t that D is turned at.
  EARTHTOP_LANE_INLINE static Turned turned_deviation(const C& c, int k) {
    Vec scaled{}, plus{}, minus{}, along{};
    const Pack *e = c.at(0) + kE, *t = c.at(k) + kTurn;
    for (int j = 0; j <= k; ++j, e += kStored, t -= kStored) {
      const Pack w = e[0], *y = e + 1;
      scaled.x += w * t[0], scaled.y += w * t[1], scaled.z += w * t[2];
      along.x += y[0] * t[0], along.y += y[1] * t[1], along.z += y[2] * t[2];
      plus.x += y[1] * t[2], minus.x += y[2] * t[1];
      plus.y += y[2] * t[0], minus.y += y[0] * t[2];
      plus.z += y[0] * t[1], minus.z += y[1] * t[0];
    }
    return {scaled, plus - minus, along.x + along.y + along.z};
  }

  /// F.
  EARTHTOP_LANE_INLINE Vec gravity_difference(const C& c, int k) const {
    if constexpr (kInertial) {
      const Vec h = c.vector(k, kH), y = c.vector(k, kY);
      const Vec of_h = epsilon_ * c.cross(k, kY, kH);
      c.put(k, kC, Vec{gravity_ * y.y + of_h.x, of_h.y - gravity_ * y.x, of_h.z});
      Vec scaled{};
      const Pack *e = c.at(0) + kE, *g = c.at(k) + kC;
      for (int j = 0; j <= k; ++j, e += kStored, g -= kStored)
        scaled.x += e[0] * g[0], scaled.y += e[0] * g[1], scaled.z += e[0] * g[2];
      return h + turn_scale_ * (epsilon_ * c.cross(k, kY, kC) - scaled);
    } else {
      // y x g = g (y_2, -y_1, 0)
      Vec scaled{}, twice{};
      Pack yy{};
      const Pack *e = c.at(0) + kE, *f = c.at(k) + kE;
      for (int j = 0; j <= k; ++j, e += kStored, f -= kStored) {
        scaled.x += e[0] * f[2], scaled.y += e[0] * f[1];
        twice.x += e[1] * f[3], twice.y += e[2] * f[3];
        twice.z += e[1] * f[1], yy += e[2] * f[2];
      }
      const Pack scale = turn_scale_ * gravity_;
      return {scale * (epsilon_ * twice.x - scaled.x), scale * (epsilon_ * twice.y + scaled.y),
              -scale * (epsilon_ * (twice.z + yy))};
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
