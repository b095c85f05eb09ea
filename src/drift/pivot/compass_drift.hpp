// SPDX-License-Identifier: GPL-3.0-or-later
/// The drift integration of a wheel in a gimbal (compass_equations.hpp).
#pragma once

#include "drift/pivot/compass_equations.hpp"
#include "drift/pivot/record_drift.hpp"
#include "integrate/motion_system.hpp"
#include "integrate/taylor/recorded_series.hpp"

namespace earthtop {

/// @tparam O  laboratory or inertial, see CompassEquations
template <class T, Observer O>
class CompassDrift : public WithSeries<RecordedSeries<T, CompassShape::kSize>> {
 public:
  using Shape = CompassShape;
  static constexpr std::size_t kSize = Shape::kSize;
  static constexpr bool kSeriesOnly = true;
  using State = std::array<T, kSize>;

  /// @param release  with rates relative to the laboratory
  CompassDrift(const Model<T>& model, const NaturalRelease<T>& release)
      : release_q_LB_(release.q_LB.normalized()), epsilon_(model.epsilon) {
    const Mat3<T> R_LB = rotation_matrix(release_q_LB_);
    const Vec3<T>& w_LB_B = release.w_XB_B;
    const Vec3<T> w_LB_L = times(R_LB, w_LB_B);
    const T level = real::hypot(R_LB(0, 2), R_LB(1, 2));
    const T east = R_LB(0, 2) / level, north = R_LB(1, 2) / level;
    release_p_ = w_LB_L[2];
    const Vec3<T>& W = model.W_IL_L_scaled;
    carried_scaled_ = W[0] * east + W[1] * north;
    spin_ = w_LB_B[2];
    const T w3 = O == Observer::laboratory ? spin_ : spin_ + epsilon_ * carried_scaled_;
    equations_ = {model, reduced_top(model), east, north, w3, w3 - spin_};
  }

  const CompassEquations<T, O>& equations() const { return equations_; }
  void operator()(const State& x, State& dxdt, T t) const { equations_(x, dxdt, t); }
  RecordedSeries<T, kSize> series() const {
    return RecordedSeries<T, kSize>([this](const State& x, T t) { return record_spinless<T>(equations_, x, t); });
  }
  /// Both motions have the same axis, rate and spin relative to the laboratory.
  State initial_state() const { return {T(1), T(0), release_p_, T(0), T(0), T(1), T(0), T(0), carried_scaled_, T(0)}; }
  State typical_state() const {
    State x = initial_state();
    x[3] = real::abs(equations_.w3);
    return x;
  }
  T largest_step() const { return T(0); }
  void follow(const State&) {}

  DriftState<T> shared_state(const State& x, T t) const {
    DriftState<T> s = deviation_state(x, t);
    s.q_LB = s.ref_q_LB * Quaternion<T>{s.e_w, epsilon_ * s.e_v_scaled}.normalized();
    const CompassMotion<Paired<T>> both = equations_.motions(x);
    const auto rate = [](const Quaternion<T>& q_LB, const T& p, const T& spin) {
      Vec3<T> w_LB_B = p * Vec3<T>(rotation_matrix(q_LB).row(2).transpose());
      w_LB_B[2] = spin;
      return w_LB_B;
    };
    const Vec3<T>& W = equations_.model.W_IL_L;
    s.ref_w_LB_B = rate(s.ref_q_LB, both.p.ref, both.w3.ref);
    s.w_LB_B = rate(s.q_LB, both.p.rot, both.w3.rot - (W[0] * both.n_east.rot + W[1] * both.n_north.rot));
    return s;
  }
  DriftState<T> deviation_state(const State& x, T t) const {
    // The reference's attitude: turned about Up, and by its spin. e = q_ref^* q_rot is a turn about Up as seen from its body,
    // followed by the deviation of the spin phase.
    const T w = x[5], y = x[6], phase = epsilon_ * x[9];
    Quaternion<T> about_up{x[0], Vec3<T>(T(0), T(0), x[1])};
    T reference_phase = x[4];
    if constexpr (O == Observer::inertial) {
      // The base is the rotating motion: the reference lags by the deviation, in angle and in phase.
      about_up = about_up * Quaternion<T>{w, Vec3<T>(T(0), T(0), -epsilon_ * y)};
      reference_phase -= phase;
    }
    DriftState<T> s;
    s.epsilon = epsilon_;
    s.ref_q_LB = about_up * release_q_LB_ * steady_turn(2, spin_, t) * steady_turn(2, reference_phase, T(1));
    s.ref_q_LB = s.ref_q_LB.normalized();
    const Vec3<T> up_B = rotation_matrix(s.ref_q_LB).row(2).transpose();
    const SinCos<T> half = real::sin_cos(T(phase / T(2)));
    const T sine_scaled = epsilon_ > T(0) ? half.sin / epsilon_ : x[9] / T(2);
    const Vec3<T> turn = y * up_B, spin(T(0), T(0), sine_scaled);
    s.e_w = w * half.cos - epsilon_ * epsilon_ * turn.dot(spin);
    s.e_v_scaled = w * spin + half.cos * turn + epsilon_ * turn.cross(spin);
    return s;
  }

 private:
  Quaternion<T> release_q_LB_;
  T epsilon_, release_p_ = T(0), carried_scaled_ = T(0), spin_ = T(0);
  CompassEquations<T, O> equations_;
};

}  // namespace earthtop
