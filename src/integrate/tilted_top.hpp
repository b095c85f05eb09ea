// SPDX-License-Identifier: GPL-3.0-or-later
/// A symmetric top on the rotating Earth as a Lagrange top about a tilted vertical, and what is left over.
///
/// With n the axis, L the inertial momentum about the pivot, kappa = L.n = I3 w3 (constant), W the Earth's rate, and any number
/// w, put
///
///   M = L - I1 W + I1 (W.n - 2 w) n ,   G = m g l z - (kappa - I1 w) W ,   delta = W.n - w .
///
/// Then in laboratory axes, exactly,
///
///   dn/dt = M x n / I1 ,   dM/dt = G x n + delta (2 M x n + I1 W x n) ,   M.n = kappa - 2 I1 w :
///
/// a Lagrange top under the constant torque G x n, which has a closed form, and a perturbation that is smaller than the Earth's
/// rate itself by about I1 |dn/dt| / kappa, the ratio of precession to nutation. For a top that spins fast it is some 1e-7 of
/// the gravity torque. With n held, the perturbation alone has an exact flow too: a turn of M about n. (w = W.n where the
/// precession leaves it on average makes delta small.)
///
/// The body turns at n x dn/dt + (w3 - W.n) n relative to the laboratory. A frame F is carried along n without rate along it;
/// the body is F turned about n by w3 t less the integral of W.n, which the large flow knows but for its part along G: integral
/// of n across G = -G x (change of M) / G^2.
#pragma once

#include "closed_form/complex.hpp"
#include "earthtop/closed_form/lagrange_top.hpp"
#include "earthtop/model/reduced_top.hpp"

namespace earthtop {

/// Where the frame F stands, and what has come of the turn about n. All axes and units are the model's.
template <class T>
struct TiltedTopState {
  Quaternion<T> q_GF;               ///< from F to axes with the third along G
  Complex<T> across;                ///< rate of n, w1 + i w2 in F
  T turn = T(0), turn_rest = T(0);  ///< minus the integral of W.n (rad), as a sum of two numbers
};

template <class T>
class TiltedTop {
 public:
  /// @param top  symmetric about body axis 3   @param W_L  the rate of the Earth
  /// @param w_XB_B  rate at release in the model's units, relative to what `X` names
  TiltedTop(const Model<T>& model, const ReducedTop<T>& top, const Quaternion<T>& q_LB, const Vec3<T>& w_XB_B,
            RatesRelativeTo X, const Vec3<T>& W_L);

  const TiltedTopState<T>& start() const { return start_; }
  /// The period of the nutation from the start; infinite where there is none.
  T nutation_period() const { return nutation_period_; }
  /// The fastest rate of the axis's motion: nutation and pendulum.
  T fast_rate() const;
  /// About how fast the axis precesses if it spins fast: G over kappa; infinite where it does not spin.
  T precession_rate() const;
  /// About how fast the kicks, by themselves, would turn the axis, at most.
  T kick_rate() const { return kick_rate_; }
  T earth_rate() const { return norm(W_G_); }
  /// The most that the frame F turns in a unit of time.
  T frame_rate() const { return frame_rate_; }

  /// The large flow, exactly; of either sign of the time.
  class Flow {
   public:
    Flow(const TiltedTop& top, const TiltedTopState<T>& from);
    /// The quaternion on the side of the start's, which is the continuous one for less than half a turn.
    TiltedTopState<T> at(T t) const;

   private:
    const TiltedTop& top_;
    TiltedTopState<T> from_;
    LagrangeTop<T> closed_form_;
    Vec3<T> momentum_;
  };
  void flow(T t, TiltedTopState<T>& x) const {
    if (t != T(0)) x = Flow(*this, x).at(t);
  }
  /// The kick: what the perturbation does in the time b, n held.
  void kick(T b, TiltedTopState<T>& x) const;

  /// The attitude q_LF of the frame that is turned about n by all but w3 t, and the rate of n in it: the body's attitude is
  /// q_LF steady_turn(2, w3, t), w3 the rate along the axis as released.
  struct Seen {
    Quaternion<T> q_LF;
    Complex<T> across;
    T spin_excess;  ///< rate of the body along n relative to the laboratory, less w3
  };
  Seen seen(const TiltedTopState<T>& x, T t) const;

 private:
  Vec3<T> momentum(const TiltedTopState<T>& x) const;
  static void add_turn(T angle, TiltedTopState<T>& x);

  TiltedTopState<T> start_;
  Quaternion<T> q_LG_;
  Vec3<T> W_G_;
  T I1_ = T(1), kappa_ = T(0), G_ = T(0);
  T mean_ = T(0);        ///< w
  T spin_start_ = T(0);  ///< rate along n relative to inertial space less w3 as released
  bool exact_turn_ = true;
  SymmetricTop<T> effective_;  ///< without spin: only its kappa counts
  T effective_spin_ = T(0);
  T nutation_period_ = T(0), kick_rate_ = T(0), frame_rate_ = T(0);
};

extern template class TiltedTop<double>;
extern template class TiltedTop<long double>;

}  // namespace earthtop
