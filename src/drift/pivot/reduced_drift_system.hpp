// SPDX-License-Identifier: GPL-3.0-or-later
/// The right-hand side of a symmetric top's drift integration without its spin, on one state vector:
///   [0,3) axis n   [3,6) transverse rate u   [6,9) frame vector a, all of the non-rotating reference
///   [9] w   [10,13) y   [13,16) V
///
/// The deviation is the one in outer axes (deviation.hpp): the attitude D = R_rot R_ref^T, and the rate turned back by D,
/// w_rot = D (w_ref + epsilon (V + k n)). Its equations need no attitude but the reference's axis. The part of the rate along
/// the axis, k = (w3_rot - w3_ref) / epsilon, is constant, like the reference's b = r w3 with r = I3/I1. The rest is V, with
/// V.n = 0:
///
///   dV/dt = u x V + (1 - r) k s + (b + (r - 1) epsilon k) n x V + (m l / I1) n x (D^T g_rot - g) / epsilon
///   D turns at v = V + k n, in the laboratory less D^T W
///
/// The spin phases are exact: that of the reference is w3 t, that of the rotating body is contained in D.
#pragma once

#include <array>

#include "drift/deviation_state.hpp"
#include "drift/pivot/drift_system.hpp"
#include "drift/pivot/expand_drift_series.hpp"
#include "drift/pivot/reduced_drift_flows.hpp"
#include "earthtop/model/reduced_top.hpp"
#include "integrate/group_norms.hpp"

namespace earthtop {

/// The shape of a state: the reference's axis, transverse rate and frame vector, and the deviation.
struct ReducedDriftShape {
  static constexpr std::size_t kSize = 16;
  static constexpr auto groups() {
    return std::array<ComponentGroup, 5>{{{0, 3, 1.0}, {3, 3, 1e-3}, {6, 3, 1.0}, {9, 1, 1.0}, {10, 6, 1e-5}}};
  }
};

/// @tparam O  laboratory, or inertial, in whose axes gravity turns
template <class T, Observer O>
class ReducedDriftSystem : public WithSeries<ReducedDriftSeries<T, O>> {
 public:
  static_assert(O != Observer::body);
  using Shape = ReducedDriftShape;
  static constexpr std::size_t kSize = Shape::kSize;
  using State = std::array<T, kSize>;

  ReducedDriftSystem(const Model<T>& model, const NaturalRelease<T>& release)
      : model_(model),
        top_(reduced_top(model)),
        release_(release),
        constants_(top_, release.w_XB_B[top_.axis], initial_rate_deviation_B()[top_.axis], model.epsilon),
        frame_(top_.axis, release.q_LB, release.w_XB_B[top_.axis]) {}

  EARTHTOP_INLINE_ALL void operator()(const State& x, State& dxdt, T t) const {
    const AxisMotion<T> reference = load_reference(x);
    const Deviation<T> deviation = load_deviation(x);
    const T epsilon = model_.epsilon;
    const Vec3<T>& g_L = model_.apparent_gravity_L;
    const auto turned_back = [&](const Vec3<T>& u) { return turn_back_minus_one_scaled(deviation.w, deviation.y, epsilon, u); };
    // The reference is a motion without the Earth's rotation.
    const Vec3<T> no_Earth = Vec3<T>::Zero();
    const Vec3<T> s = reference.u.cross(reference.n);
    store_reference(axis_equation(top_, reference, s, constants_.b.value, no_Earth, g_L), dxdt);
    store(spinless_frame_equation(reference.n, s, load(x, 6), no_Earth), dxdt, 6);

    const Vec3<T> v = deviation_rate(reference.n, deviation.p);
    const Vec3<T> d = [&]() -> Vec3<T> {
      if constexpr (O == Observer::inertial) return Vec3<T>(v);
      return v - (model_.W_IL_L_scaled + epsilon * turned_back(model_.W_IL_L_scaled));
    }();
    Vec3<T> Dg = turned_back(g_L);
    if constexpr (O == Observer::inertial) {
      const LaboratoryTurn<T> turn = laboratory_turn(model_, t);
      const Vec3<T> turned = turn_minus_one_scaled(turn.w, turn.v_scaled, epsilon, g_L);
      Dg += turned + epsilon * turned_back(turned);
    }
    dxdt[9] = -epsilon * epsilon * deviation.y.dot(d) / T(2);
    store(Vec3<T>((deviation.w * d + epsilon * deviation.y.cross(d)) / T(2)), dxdt, 10);
    const Vec3<T> mass_moment_A = mass_moment_along(top_, reference.n);
    const Vec3<T> dV = reference.u.cross(deviation.p) + constants_.axis_rate_factor * s +
                       constants_.cross_factor * reference.n.cross(deviation.p) + field_torque(mass_moment_A, Dg);
    store(dV, dxdt, 13);
  }

  ReducedDriftSeries<T, O> series() const { return {model_, top_, constants_}; }
  const ReducedTop<T>& top() const { return top_; }
  const ReducedDriftConstants<T>& constants() const { return constants_; }

  /// The state at release, where both motions have the same attitude and the same rates of the kind that the release names.
  State initial_state() const {
    const Mat3<T> R_LB = rotation_matrix(release_.q_LB);
    State x;
    store_reference({R_LB.col(top_.axis), times(R_LB, transverse(release_.w_XB_B))}, x);
    store(R_LB.col((top_.axis + 1) % 3), x, 6);
    x[9] = T(1);
    store(Vec3<T>(Vec3<T>::Zero()), x, 10);
    store(times(R_LB, transverse(initial_rate_deviation_B())), x, 13);
    return x;
  }
  /// A state with the sizes that errors are measured against from the start. That of u is at least the nutation rate b: an
  /// error of u tilts the axis only by its ratio to b. That of V is at least k.
  State typical_state() const {
    State x = initial_state();
    x[3] = std::max(norm(load(x, 3)), real::abs(constants_.b.value));
    x[13] = std::max(norm(load(x, 13)), real::abs(constants_.k));
    return x;
  }

  /// The two exact flows of the equations, for `splitting`; in double only.
  auto flows() const requires std::is_same_v<T, double> {
    return ReducedDriftFlows<O>(model_, top_, constants_.b.value, constants_.k);
  }

  /// Called after every step, to keep attitudes continuous.
  void follow(const State& x) { frame_.follow(load(x, 0), load(x, 6)); }
  /// The frame last followed, which gives attitudes their signs; for another integration that goes on from here.
  const SpinlessFrame<T>& followed() const { return frame_; }
  void go_on_from(const SpinlessFrame<T>& followed) { frame_ = followed; }
  /// The longest time between two states that are seen; 0: no limit. If body axis 3 is not the axis of symmetry it goes round
  /// with the spin, and its angles must be seen often enough.
  T largest_step() const {
    const T spin = real::abs(release_.w_XB_B[top_.axis]);
    return top_.axis == 2 || spin == T(0) ? T(0) : T(1) / spin;
  }

  /// The state last followed in the variables that all observers share, with rates in natural units; `t_s` is left to the
  /// caller.
  DriftState<T> shared_state(const State& x, T t) const {
    const AxisMotion<T> reference = load_reference(x);
    const Deviation<T> deviation = load_deviation(x);
    const T epsilon = model_.epsilon;
    DriftState<T> s = seen_from_laboratory<O>(model_, frame_.attitude(reference.n, load(x, 6), t), deviation, t);
    const Mat3<T> R_ref = rotation_matrix(s.ref_q_LB);
    s.ref_w_LB_B = transposed_times(R_ref, reference.u);
    s.ref_w_LB_B[top_.axis] = release_.w_XB_B[top_.axis];
    const Vec3<T> v = deviation_rate(reference.n, deviation.p);
    s.q_LB = s.ref_q_LB * Quaternion<T>{s.e_w, epsilon * s.e_v_scaled}.normalized();
    const Vec3<T> w_IB_B = s.ref_w_LB_B + epsilon * transposed_times(R_ref, v);
    s.w_LB_B = w_IB_B - transposed_times(rotation_matrix(s.q_LB), model_.W_IL_L);
    return s;
  }
  /// The part of the shared state that the drift is measured from. A common turn of both bodies about axis 3 changes none of
  /// its angles, and is left out.
  DriftState<T> deviation_state(const State& x, T t) const {
    const Vec3<T> n = load(x, 0), a = load(x, 6);
    const Quaternion<T> ref_q_LF = top_.axis == 2 ? frame_.frame(n, a) : frame_.attitude(n, a, t);
    return seen_from_laboratory<O>(model_, ref_q_LF, load_deviation(x), t);
  }

 private:
  static Vec3<T> load(const State& x, std::size_t at) { return load_vector(x, at); }
  static void store(const Vec3<T>& v, State& x, std::size_t at) { store_vector(v, x, at); }
  static AxisMotion<T> load_reference(const State& x) { return {load(x, 0), load(x, 3)}; }
  static void store_reference(const AxisMotion<T>& m, State& x) { store(m.n, x, 0), store(m.u, x, 3); }
  static Deviation<T> load_deviation(const State& x) { return {x[9], load(x, 10), load(x, 13)}; }

  /// (w_IB_rot - w_IB_ref) / epsilon at release.
  Vec3<T> initial_rate_deviation_B() const {
    if (release_.X == RatesRelativeTo::inertial) return Vec3<T>::Zero();
    return transposed_times(rotation_matrix(release_.q_LB), model_.W_IL_L_scaled);
  }
  /// The vector without its part along the axis.
  Vec3<T> transverse(Vec3<T> v_B) const {
    v_B[top_.axis] = T(0);
    return v_B;
  }
  /// The rate at which D turns in inertial space, over epsilon.
  Vec3<T> deviation_rate(const Vec3<T>& n, const Vec3<T>& V) const { return V + constants_.k * n; }

  const Model<T>& model_;
  ReducedTop<T> top_;
  NaturalRelease<T> release_;
  ReducedDriftConstants<T> constants_;
  SpinlessFrame<T> frame_;  ///< the reference's frame
};

}  // namespace earthtop
