// SPDX-License-Identifier: GPL-3.0-or-later
/// A symmetric top on the rotating Earth, treated as a Lagrange top about a tilted vertical plus a small perturbation.
///
/// With n the axis, L the inertial momentum about the pivot, kappa = L.n = I3 w3 (constant), W the Earth's rate, and any number
/// w, put
///
///   M = L - I1 W + I1 (W.n - 2 w) n ,   G = m g l z - (kappa - I1 w) W ,   delta = W.n - w .
///
/// Then in laboratory axes, exactly,
///
///   dn/dt = M x n / I1 ,   dM/dt = G x n + delta (2 M x n + I1 W x n) ,   M.n = kappa - 2 I1 w .
///
/// The first term is a Lagrange top under the constant torque G x n; it has a closed form (the large flow). The term with delta
/// is a perturbation, which is smaller than the Earth's rate itself by about I1 |dn/dt| / kappa, the ratio of precession to
/// nutation. For a top that spins fast it is some 1e-7 of the gravity torque. With n held, the perturbation alone has an exact
/// flow too: a turn of M about n (the kick). To make delta small, w is chosen as the mean of W.n over the precession.
///
/// M along G determines the tilt, and so the rate of precession. The rounding of many thousand flows would change the tilt by as
/// many eps, of mostly one sign, and the phase of the precession with the square of their number. So this component is kept
/// apart, and the tilt is brought back to it after each flow.
///
/// The body turns at n x dn/dt + (w3 - W.n) n relative to the laboratory. A frame F is carried along n without rate along it.
/// The body is F turned about n by w3 t minus the integral of W.n. The large flow gives that integral, except for the part of n
/// along G, from the change of M: the integral of the part of n across G is -G x (change of M) / G^2.
#pragma once

#include "closed_form/complex.hpp"
#include "earthtop/closed_form/lagrange_top.hpp"
#include "earthtop/model/reduced_top.hpp"

namespace earthtop {

/// The attitude of the frame F and its rate, and the turn about n so far. All units are the model's.
template <class T>
struct TiltedTopState {
  Quaternion<T> q_GF;               ///< attitude of F relative to axes whose third one is along G
  Complex<T> across;                ///< rate w1 + i w2 at which n turns, in F
  T turn = T(0), turn_rest = T(0);  ///< minus the integral of W.n (rad), as the sum of two numbers
  T M_G = T(0), M_G_rest = T(0);    ///< M along G, as the sum of two numbers; the large flow keeps it
};

template <class T>
class TiltedTop {
 public:
  /// @param top  must be symmetric about body axis 3   @param W_L  the rate of the Earth
  TiltedTop(const Model<T>& model, const ReducedTop<T>& top, const NaturalRelease<T>& release, const Vec3<T>& W_L);

  const TiltedTopState<T>& start() const { return start_; }
  /// The period of the nutation that begins at the start; infinite where there is none.
  T nutation_period() const { return nutation_period_; }
  /// The fastest rate of the axis's motion: nutation and pendulum.
  T fast_rate() const;
  /// Roughly the rate at which the axis of a fast top precesses, G / kappa; infinite where kappa is 0.
  T precession_rate() const;
  /// Roughly the largest rate at which the kicks by themselves would turn the axis.
  T kick_rate() const { return kick_rate_; }
  T earth_rate() const { return norm(W_G_); }
  /// The largest rate at which the frame F turns.
  T frame_rate() const { return frame_rate_; }

  /// The large flow, exact, forward or backward in time.
  class Flow {
   public:
    Flow(const TiltedTop& top, const TiltedTopState<T>& from, ClosedFormSpan span = ClosedFormSpan::any);
    /// The state after the time t. Of the quaternions q and -q it takes the one closer to the start's, which is the continuous
    /// one if the frame has turned by less than half a turn.
    TiltedTopState<T> at(T t) const;

   private:
    const TiltedTop& top_;
    TiltedTopState<T> from_;
    LagrangeTop<T> closed_form_;
    Vec3<T> momentum_;
  };
  /// Moves a state by at most a few periods of the nutation.
  void flow_briefly(T t, TiltedTopState<T>& x) const {
    if (t != T(0)) x = Flow(*this, x, ClosedFormSpan::few_periods).at(t);
  }
  /// The kick: the effect of the perturbation in the time b while n is held.
  void kick(T b, TiltedTopState<T>& x) const;
  /// The effect of a further torque n x f in the time b while n is held.   @param f_F  f in the frame F
  void push(T b, const Vec3<T>& f_F, TiltedTopState<T>& x) const;
  /// The axes of F in the laboratory; the third is n.
  Mat3<T> rotation_to_laboratory(const TiltedTopState<T>& x) const { return rotation_matrix(q_LG_ * x.q_GF); }

  /// The top without the part w3 t of its turn about n, w3 being the rate along the axis at release: the body's attitude is
  /// q_LF steady_turn(2, w3, t), and `across` is the rate of n in that frame.
  struct Seen {
    Quaternion<T> q_LF;
    Complex<T> across;
    T spin_excess;  ///< rate of the body along n relative to the laboratory, less w3
  };
  Seen seen(const TiltedTopState<T>& x, T t) const;

 private:
  Vec3<T> momentum(const TiltedTopState<T>& x) const;
  T momentum_along_G(const Mat3<T>& R_GF, const Complex<T>& across) const;
  static void add(T change, T& sum, T& rest);
  void keep_momentum_along_G(TiltedTopState<T>& x) const;

  TiltedTopState<T> start_;
  Quaternion<T> q_LG_;
  Vec3<T> W_G_;
  T I1_ = T(1), kappa_ = T(0), G_ = T(0);
  T mean_ = T(0);              ///< w
  T spin_start_ = T(0);        ///< rate along n relative to inertial space, less w3 as given at release
  bool exact_turn_ = true;     ///< whether the integral of n across G is taken from the change of M
  SymmetricTop<T> effective_;  ///< the Lagrange top of the large flow; of its spin only kappa matters
  T effective_spin_ = T(0);
  T nutation_period_ = T(0), kick_rate_ = T(0), frame_rate_ = T(0);
};

extern template class TiltedTop<double>;
extern template class TiltedTop<float80>;

}  // namespace earthtop
