// SPDX-License-Identifier: GPL-3.0-or-later
/// The variational equations of a symmetric top's motion without its spin, with applied torques, a tide or a moving pivot.
///
/// They are the deviation equations of driven_reduced_equations.hpp for a deviation that is infinitely small, from a motion that
/// may itself be the one on the rotating Earth. theta is the turn of the attitude and v = V + k n the change of the inertial
/// rate, both carried round with the body: in body axes they are the theta and dw of variations.hpp. In laboratory axes, which
/// turn at W, with the torques' first-order changes d(tau) when the laboratory is turned back by theta:
///
///   dn/dt = s - W x n ,  du/dt = tau_across / I1 - b s - W x u ,  dw3/dt = tau_n / I3 ,  dtheta/dt = v - W x theta
///   dV/dt = u x V + (1 - r) k s + b n x V + d(tau_across) / I1 - W x V ,  dk/dt = d(tau_n) / I3
#pragma once

#include <array>

#include "drift/derivatives/spinless_variations.hpp"
#include "earthtop/model/reduced_torques.hpp"
#include "integrate/group_norms.hpp"
#include "model/applied_motion.ipp"

namespace earthtop {

/// The shape of a state: n, u, the change of w3, and theta, V, k of each disturbance.
struct DrivenVariationsShape {
  static constexpr std::size_t kMotionSize = 7, kSize = kMotionSize + 7 * kDisturbances;
  static constexpr auto groups() {
    return std::array<ComponentGroup, 6>{{{0, 3, 1.0},
                                          {3, 3, 1e-3},
                                          {6, 1, 1e-3},
                                          {kMotionSize, 7, 1e-3},
                                          {kMotionSize + 7, 7, 1e-3},
                                          {kMotionSize + 14, 7, 1e-3}}};
  }
};

/// @tparam T  a number, or a scalar that records operations
template <class T>
struct DrivenVariationsEquations {
  using State = std::array<T, DrivenVariationsShape::kSize>;

  Model<T> model;
  ReducedTop<T> top;
  T w3, b;         ///< inertial spin at release, and (I3/I1) w3
  Vec3<T> W_L;     ///< the rate of the laboratory: the Earth's, or zero
  bool has_Earth;  ///< whether the motion is the one on the rotating Earth
  EARTHTOP_MEMBERS(model, top, w3, b, W_L, has_Earth)

  void operator()(const State& x, State& dxdt, T t) const {
    const Vec3<T> n = load_vector(x, 0), u = load_vector(x, 3), s = u.cross(n);
    const T nutation = b + top.spin_ratio * x[6];
    bool is_first = true;
    for (std::size_t i = DrivenVariationsShape::kMotionSize; i < x.size(); i += 7) {
      const Vec3<T> theta = load_vector(x, i), V = load_vector(x, i + 3), v = V + x[i + 6] * n;
      const AxisTorques<Paired<T>> torques =
          axis_torques<T, Paired<T>>(top, model, Paired<T>(moment_factor(top, n)), seen(x, theta, V, x[i + 6], t));
      if (is_first) {
        store_vector(Vec3<T>(s - W_L.cross(n)), dxdt, 0);
        store_vector(Vec3<T>(parts(torques.across, &Paired<T>::ref) - nutation * s - W_L.cross(u)), dxdt, 3);
        dxdt[6] = torques.along.ref;
        is_first = false;
      }
      store_vector(Vec3<T>(v - W_L.cross(theta)), dxdt, i);
      store_vector(Vec3<T>(u.cross(V) + ((T(1) - top.spin_ratio) * x[i + 6]) * s + nutation * Vec3<T>(n.cross(V)) +
                           parts(torques.across, &Paired<T>::diff) - W_L.cross(V)),
                   dxdt, i + 3);
      dxdt[i + 6] = torques.along.diff;
    }
  }

 private:
  SeenBesideAxis<Paired<T>> seen(const State& x, const Vec3<T>& theta, const Vec3<T>& V, const T& k, const T& t) const {
    const Vec3<T> n = load_vector(x, 0), u = load_vector(x, 3);
    const auto see = [&](const Vec3<T>& u_L) { return paired_vector(u_L, u_L, Vec3<T>(u_L.cross(theta))); };
    SeenBesideAxis<Paired<T>> seen;
    seen.n = paired_vector(n);
    const PivotField<T> field = pivot_field<SceneKind::full>(model, t);
    seen.field = see(has_Earth ? field.rotating_L : field.reference_L);
    for (std::size_t i = 0; i < 2; ++i)
      if (model.applied.gradient[i].strength != T(0)) seen.gradient[i] = see(model.applied.gradient[i].direction_L);
    const T spin = w3 + x[6];
    seen.u = paired_vector(u, u, V);
    seen.w3 = Paired<T>(spin, spin, k);
    if (!model.applied.friction()) return seen;
    seen.w_IP = see(Vec3<T>(applied_motion::Carrier<T>(model.platform, t).w_LP_L + W_L));
    return seen;
  }
};

/// The system of a motion and its disturbances, with the interface of GeneralVariations.
template <bool kEarth>
class DrivenReducedVariations : public SpinlessVariations<DrivenVariationsEquations, DrivenVariationsShape, kEarth> {
  using Base = SpinlessVariations<DrivenVariationsEquations, DrivenVariationsShape, kEarth>;
  using Base::at, Base::equations_;

 public:
  using State = typename Base::State;
  using Base::Base;

  State initial_state(const Motion<double>& release) {
    release_R_LB_ = rotation_matrix(release.q);
    equations_.w3 = release.m[axis()];
    equations_.b = equations_.top.spin_ratio * equations_.w3;
    State x{};
    store_vector(release_R_LB_.col(axis()), x, 0);
    store_vector(times(release_R_LB_, across(release.m)), x, 3);
    return x;
  }
  /// The motion, apart from a turn about its axis.
  Motion<double> motion(const State& x) const {
    const Mat3<double> R_LB = attitude(x);
    Vec3<double> w_B = transposed_times(R_LB, load_vector(x, 3));
    w_B[axis()] = equations_.w3 + x[6];
    return {quaternion_of(R_LB), w_B};
  }
  Vec3<double> theta(const State& x, std::size_t d) const { return load_vector(x, at(d)); }
  Vec3<double> dw(const State& x, std::size_t d) const { return load_vector(x, at(d) + 3) + x[at(d) + 6] * load_vector(x, 0); }
  /// Puts in a disturbance at release, given in body axes.
  void put_disturbance(const Vec3<double>& theta_B, const Vec3<double>& dw_B, State& x, std::size_t d) const {
    store_vector(times(release_R_LB_, theta_B), x, at(d));
    store_vector(times(release_R_LB_, across(dw_B)), x, at(d) + 3);
    x[at(d) + 6] = dw_B[axis()];
  }

 private:
  int axis() const { return equations_.top.axis; }
  Vec3<double> across(Vec3<double> v_B) const {
    v_B[axis()] = 0;
    return v_B;
  }
  /// Some attitude with the axis n.
  Mat3<double> attitude(const State& x) const {
    const Vec3<double> n = load_vector(x, 0) / norm(load_vector(x, 0));
    const Vec3<double> least = Vec3<double>::Unit(std::abs(n[0]) < 0.6 ? 0 : 1);
    Vec3<double> a = least - least.dot(n) * n;
    a /= norm(a);
    Mat3<double> R_LB;
    R_LB.col(axis()) = n;
    R_LB.col((axis() + 1) % 3) = a;
    R_LB.col((axis() + 2) % 3) = n.cross(a);
    return R_LB;
  }

  Mat3<double> release_R_LB_ = Mat3<double>::Identity();
};

}  // namespace earthtop
