// SPDX-License-Identifier: GPL-3.0-or-later
/// Two motions without the spin that they share, as drift states, and what a watcher of their steps asks of them.
#pragma once

#include "drift/release_rates.hpp"
#include "drift/watch/step_watcher.hpp"
#include "integrate/spinless_pair.hpp"

namespace earthtop {

/// The drift state of a pair.   @param w3  the spin that both motions share   @param t  natural units
template <class T>
DriftState<T> with_spin(const SpinlessPair<T>& x, T epsilon, T w3, T t) {
  const Quaternion<T> spin = steady_turn(2, w3, t);
  const Mat3<T> R_FB = rotation_matrix(spin);
  DriftState<T> s;
  s.epsilon = epsilon;
  s.e_w = x.e_w;
  s.ref_q_LB = x.ref_q_LF * spin;
  s.e_v_scaled = transposed_times(R_FB, x.y);
  s.q_LB = s.ref_q_LB * Quaternion<T>{x.e_w, epsilon * s.e_v_scaled}.normalized();
  s.ref_w_LB_B = transposed_times(R_FB, Vec3<T>(x.ref_across.re, x.ref_across.im, w3));
  s.w_LB_B = transposed_times(R_FB, Vec3<T>(x.across.re, x.across.im, w3 + x.spin_excess));
  return s;
}

/// Gives a pair the interface of a system that a StepWatcher expects.
template <class T>
class SpinlessPairSystem {
 public:
  using Pair = SpinlessPair<T>;
  using State = Pair;
  SpinlessPairSystem(T epsilon, T w3) : epsilon_(epsilon), w3_(w3) {}

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
  DriftState<T> shared_state(const Pair& pair, T t) const { return with_spin(signed_like(followed_, pair), epsilon_, w3_, t); }

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
