// SPDX-License-Identifier: GPL-3.0-or-later
/// The equations of a symmetric top's reference and deviation without its spin, with applied torques, a tide or a moving pivot.
/// They are those of reduced_drift_system.hpp, with two differences: the torques are found by the formulas of
/// reduced_torques.hpp, as pairs; and the spin w3 and its deviation k change,
///
///   dw3/dt = tau_n / I3 ,  dk/dt = (the same for the rotating motion - that of the reference) / epsilon
///
/// The state, all in the axes of the observer:
///   [0,3) axis n   [3,6) transverse rate u   [6,9) frame vector a   [9] w3 minus that at release   [10] its integral over time
///   [11] w   [12,15) y   [15,18) V   [18] k
#pragma once

#include <array>

#include "drift/deviation_state.hpp"
#include "earthtop/model/reduced_torques.hpp"
#include "integrate/group_norms.hpp"
#include "integrate/state_vectors.hpp"
#include "model/applied_motion.ipp"

namespace earthtop {

/// The shape of a state. Spin and phase are measured against a full spin and against one radian, not against their changes.
struct DrivenReducedShape {
  static constexpr std::size_t kSize = 19;
  static constexpr auto groups() {
    return std::array<ComponentGroup, 7>{
        {{0, 3, 1.0}, {3, 3, 1e-3}, {6, 3, 1.0}, {9, 1, 1e-3}, {10, 1, 2.0}, {11, 1, 1.0}, {12, 7, 1e-5}}};
  }
};

/// @tparam T  a number, or a scalar that records operations   @tparam O  laboratory, or inertial
template <class T, Observer O>
struct DrivenReducedEquations {
  static_assert(O != Observer::body);
  static constexpr std::size_t kSize = DrivenReducedShape::kSize;
  using State = std::array<T, kSize>;

  Model<T> model;
  ReducedTop<T> top;
  T w3;            ///< inertial spin of the reference at release
  T k_at_release;  ///< its deviation
  T b, b_rest;     ///< (I3/I1) w3, and its rounding error
  EARTHTOP_MEMBERS(model, top, w3, k_at_release, b, b_rest)

  void operator()(const State& x, State& dxdt, T t) const {
    const Vec3<T> n = load_vector(x, 0), u = load_vector(x, 3), a = load_vector(x, 6);
    const Vec3<T> y = load_vector(x, 12), V = load_vector(x, 15);
    const bool spins = model.applied.changes_spin();
    const T &w = x[11], &epsilon = model.epsilon;
    const T spin_change = spins ? x[9] : T(0), k = spins ? x[18] : k_at_release;
    const Vec3<T> s = u.cross(n), v = V + k * n;
    const Mat3<T> M = turn_back_minus_one_matrix(w, y, epsilon);
    const auto see = [&](const Vec3<T>& u_L, const Vec3<T>& change_L) { return seen(u_L, change_L, t, M); };

    const AxisTorques<Paired<T>> torques =
        axis_torques<T, Paired<T>>(top, model, Paired<T>(moment_factor(top, n)), both_motions(n, u, spin_change, V, k, t, see));
    const T nutation = b + (b_rest + top.spin_ratio * spin_change);
    const T spinning = (T(1) - top.spin_ratio) * k;
    const Vec3<T> across = n.cross(V);
    const Vec3<T> d = relative_to_axes(v, M);

    store_vector(s, dxdt, 0);
    store_vector(Vec3<T>(parts(torques.across, &Paired<T>::ref) - nutation * s), dxdt, 3);
    // The frame turns at the part of u that is normal to n, whatever the error of u; u.n is constant along the exact motion.
    using real::conserved;
    store_vector(Vec3<T>(Vec3<T>(u - conserved(T(u.dot(n))) * n).cross(a)), dxdt, 6);
    dxdt[9] = torques.along.ref;
    dxdt[10] = spin_change;
    dxdt[11] = -epsilon * epsilon * y.dot(d) / T(2);
    store_vector(Vec3<T>((w * d + epsilon * y.cross(d)) / T(2)), dxdt, 12);
    store_vector(
        Vec3<T>(u.cross(V) + spinning * s + (nutation - epsilon * spinning) * across + parts(torques.across, &Paired<T>::diff)),
        dxdt, 15);
    dxdt[18] = torques.along.diff;
  }

 private:
  /// v minus the rate of the axes over epsilon, turned back as the rotating motion sees it.
  Vec3<T> relative_to_axes(const Vec3<T>& v, const Mat3<T>& M) const {
    if constexpr (O == Observer::inertial)
      return v;
    else
      return v - Vec3<T>(model.W_IL_L_scaled + model.epsilon * times(M, model.W_IL_L_scaled));
  }
  /// The change over epsilon that the Earth's rate makes in a vector of the laboratory, with that by the turn of the laboratory in
  /// axes that do not turn with it.
  Vec3<T> whole_change(const Vec3<T>& u_L, const Vec3<T>& change_L, const T& t) const {
    if constexpr (O == Observer::laboratory) {
      return change_L;
    } else {
      const LaboratoryTurn<T> turn = laboratory_turn(model, t);
      return change_L + turn_minus_one_scaled(turn.w, turn.v_scaled, model.epsilon, Vec3<T>(u_L + model.epsilon * change_L));
    }
  }
  /// A vector of the laboratory as both motions see it, in the reference's axes.
  /// @param u_L  for the reference   @param change_L  its change by the Earth's rate over epsilon
  /// @param M  turn_back_minus_one_matrix of the deviation
  Vec3<Paired<T>> seen(const Vec3<T>& u_L, const Vec3<T>& change_L, const T& t, const Mat3<T>& M) const {
    const Vec3<T> change = whole_change(u_L, change_L, t);
    return paired_vector(u_L, Vec3<T>(times(M, u_L) + change + model.epsilon * times(M, change)), model.epsilon);
  }

  template <class See>
  SeenBesideAxis<Paired<T>> both_motions(const Vec3<T>& n, const Vec3<T>& u, const T& spin_change, const Vec3<T>& V, const T& k,
                                         const T& t, const See& see) const {
    SeenBesideAxis<Paired<T>> seen;
    seen.n = paired_vector(n);
    const PivotField<T> field = pivot_field<SceneKind::full>(model, t);
    seen.field = see(field.reference_L, field.difference_L_scaled);
    const T spin = w3 + spin_change;
    seen.u = paired_vector(u, V, model.epsilon);
    seen.w3 = Paired<T>(spin, spin + model.epsilon * k, k);
    const Vec3<T> unchanged = Vec3<T>::Zero();
    if (!model.journey.empty()) {
      if (!model.applied.any) return seen;
      const applied_motion::SeeOnJourney<T, See> from_L{LaboratoryAxes<T>(model.journey, t), model.epsilon, see};
      see_torques(
          top, model, t, [&](const Vec3<T>& u_L) { return from_L(u_L, unchanged); }, seen);
      if (model.applied.friction()) seen.w_IP = applied_motion::carrier_rate(model, t, from_L);
      return seen;
    }
    see_torques(
        top, model, t, [&](const Vec3<T>& u_L) { return see(u_L, unchanged); }, seen);
    if (!model.applied.friction()) return seen;
    seen.w_IP = see(applied_motion::Carrier<T>(model.platform, t).w_LP_L, model.W_IL_L_scaled);
    return seen;
  }
};

}  // namespace earthtop
