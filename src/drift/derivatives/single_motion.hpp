// SPDX-License-Identifier: GPL-3.0-or-later
/// The laws of one motion in the laboratory, from which its tangents follow (tangents.hpp): of any body, of a symmetric top without its
/// spin, of a wheel in a gimbal, and of a Cardan suspension. The non-rotating prediction is the motion of a model whose Earth stands still.
///
/// Each law shows the attitude and the rate that belong to a state, for any scalar, so that those of a scalar with derivatives show how a
/// disturbance turns the body; and it takes such a disturbance to a change of the state.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "drift/pivot/compass_equations.hpp"
#include "earthtop/integrate/motion_integration.hpp"
#include "earthtop/model/gimbal_equations.hpp"
#include "integrate/motion_system.hpp"
#include "integrate/state_vectors.hpp"
#include "integrate/taylor/operations.hpp"
#include "model/seen_beside_axis.hpp"

namespace earthtop {

/// Attitude and inertial rate of a body whose spin about an axis of symmetry may be left out: body axes that the body turns in, by the
/// angle `phase` about this axis and by a spin at the rate of the release.
template <class S>
struct Turning {
  Mat3<S> R_LB;
  Vec3<S> w_IB_B;
  S phase;
};

/// Any body: the state is the attitude q (4), the inertial rate in body axes (3) and, of a gyrostat, its rotor's momentum about its axis.
template <SceneKind K>
class BodyMotion {
 public:
  using Shape = GeneralMotionShape<K>;
  using State = std::array<double, Shape::kSize>;
  static int axis() { return 2; }

  explicit BodyMotion(const MotionProblem<double>& problem, const Motion<double>& release)
      : model_(problem.model), release_(release) {}

  State initial_state() const { return state(release_.q, release_.m, model_.rotor.spin); }
  template <class S>
  Turning<S> turning(const std::array<S, Shape::kSize>& x) const {
    return {rotation_matrix(load_quaternion(x, 0)), load_vector(x, 4), S(0)};
  }
  /// @param theta_B, dw_B  turn of the attitude and change of the inertial rate, in body axes
  State change(const State& x, const Vec3<double>& theta_B, const Vec3<double>& dw_B) const {
    const Quaternion<double> dq = load_quaternion(x, 0) * Quaternion<double>{0, Vec3<double>(theta_B / 2)};
    return state(dq, dw_B, 0);
  }
  taylor::Operations<double> record(std::span<const double> x, double t) const { return record_motion(model_, x, t); }

 private:
  /// @param spin  of the rotor relative to the body
  State state(const Quaternion<double>& q, const Vec3<double>& w_B, [[maybe_unused]] double spin) const {
    State x{q.w, q.v[0], q.v[1], q.v[2], w_B[0], w_B[1], w_B[2]};
    if constexpr (K == SceneKind::gyrostat) x[7] = model_.rotor.axial * (model_.rotor.axis_B.dot(w_B) + spin);
    return x;
  }

  const Model<double>& model_;
  Motion<double> release_;
};

using AnyBodyMotion = BodyMotion<SceneKind::full>;
using GyrostatMotion = BodyMotion<SceneKind::gyrostat>;

/// A symmetric top without its spin, in laboratory axes, which turn at W. With the torques tau on the axis n and along it:
///
///   dn/dt = s - W x n ,  du/dt = tau_across / I1 - b s - W x u ,  da/dt = (u - W) x a ,  dw3/dt = tau_n / I3
///
/// where s = u x n and b = (I3/I1) w3. The state: [0] n   [3] u, the rate across the axis   [6] a, a vector of the frame without
/// spin   [9] w3 minus that at release   [10] the angle by which the body has turned beside a spin at the rate of the release.
template <class T>
struct SpinlessMotionEquations {
  static constexpr std::size_t kSize = 11;

  Model<T> model;
  ReducedTop<T> top;
  T w3;  ///< inertial spin at release
  EARTHTOP_MEMBERS(model, top, w3)

  void operator()(const std::array<T, kSize>& x, std::array<T, kSize>& dxdt, T t) const {
    const Vec3<T> n = load_vector(x, 0), u = load_vector(x, 3), a = load_vector(x, 6), s = u.cross(n);
    const Vec3<T>& W = model.W_IL_L;
    SeenBesideAxis<T> seen;
    seen.n = n, seen.u = u, seen.w3 = w3 + x[9];
    seen.field = pivot_field<SceneKind::full>(model, t).rotating_L;
    see_rotating_motion(top, model, t, seen);
    const AxisTorques<T> torques = axis_torques<T, T>(top, model, moment_factor(top, n), seen);
    using real::conserved;
    store_vector(Vec3<T>(s - W.cross(n)), dxdt, 0);
    store_vector(Vec3<T>(torques.across - (top.spin_ratio * seen.w3) * s - W.cross(u)), dxdt, 3);
    store_vector(Vec3<T>(Vec3<T>(u - conserved(T(u.dot(n))) * n - W).cross(a)), dxdt, 6);
    dxdt[9] = torques.along;
    dxdt[10] = x[9];
  }
};

/// A wheel in a gimbal (compass_equations.hpp). The state: [0] cos and [1] sin of half the angle about Up since the release   [2] p
/// [3] w3 minus that at release   [4] the angle by which the wheel has turned beside a spin at the rate of the release.
template <class T>
struct WheelMotionEquations {
  static constexpr std::size_t kSize = 5;

  Model<T> model;
  ReducedTop<T> top;
  T east, north;  ///< the axis at release
  T w3;           ///< inertial spin at release
  EARTHTOP_MEMBERS(model, top, east, north, w3)

  void operator()(const std::array<T, kSize>& x, std::array<T, kSize>& dxdt, T t) const {
    const auto [e, n] = turned_axis(x[0], x[1], east, north);
    const Vec3<T>& W = model.W_IL_L;
    const CompassMotion<T> motion{e, n, x[2], w3 + x[3]};
    const CompassRates<T> rates =
        compass_rates<T, T>(model, top, motion, W, pivot_field<SceneKind::full>(model, t).rotating_L, t);
    dxdt[0] = -(x[2] / T(2)) * x[1];
    dxdt[1] = (x[2] / T(2)) * x[0];
    dxdt[2] = rates.p;
    dxdt[3] = rates.w3;
    dxdt[4] = x[3] - (W[0] * (e - east) + W[1] * (n - north));
  }
};

/// A Cardan suspension, as an inertial observer sees it (gimbal_equations.hpp). The state: [0] alpha   [1] beta   [2] p_a   [3] p_b   [4] h.
template <class T>
struct GimbalMotionEquations {
  static constexpr std::size_t kSize = 5;

  Model<T> model;
  EARTHTOP_MEMBERS(model)

  void operator()(const std::array<T, kSize>& x, std::array<T, kSize>& dxdt, T t) const {
    const GimbalPose<T, T> pose{model.gimbals, real::sin_cos(x[0]), real::sin_cos(x[1])};
    const GimbalSurroundings<T> around = of_rotating(gimbal_surroundings<false>(model, t));
    const CarriedParts<T> parts = carried_parts(model, t);
    const GimbalMotion<T> motion = gimbal_motion(model, parts, pose, GimbalMomenta<T>{x[2], x[3], x[4]}, around.turning, t);
    const GimbalMomenta<T> rate = momentum_rates<false>(model, parts, pose, x[0], x[1], motion, around);
    dxdt[0] = motion.outer_rate, dxdt[1] = motion.inner_rate;
    dxdt[2] = rate.outer, dxdt[3] = rate.inner, dxdt[4] = rate.rotor;
  }
};

/// Records these equations as they are at a state and a time. The recording scalar is compiled apart.
template <template <class> class Equations>
taylor::Operations<double> record_single_motion(const Equations<double>& equations, std::span<const double> x, double t);

class SpinlessMotion {
 public:
  struct Shape {
    static constexpr std::size_t kSize = SpinlessMotionEquations<double>::kSize;
    static constexpr auto groups() {
      return std::array<ComponentGroup, 5>{{{0, 3, 1.0}, {3, 3, 1e-3}, {6, 3, 1.0}, {9, 1, 1e-3}, {10, 1, 2.0}}};
    }
  };
  using State = std::array<double, Shape::kSize>;

  SpinlessMotion(const MotionProblem<double>& problem, const Motion<double>& release)
      : release_R_LB_(rotation_matrix(release.q)) {
    equations_.model = problem.model;
    equations_.top = reduced_top(problem.model);
    equations_.w3 = release.m[axis()];
    u_ = release.m;
    u_[axis()] = 0;
  }
  int axis() const { return equations_.top.axis; }
  State initial_state() const {
    State x{};
    store_vector(release_R_LB_.col(axis()), x, 0);
    store_vector(times(release_R_LB_, u_), x, 3);
    store_vector(release_R_LB_.col((axis() + 1) % 3), x, 6);
    return x;
  }
  template <class S>
  Turning<S> turning(const std::array<S, Shape::kSize>& x) const {
    const Vec3<S> n = load_vector(x, 0), a = load_vector(x, 6);
    Mat3<S> R_LB;
    R_LB.col(axis()) = n;
    R_LB.col((axis() + 1) % 3) = a;
    R_LB.col((axis() + 2) % 3) = n.cross(a);
    Vec3<S> w_IB_B = transposed_times(R_LB, load_vector(x, 3));
    w_IB_B[axis()] += S(equations_.w3) + x[9];
    return {R_LB, w_IB_B, x[10]};
  }
  State change(const State& x, const Vec3<double>& theta_B, const Vec3<double>& dw_B) const {
    const Turning<double> now = turning(x);
    const Vec3<double> n = load_vector(x, 0), theta_L = times(now.R_LB, theta_B), dn = theta_L.cross(n);
    const Vec3<double> dw_L = times(now.R_LB, dw_B) + theta_L.cross(times(now.R_LB, now.w_IB_B));
    State dx{};
    store_vector(dn, dx, 0);
    store_vector(Vec3<double>(dw_L - dw_B[axis()] * n - now.w_IB_B[axis()] * dn), dx, 3);
    store_vector(theta_L.cross(load_vector(x, 6)), dx, 6);
    dx[9] = dw_B[axis()];
    return dx;
  }
  taylor::Operations<double> record(std::span<const double> x, double t) const {
    return record_single_motion(equations_, x, t);
  }

 private:
  SpinlessMotionEquations<double> equations_{};
  Mat3<double> release_R_LB_;
  Vec3<double> u_;
};

/// Attitude and rate are shown in the axes of the carrier, as if it stood still and masses were where they were at release.
class SuspensionMotion {
 public:
  struct Shape {
    static constexpr std::size_t kSize = GimbalMotionEquations<double>::kSize;
    static constexpr auto groups() { return std::array<ComponentGroup, 2>{{{0, 2, 1.0}, {2, 3, 1e-3}}}; }
  };
  using State = std::array<double, Shape::kSize>;

  SuspensionMotion(const MotionProblem<double>& problem, const Motion<double>&) : equations_{problem.model} {}
  static int axis() { return 2; }
  State initial_state() const {
    const Model<double>& model = equations_.model;
    const GimbalAngles<double>& release = model.gimbals.release;
    const GimbalPose<double, double> pose{model.gimbals, real::sin_cos(release.outer), real::sin_cos(release.inner)};
    const Vec3<double> turning = of_rotating(gimbal_surroundings<false>(model, 0.0)).turning;
    const GimbalMomenta<double> p = gimbal_momenta(model, carried_parts(model, 0.0), pose, release.outer_rate,
                                                   release.inner_rate, model.rotor.spin, turning, 0.0);
    return {release.outer, release.inner, p.outer, p.inner, p.rotor};
  }
  template <class S>
  Turning<S> turning(const std::array<S, Shape::kSize>& x) const {
    const Model<double>& model = equations_.model;
    const GimbalPose<double, S> pose{model.gimbals, real::sin_cos(x[0]), real::sin_cos(x[1])};
    const GimbalMotion<S> motion = gimbal_motion(model, carried_parts(model, 0.0), pose, GimbalMomenta<S>{x[2], x[3], x[4]},
                                                 over_scalar<S>(model.W_IL_L), 0.0);
    Mat3<S> R_PB;
    for (int i = 0; i < 3; ++i)
      R_PB.row(i) = pose.into_body(pose.into_ring(over_scalar<S>(Vec3<double>(Vec3<double>::Unit(i))))).transpose();
    return {R_PB, motion.w_B, S(0)};
  }
  /// The disturbances that the gimbals allow: turns about both axes, and about that of the rotor.
  State change(const State& x, const Vec3<double>& theta_B, const Vec3<double>& dw_B) const {
    const Model<double>& model = equations_.model;
    const GimbalPose<double, double> pose{model.gimbals, real::sin_cos(x[0]), real::sin_cos(x[1])};
    const Vec3<double> a_B = pose.outer_axis_B(), I_a = times(model.I_BP_B, a_B);
    const double outer = model.gimbals.outer.locked ? 0 : 1, inner = model.gimbals.inner.locked ? 0 : 1;
    const double da = outer * dw_B.dot(a_B), db = inner * dw_B[1];
    return {outer * theta_B.dot(a_B), inner * theta_B[1],
            outer * ((model.gimbals.ring.I(2, 2) + a_B.dot(I_a)) * da + I_a[1] * db),
            inner * (I_a[1] * da + model.I_BP_B(1, 1) * db),
            model.rotor.driven ? 0 : model.rotor.axial * dw_B.dot(model.rotor.axis_B)};
  }
  taylor::Operations<double> record(std::span<const double> x, double t) const {
    return record_single_motion(equations_, x, t);
  }

 private:
  GimbalMotionEquations<double> equations_;
};

class WheelMotion {
 public:
  struct Shape {
    static constexpr std::size_t kSize = WheelMotionEquations<double>::kSize;
    static constexpr auto groups() {
      return std::array<ComponentGroup, 4>{{{0, 2, 1.0}, {2, 1, 1e-3}, {3, 1, 1e-3}, {4, 1, 2.0}}};
    }
  };
  using State = std::array<double, Shape::kSize>;

  WheelMotion(const MotionProblem<double>& problem, const Motion<double>& release) : release_(release) {
    const Mat3<double> R_LB = rotation_matrix(release.q);
    const double level = real::hypot(R_LB(0, 2), R_LB(1, 2));
    equations_.model = problem.model;
    equations_.top = reduced_top(problem.model);
    equations_.east = R_LB(0, 2) / level, equations_.north = R_LB(1, 2) / level;
    equations_.w3 = release.m[2];
  }
  static int axis() { return 2; }
  State initial_state() const {
    return {1, 0, times(rotation_matrix(release_.q), release_.m)[2] - equations_.model.W_IL_L[2], 0, 0};
  }
  template <class S>
  Turning<S> turning(const std::array<S, Shape::kSize>& x) const {
    const Mat3<S> R_LB = rotation_matrix(Quaternion<S>{x[0], Vec3<S>(S(0), S(0), x[1])} *
                                         Quaternion<S>{S(release_.q.w), release_.q.v.template cast<S>()});
    const Vec3<double>& W = equations_.model.W_IL_L;
    const Vec3<S> turning_L = W.template cast<S>() + Vec3<S>(S(0), S(0), x[2]);
    Vec3<S> w_IB_B = transposed_times(R_LB, turning_L);
    w_IB_B[2] = S(equations_.w3) + x[3];
    return {R_LB, w_IB_B, x[4]};
  }
  /// What the gimbal allows of a disturbance: a turn about Up, and one about the axis.
  State change(const State& x, const Vec3<double>& theta_B, const Vec3<double>& dw_B) const {
    const Mat3<double> R_LB = turning(x).R_LB;
    const Vec3<double> up_B = R_LB.row(2).transpose(), W_B = transposed_times(R_LB, equations_.model.W_IL_L);
    const double angle = theta_B.dot(up_B);
    const Vec3<double> allowed_B = up_B * angle + Vec3<double>(0, 0, theta_B[2]);
    return {-x[1] * angle / 2, x[0] * angle / 2, Vec3<double>(dw_B - W_B.cross(allowed_B)).dot(up_B), dw_B[2], theta_B[2]};
  }
  taylor::Operations<double> record(std::span<const double> x, double t) const {
    return record_single_motion(equations_, x, t);
  }

 private:
  WheelMotionEquations<double> equations_{};
  Motion<double> release_;
};

}  // namespace earthtop
