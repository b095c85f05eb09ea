// SPDX-License-Identifier: GPL-3.0-or-later
/// The drift integration of a Cardan suspension (gimbal_drift_equations.hpp).
#pragma once

#include <optional>

#include "drift/pivot/record_drift.hpp"
#include "earthtop/drift/drift_integration.hpp"
#include "integrate/motion_system.hpp"
#include "integrate/taylor/recorded_series.hpp"

namespace earthtop {

/// @tparam O  laboratory or inertial
template <class T, Observer O>
class GimbalDrift : public WithSeries<RecordedSeries<T, GimbalShape::kSize>> {
 public:
  using Shape = GimbalShape;
  static constexpr std::size_t kSize = Shape::kSize;
  static constexpr bool kBoundOnly = true;
  using State = std::array<T, kSize>;
  using P = Paired<T>;

  GimbalDrift(const Model<T>& model, RatesRelativeTo matched) : equations_{model}, matched_(matched) {
    equations_.rotor_momentum = momenta_at_release().rotor.ref;
  }

  const GimbalDriftEquations<T, O>& equations() const { return equations_; }
  void operator()(const State& x, State& dxdt, T t) const { equations_(x, dxdt, t); }
  RecordedSeries<T, kSize> series() const {
    return RecordedSeries<T, kSize>([this](const State& x, T t) { return record_spinless<T>(equations_, x, t); });
  }

  /// Both motions have the same angles, and the same rates as given. Matched in the laboratory they have the same rates. Matched in
  /// inertial rates each part has the same inertial rate about its own axis, and the rotor the same momentum; those given are of the
  /// non-rotating motion.
  State initial_state() const {
    const GimbalMomenta<P> p = momenta_at_release();
    State x{};
    equations_.put(p.outer, x, Shape::kMomenta);
    equations_.put(p.inner, x, Shape::kMomenta + 1);
    equations_.put(p.rotor, x, Shape::kMomenta + 2);
    return x;
  }
  /// A state with the sizes that errors are measured against from the start.
  State typical_state() const {
    State x = initial_state();
    x[Shape::kOuter] = T(1);
    return x;
  }
  void follow(const State&) {}

  DriftState<T> shared_state(const State& x, T t) const {
    DriftState<T> s = deviation_state(x, t);
    s.q_LB = s.ref_q_LB * Quaternion<T>{s.e_w, s.epsilon * s.e_v_scaled}.normalized();
    const GimbalMotion<P> m = equations_.motion(x, t);
    const PrescribedMotion<T>& turn = equations_.model.platform.turn;
    const GimbalPose<T, P> pose = equations_.pose_of(x);
    const Vec3<P> carrier_B = pose.into_body(pose.into_ring(paired_vector(Vec3<T>(turn.angle_rate(t) * turn.axis))));
    const Vec3<P> w_LB_B = carrier_B + m.axis_B * m.outer_rate + Vec3<P>(P(T(0)), m.inner_rate, P(T(0)));
    s.ref_w_LB_B = parts(w_LB_B, &P::ref), s.w_LB_B = parts(w_LB_B, &P::rot);
    return s;
  }
  /// The turn from the reference to the rotating motion is one about the reference's outer axis, then one about the inner axis.
  DriftState<T> deviation_state(const State& x, T t) const {
    const Model<T>& model = equations_.model;
    const T epsilon = model.epsilon;
    DriftState<T> s;
    s.epsilon = epsilon;
    s.ref_q_LB = platform_attitude(t) * gimbal_attitude(model.gimbals, equations_.outer(x).ref, equations_.inner_angle(x).ref);
    const SinCos<T> a = real::sin_cos(T(epsilon * x[Shape::kHalf + Shape::kOuter] / T(2))),
                    b = real::sin_cos(T(epsilon * x[Shape::kHalf + Shape::kInner] / T(2)));
    const auto scaled = [&](const SinCos<T>& half, std::size_t i) {
      return epsilon < T(1e-60) ? T(x[Shape::kHalf + i] / T(2)) : T(half.sin / epsilon);
    };
    const T sa = scaled(a, Shape::kOuter), sb = scaled(b, Shape::kInner);
    const SinCos<T> inner_angle = real::sin_cos(equations_.inner_angle(x).ref);
    const Vec3<T> u(-inner_angle.sin * model.gimbals.skew_cos, model.gimbals.skew_sin,
                    inner_angle.cos * model.gimbals.skew_cos);
    s.e_w = a.cos * b.cos - epsilon * epsilon * sa * sb * u[1];
    s.e_v_scaled = Vec3<T>(sa * b.cos * u[0] - epsilon * sa * sb * u[2], sa * b.cos * u[1] + a.cos * sb,
                           sa * b.cos * u[2] + epsilon * sa * sb * u[0]);
    s.watched_axis_B = watched_axis();
    return s;
  }
  /// Angles and rates of the gimbals in both motions, with rates in natural units.
  GimbalState<T> gimbal_state(const State& x, T t) const {
    const GimbalMotion<P> m = equations_.motion(x, t);
    const Gimbals<T>& gimbals = equations_.model.gimbals;
    return {equations_.outer(x), equations_.inner_angle(x), m.outer_rate, m.inner_rate, headline_of(gimbals)};
  }
  /// The rotor in both motions, with rates in natural units; none without one.
  std::optional<RotorState<T>> rotor_state(const State& x, T t) const {
    const Model<T>& model = equations_.model;
    if (!model.gimbals.has_rotor) return std::nullopt;
    const P rate = equations_.motion(x, t).rotor_rate;
    const T angle = model.rotor.spin * t + x[Shape::kAngle], difference = x[Shape::kHalf + Shape::kAngle];
    return RotorState<T>{rate.rot, rate.ref,   rate.diff,         angle + model.epsilon * difference,
                         angle,    difference, model.rotor.axis_B};
  }

 private:
  /// The momenta of both motions at release, as the equations count them.
  GimbalMomenta<P> momenta_at_release() const {
    const Model<T>& model = equations_.model;
    const Gimbals<T>& gimbals = model.gimbals;
    const Rotor<T>& rotor = model.rotor;
    const GimbalAngles<T>& given = gimbals.release;
    const GimbalPose<T, P> pose = equations_.pose_of(State{});
    P outer(given.outer_rate), inner_rate(given.inner_rate), spin(rotor.spin);
    const GimbalSurroundings<P> around = equations_.surroundings(T(0));
    if (matched_ == RatesRelativeTo::inertial) {
      // By how much faster than the reference's the carrier turns.
      Vec3<T> faster = parts(around.turning, &P::diff);
      if constexpr (O == Observer::laboratory) faster += parts(around.earth, &P::diff);
      const Vec3<P> W_A = pose.into_ring(paired_vector(Vec3<T>(Vec3<T>::Zero()), faster, model.epsilon)),
                    W_B = pose.into_body(W_A), a_B = pose.outer_axis_B();
      if (!gimbals.outer.locked) outer -= W_A[2];
      const P outer_change = outer - P(given.outer_rate);
      if (!gimbals.inner.locked) inner_rate -= W_B[1] + outer_change * a_B[1];
      if (!rotor.driven) {
        // The change of the body's inertial rate along the rotor's axis.
        const Vec3<P> change = W_B + a_B * outer_change + Vec3<P>(P(T(0)), P(inner_rate - P(given.inner_rate)), P(T(0)));
        spin -= inner(over_scalar<P>(rotor.axis_B), change);
      }
    }
    return gimbal_momenta(model, carried_parts(model, T(0)), pose, outer, inner_rate, spin, around.turning, T(0),
                          equations_.rotor_momentum);
  }
  Quaternion<T> platform_attitude(T t) const {
    const PrescribedMotion<T>& turn = equations_.model.platform.turn;
    const SinCos<T> half = real::sin_cos(T(turn.angle(t) / T(2)));
    return {half.cos, Vec3<T>(half.sin * turn.axis)};
  }
  /// The body axis whose drift is judged: the rotor's. Without a rotor, where one gimbal is locked, one that is normal to the free axis,
  /// so that its drift is that of the angle.
  Vec3<T> watched_axis() const {
    const Gimbals<T>& gimbals = equations_.model.gimbals;
    if (gimbals.has_rotor) return equations_.model.rotor.axis_B;
    if (headline_of(gimbals) == GimbalHeadline::axis) return Vec3<T>::UnitZ();
    const SinCos<T> angle = real::sin_cos(gimbals.release.inner);
    return {angle.cos, T(0), angle.sin};
  }

  GimbalDriftEquations<T, O> equations_;
  RatesRelativeTo matched_;
};

}  // namespace earthtop
