// SPDX-License-Identifier: GPL-3.0-or-later
/// The variational equations of a wheel in a gimbal (compass_equations.hpp): only disturbances that the gimbal allows exist.
#pragma once

#include <array>

#include "drift/derivatives/spinless_variations.hpp"
#include "drift/pivot/compass_equations.hpp"

namespace earthtop {

/// A state is the motion: [0] cos and [1] sin of half the angle since the release, [2] p, [3] w3 minus that at release; and for
/// each disturbance the changes of the angle, of p, of w3, and of the spin phase.
struct CompassVariationsShape {
  static constexpr std::size_t kMotionSize = 4, kSize = kMotionSize + 4 * kDisturbances;
  static constexpr auto groups() {
    return std::array<ComponentGroup, 6>{{{0, 2, 1.0},
                                          {2, 1, 1e-3},
                                          {3, 1, 1e-3},
                                          {kMotionSize, 4, 1e-3},
                                          {kMotionSize + 4, 4, 1e-3},
                                          {kMotionSize + 8, 4, 1e-3}}};
  }
};

/// @tparam T  a number, or a scalar that records operations
template <class T>
struct CompassVariationsEquations {
  using State = std::array<T, CompassVariationsShape::kSize>;

  Model<T> model;
  ReducedTop<T> top;
  T east, north;  ///< the axis at release
  T w3;           ///< inertial spin at release
  Vec3<T> W_L;    ///< the rate of the laboratory: the Earth's, or zero
  bool has_Earth;
  EARTHTOP_MEMBERS(model, top, east, north, w3, W_L, has_Earth)

  void operator()(const State& x, State& dxdt, T t) const {
    const auto [e, n] = turned_axis(x[0], x[1], east, north);
    const PivotField<T> field = pivot_field<SceneKind::full>(model, t);
    const Vec3<T>& field_L = has_Earth ? field.rotating_L : field.reference_L;
    const Vec3<Paired<T>> W = paired_vector(W_L), f = paired_vector(field_L);
    const T turning = x[2] / T(2);
    dxdt[0] = -turning * x[1];
    dxdt[1] = turning * x[0];
    for (std::size_t i = CompassVariationsShape::kMotionSize; i < x.size(); i += 4) {
      const T &angle = x[i], &p = x[i + 1], &spin = x[i + 2], w = w3 + x[3];
      const CompassMotion<Paired<T>> both{Paired<T>(e, e, -n * angle), Paired<T>(n, n, e * angle), Paired<T>(x[2], x[2], p),
                                          Paired<T>(w, w, spin)};
      const CompassRates<Paired<T>> rates = compass_rates<T, Paired<T>>(model, top, both, W, f);
      dxdt[2] = rates.p.ref;
      dxdt[3] = rates.w3.ref;
      dxdt[i] = p;
      dxdt[i + 1] = rates.p.diff;
      dxdt[i + 2] = rates.w3.diff;
      dxdt[i + 3] = spin - (W_L[1] * e - W_L[0] * n) * angle;
    }
  }
};

/// The system of a motion and its disturbances, with the interface of GeneralVariations.
template <bool kEarth>
class CompassVariations : public SpinlessVariations<CompassVariationsEquations, CompassVariationsShape, kEarth> {
  using Base = SpinlessVariations<CompassVariationsEquations, CompassVariationsShape, kEarth>;
  using Base::at, Base::equations_;

 public:
  using State = typename Base::State;
  using Base::Base;

  State initial_state(const Motion<double>& release) {
    release_q_LB_ = release.q;
    const Mat3<double> R_LB = rotation_matrix(release.q);
    const double level = real::hypot(R_LB(0, 2), R_LB(1, 2));
    equations_.east = R_LB(0, 2) / level, equations_.north = R_LB(1, 2) / level;
    equations_.w3 = release.m[2];
    State x{};
    x[0] = 1;
    x[2] = times(R_LB, release.m)[2] - equations_.W_L[2];
    return x;
  }
  /// The motion, apart from a turn about its axis.
  Motion<double> motion(const State& x) const {
    const Quaternion<double> q_LB = Quaternion<double>{x[0], Vec3<double>(0, 0, x[1])} * release_q_LB_;
    const Mat3<double> R_LB = rotation_matrix(q_LB);
    Vec3<double> w_L = equations_.W_L + Vec3<double>(0, 0, x[2]);
    w_L += (equations_.w3 + x[3] - R_LB.col(2).dot(w_L)) * R_LB.col(2);
    return {q_LB, transposed_times(R_LB, w_L)};
  }
  /// In body axes, apart from a turn about axis 3.
  Vec3<double> theta(const State& x, std::size_t d) const {
    const std::size_t i = at(d);
    return transposed_times(attitude(x), Vec3<double>(0, 0, x[i])) + Vec3<double>(0, 0, x[i + 3]);
  }
  /// The change of w = W + p z + s n with the body: W and z are seen turned back by theta, and n stays.
  Vec3<double> dw(const State& x, std::size_t d) const {
    const std::size_t i = at(d);
    const Mat3<double> R_LB = attitude(x);
    const Vec3<double> turning_B = transposed_times(R_LB, Vec3<double>(equations_.W_L + Vec3<double>(0, 0, x[2])));
    Vec3<double> change = turning_B.cross(theta(x, d)) + transposed_times(R_LB, Vec3<double>(0, 0, x[i + 1]));
    change[2] = x[i + 2];
    return change;
  }
  /// Puts in what the gimbal allows of a disturbance, given in body axes.
  void put_disturbance(const Vec3<double>& theta_B, const Vec3<double>& dw_B, State& x, std::size_t d) const {
    const std::size_t i = at(d);
    const Mat3<double> R_LB = attitude(x);
    const Vec3<double> up_B = R_LB.row(2).transpose();
    const double angle = theta_B.dot(up_B);
    x[i] = angle;
    x[i + 3] = theta_B[2];
    const Vec3<double> allowed(up_B * angle + Vec3<double>(0, 0, theta_B[2]));
    const Vec3<double> W_B = transposed_times(R_LB, equations_.W_L);
    x[i + 1] = Vec3<double>(dw_B - W_B.cross(allowed)).dot(up_B);
    x[i + 2] = dw_B[2];
  }

 private:
  Mat3<double> attitude(const State& x) const {
    return rotation_matrix(Quaternion<double>{x[0], Vec3<double>(0, 0, x[1])} * release_q_LB_);
  }

  Quaternion<double> release_q_LB_;
};

}  // namespace earthtop
