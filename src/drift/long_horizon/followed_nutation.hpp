// SPDX-License-Identifier: GPL-3.0-or-later
/// Both motions of a run by long_horizon for some nutations after one of their states, by Taylor series. A look by a step aside sets up
/// ten or more closed forms; looks that follow each other within a nutation share a step of the series.
#pragma once

#include <limits>
#include <optional>

#include "drift/pivot/reduced_drift_system.hpp"
#include "drift/spinless_pair_system.hpp"
#include "integrate/taylor/taylor_stepper.hpp"

namespace earthtop {

class FollowedNutation {
 public:
  using T = double;
  using Pair = SpinlessPair<T>;

  /// @param model  at the Earth's rate of the pairs; kept by reference   @param nutation_period  not infinite
  FollowedNutation(const Model<T>& model, const NaturalRelease<T>& release, T nutation_period)
      : model_(model),
        period_(nutation_period),
        system_(model, release),
        frame_(2, release.q_LB, release.w_XB_B[2]),
        series_(system_.series()) {
    scales_.include(system_.typical_state());
  }

  /// Whether the motion at this time is cheaper by going on than by a step aside.
  bool reaches(T t) const {
    constexpr T kApart = 1.5, kFarthest = 64;  // nutation periods: between two looks, and from the first of them on
    return begun_ && t - seen_ <= kApart * period_ && t - begin_ <= kFarthest * period_;
  }
  /// Begins anew. @param t  time of the pair
  void begin(T t, const Pair& pair) {
    begun_ = true, begin_ = seen_ = t;
    start_ = pair;
    stepper_.reset();  // looks that lie far apart need no series
  }
  /// Both motions at a time that `reaches` allows and that is not before the last one.
  Pair at(T t) {
    if (!stepper_) {
      const State x = state_of(start_);
      scales_.include(x);
      stepper_.emplace(kTolerance, scales_);
      stepper_->initialize(x, T(0));
    }
    State x;
    for (int steps = 0; stepper_->current_time() < t - begin_; ++steps) {
      if (steps == kMostSteps) {  // a motion that is not finite goes on by steps of 0
        x.fill(std::numeric_limits<T>::quiet_NaN());
        return pair_of(x);
      }
      stepper_->do_step(series_);
    }
    stepper_->state_after(t - begin_ - stepper_->previous_time(), x);
    seen_ = t;
    return pair_of(x);
  }

 private:
  using System = ReducedDriftSystem<T, Observer::laboratory>;
  using State = System::State;
  struct Integrated {
    using Shape = ReducedDriftShape;
    using Series = ReducedDriftSeries<T, Observer::laboratory>;
    static constexpr std::size_t kSize = Shape::kSize;
  };
  static constexpr T kTolerance = 1e-14;     // a hundredth of the least error of long_horizon, for an order or two more
  static constexpr int kMostSteps = 10'000;  // some ten are taken in a nutation

  /// The Earth's rate in the rotating motion's frame, divided by epsilon.
  Vec3<T> earth_rate_scaled(const Pair& p) const {
    const Quaternion<T> e = Quaternion<T>{p.e_w, Vec3<T>(model_.epsilon * p.y)}.normalized();
    return transposed_times(rotation_matrix(p.ref_q_LF * e), model_.W_IL_L_scaled);
  }
  State state_of(const Pair& p) const {
    const Mat3<T> R = rotation_matrix(p.ref_q_LF);
    const Vec3<T> W = earth_rate_scaled(p);
    const Complex<T> change = (T(1) / model_.epsilon) * (p.across + T(-1) * p.ref_across);
    State x;
    store_vector(Vec3<T>(R.col(2)), x, 0);
    store_vector(times(R, Vec3<T>(p.ref_across.re, p.ref_across.im, T(0))), x, 3);
    store_vector(Vec3<T>(R.col(0)), x, 6);
    x[9] = p.e_w;
    store_vector(times(R, p.y), x, 10);
    store_vector(times(R, Vec3<T>(change.re + W[0], change.im + W[1], T(0))), x, 13);
    return x;
  }
  Pair pair_of(const State& x) const {
    Pair p;
    p.ref_q_LF = frame_.frame(load_vector(x, 0), load_vector(x, 6));
    const Mat3<T> R = rotation_matrix(p.ref_q_LF);
    const Vec3<T> u = transposed_times(R, load_vector(x, 3)), V = transposed_times(R, load_vector(x, 13));
    p.ref_across = {u[0], u[1]};
    p.e_w = x[9];
    p.y = transposed_times(R, load_vector(x, 10));
    const Vec3<T> W = earth_rate_scaled(p);
    p.across = {u[0] + model_.epsilon * (V[0] - W[0]), u[1] + model_.epsilon * (V[1] - W[1])};
    p.spin_excess = model_.epsilon * (system_.constants().k - W[2]);
    return p;
  }

  const Model<T>& model_;
  T period_;
  System system_;
  SpinlessFrame<T> frame_;
  Integrated::Series series_;
  GroupScales<T, ReducedDriftShape> scales_;
  std::optional<taylor::TaylorStepper<T, Integrated>> stepper_;
  Pair start_;
  bool begun_ = false;
  T begin_ = T(0), seen_ = T(0);
};

}  // namespace earthtop
