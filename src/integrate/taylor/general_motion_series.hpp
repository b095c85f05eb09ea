// SPDX-License-Identifier: GPL-3.0-or-later
/// The Taylor series of any body's motion in body axes (equations.hpp), for a plain scene.
#pragma once

#include "earthtop/model/equations.hpp"
#include "integrate/inline_all.hpp"
#include "integrate/taylor/attitude_series.hpp"
#include "integrate/taylor/inverse_inertia.hpp"

namespace earthtop {

/// The series of the state q_LB (4), w_IB_B (3).
template <class T>
class GeneralMotionSeries {
 public:
  using State = std::array<T, 7>;

  explicit GeneralMotionSeries(const Model<T>& model) : model_(model), inverse_inertia_(model) {}

  void start(const State& x) { attitude_.start(load_quaternion(x, 0)); }
  EARTHTOP_INLINE_ALL void extend(int k, const State& x, State& next) {
    const Quaternion<T> q = load_quaternion(x, 0);
    const Vec3<T> w_IB_B = load_vector(x, 4);
    attitude_.put_rate(products_, k, kRate, q, w_IB_B);
    attitude_.put_up(products_, k, kUp, q);
    products_.put_cross(k, kEuler, times(model_.I_BP_B, w_IB_B), w_IB_B);
    products_.convolve(k);
    const T order = T(k + 1);
    // dq/dt = (q w_IB_B - W_L q) / 2
    const Quaternion<T> turn = attitude_.half_product(products_, kRate);
    const Vec3<T> h = model_.W_IL_L / T(2);
    next[0] = (turn.w + h.dot(q.v)) / order;
    store_vector((turn.v - q.w * h - h.cross(q.v)) / order, next, 1);
    const Vec3<T> gravity_B = model_.apparent_gravity_L[2] * attitude_.up(products_, k, kUp);
    const Vec3<T> torque_B = products_.cross(kEuler) + field_torque(model_.mass_moment_B, gravity_B);
    store_vector(inverse_inertia_.times(torque_B) / order, next, 4);
  }

 private:
  static constexpr int kRate = 0, kUp = AttitudeSeries<T>::kRateLanes, kEuler = kUp + AttitudeSeries<T>::kUpLanes;
  const Model<T>& model_;
  AttitudeSeries<T> attitude_;
  InverseInertia<T> inverse_inertia_;
  taylor::Products<T, kEuler + 6> products_;
};

}  // namespace earthtop
