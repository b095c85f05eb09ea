// SPDX-License-Identifier: GPL-3.0-or-later
/// The Taylor series of any body's reference and deviation in body axes (drift_system.hpp), for a plain scene.
#pragma once

#include "drift/pivot/deviation_turn.hpp"
#include "earthtop/model/equations.hpp"
#include "integrate/inline_all.hpp"
#include "integrate/taylor/attitude_series.hpp"
#include "integrate/taylor/inverse_inertia.hpp"

namespace earthtop {

/// The series of the state: reference q_LB (4), w_IB_B (3); deviation w, y (3), p (3).
template <class T>
class GeneralDriftSeries {
 public:
  using State = std::array<T, 14>;

  explicit GeneralDriftSeries(const Model<T>& model) : model_(model), inverse_inertia_(model) {}

  void start(const State& x) {
    attitude_.start(load_quaternion(x, 0));
    turn_.start(x[7], load_vector(x, 8), model_.epsilon);
  }

  EARTHTOP_INLINE_ALL void extend(int k, const State& x, State& next) {
    const Quaternion<T> q = load_quaternion(x, 0);
    const Vec3<T> w_ref_B = load_vector(x, 4), y = load_vector(x, 8), p = load_vector(x, 11);
    const T w = x[7], epsilon = model_.epsilon;
    const Vec3<T> L_ref_B = times(model_.I_BP_B, w_ref_B), Dw_B = inverse_inertia_.times(p);
    attitude_.put_rate(first_, k, kRate, q, w_ref_B);
    attitude_.put_vectors(first_, k, kVectors, q);
    first_.put_cross(k, kEuler, L_ref_B, w_ref_B);
    first_.put_cross(k, kCarried, p, w_ref_B);
    first_.put_cross(k, kGyroscopic, Vec3<T>(L_ref_B + epsilon * p), Dw_B);
    first_.put_cross(k, kTurning, y, w_ref_B);
    DeviationTurn<T>::put(first_, k, kTurn, w, y);
    first_.convolve(k);

    // Vectors of the laboratory as seen from the reference body, and how the deviation's turn changes them.
    const Vec3<T> W_ref_B = attitude_.into_body(first_, kVectors, model_.W_IL_L_scaled);
    const Vec3<T> gravity_ref_B = attitude_.into_body(first_, kVectors, model_.apparent_gravity_L);
    const Mat3<T> M = turn_.matrix(first_, kTurn);
    for (int i = 0; i < 3; ++i) {
      second_.put_parallel(k, kTurnedRate + 3 * i, M.row(i), W_ref_B);
      second_.put_parallel(k, kTurnedGravity + 3 * i, M.row(i), gravity_ref_B);
    }
    second_.convolve(k);
    const auto turned = [&](int lane) {
      return Vec3<T>(second_.sum_of_three(lane), second_.sum_of_three(lane + 3), second_.sum_of_three(lane + 6));
    };
    const Vec3<T> d_B = Dw_B - W_ref_B - epsilon * turned(kTurnedRate);
    third_.put_scaled(k, kScalar, w, d_B);
    third_.put_cross(k, kVector, y, d_B);
    third_.put_parallel(k, kDot, y, d_B);
    third_.convolve(k);

    const T order = T(k + 1);
    const Quaternion<T> turn = attitude_.half_product(first_, kRate);
    next[0] = turn.w / order;
    store_vector(turn.v / order, next, 1);
    store_vector(inverse_inertia_.times(first_.cross(kEuler) + field_torque(model_.mass_moment_B, gravity_ref_B)) / order, next,
                 4);
    next[7] = (-epsilon * epsilon * third_.sum_of_three(kDot) / T(2)) / order;
    store_vector((first_.cross(kTurning) + (third_.vector(kScalar) + epsilon * third_.cross(kVector)) / T(2)) / order, next, 8);
    store_vector(
        (first_.cross(kCarried) + first_.cross(kGyroscopic) + field_torque(model_.mass_moment_B, turned(kTurnedGravity))) /
            order,
        next, 11);
  }

 private:
  static constexpr int kRate = 0, kVectors = AttitudeSeries<T>::kRateLanes, kEuler = kVectors + AttitudeSeries<T>::kVectorLanes,
                       kCarried = kEuler + 6, kGyroscopic = kCarried + 6, kTurning = kGyroscopic + 6, kTurn = kTurning + 6;
  static constexpr int kTurnedRate = 0, kTurnedGravity = 9;
  static constexpr int kScalar = 0, kVector = 3, kDot = 9;
  const Model<T>& model_;
  AttitudeSeries<T> attitude_;
  InverseInertia<T> inverse_inertia_;
  DeviationTurn<T> turn_;
  taylor::Products<T, kTurn + DeviationTurn<T>::kLanes> first_;
  taylor::Products<T, 18> second_;
  taylor::Products<T, 12> third_;
};

}  // namespace earthtop
