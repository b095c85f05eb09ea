// SPDX-License-Identifier: GPL-3.0-or-later
/// The two motions of a run by long_horizon, and what a watcher of its steps asks of them.
#pragma once

#include "drift/release_rates.hpp"
#include "drift/watch/step_watcher.hpp"
#include "integrate/long_horizon.hpp"

namespace earthtop {

/// Both motions at one instant, without the spin w3 t that they share. (e_w, epsilon y) is the quaternion of R_ref^T R_rot.
template <class T>
struct LongHorizonPair {
  Quaternion<T> ref_q_LF;
  Complex<T> ref_across;
  T e_w = T(1);
  Vec3<T> y = Vec3<T>::Zero();
  Complex<T> across;     ///< rate of the rotating motion's axis, in its own frame
  T spin_excess = T(0);  ///< rate of the rotating motion along the axis relative to the laboratory, less w3
};

/// Gives a pair the interface of a system that a StepWatcher expects.
template <class T>
class LongHorizonPairSystem {
 public:
  using Pair = LongHorizonPair<T>;
  using State = Pair;
  LongHorizonPairSystem(T epsilon, T w3) : epsilon_(epsilon), w3_(w3) {}

  void follow(const Pair& x) { followed_ = signed_like(followed_, x); }
  /// The pair with the signs of its two quaternions chosen to be close to those followed last.
  Pair signed_like_followed(const Pair& pair) const { return signed_like(followed_, pair); }
  /// @param followed  a pair with the signs that another watcher has given it
  void go_on_from(const Pair& followed) { followed_ = followed; }
  DriftState<T> deviation_state(const Pair& pair, T) const {
    const Pair x = signed_like(followed_, pair);
    DriftState<T> s;
    s.epsilon = epsilon_;
    s.ref_q_LB = x.ref_q_LF;
    s.e_w = x.e_w;
    s.e_v_scaled = x.y;
    return s;
  }
  DriftState<T> shared_state(const Pair& pair, T t) const {
    const Pair x = signed_like(followed_, pair);
    const Quaternion<T> spin = steady_turn(2, w3_, t);
    const Mat3<T> R_FB = rotation_matrix(spin);
    DriftState<T> s = deviation_state(pair, t);
    s.ref_q_LB = x.ref_q_LF * spin;
    s.e_v_scaled = transposed_times(R_FB, x.y);
    s.q_LB = s.ref_q_LB * Quaternion<T>{x.e_w, epsilon_ * s.e_v_scaled}.normalized();
    s.ref_w_LB_B = transposed_times(R_FB, Vec3<T>(x.ref_across.re, x.ref_across.im, w3_));
    s.w_LB_B = transposed_times(R_FB, Vec3<T>(x.across.re, x.across.im, w3_ + x.spin_excess));
    return s;
  }

 private:
  Pair signed_like(const Pair& last, const Pair& pair) const {
    Pair x = pair;
    if (last.ref_q_LF.w * x.ref_q_LF.w + last.ref_q_LF.v.dot(x.ref_q_LF.v) < T(0)) x.ref_q_LF = {-x.ref_q_LF.w, -x.ref_q_LF.v};
    if (last.e_w * x.e_w + (epsilon_ * last.y).dot(epsilon_ * x.y) < T(0)) x.e_w = -x.e_w, x.y = -x.y;
    return x;
  }
  T epsilon_, w3_;
  Pair followed_;

 public:
  void start_from(const Quaternion<T>& q_LB) { followed_.ref_q_LF = q_LB; }
};

}  // namespace earthtop
