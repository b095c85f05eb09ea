// SPDX-License-Identifier: GPL-3.0-or-later
/// Keeps track of which of the two motions dry friction has brought to rest, and when.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/model/applied_motion.hpp"
#include "earthtop/model/equations.hpp"
#include "integrate/drive_options.hpp"

namespace earthtop {

/// A motion is taken to be at rest as soon as dry friction is stronger than all other torques and will stop it within eps^(2/3) of
/// the time since the release, 4e-11 in double: the angle that it would still turn through is then eps^(4/3) of the angle behind it,
/// less than a drift of 1e-5 rad rounds. Steps do come that near, as each is limited to a part of the way that is left. The exact
/// time of the stop is found beside the integration.
template <class T>
class RestingMotions {
 public:
  struct Stop {
    Prediction prediction;
    T t;
    T slowing;  ///< how fast the size of the rate fell at the end
  };
  bool any() const { return rests_[0] || rests_[1]; }
  bool rests(Prediction prediction) const { return rests_[index(prediction)]; }
  const std::vector<Stop>& stops() const { return stops_; }
  /// The time from t to the stop of a motion that has come to rest; 0 if it has none.
  T time_left(Prediction prediction, T t) const {
    const auto stop = std::ranges::find(stops_, prediction, &Stop::prediction);
    return stop != stops_.end() ? std::max(T(0), T(stop->t - t)) : T(0);
  }

  /// The longest step that does not go beyond the point where the motion comes to rest or reverses. There the friction has a
  /// corner, which the estimate of a step's error may miss. There is no limit (infinity) for a motion at rest, which either
  /// starts or stays. A motion released at rest on the rotating Earth counts as such, although its rate has the rounding of the
  /// Earth's rate; any noticeable step leads out of that rounding.
  T longest_step(Prediction prediction, const Model<T>& model, T t, const Quaternion<T>& q_LB, const Vec3<T>& w_LB_B) const {
    constexpr double kOfTheWay = 0.9, kTurn = 1e-13;
    const T momentum = norm(Vec3<T>(times(model.I_BP_B, w_LB_B)));
    if (rests(prediction) || !(momentum > rounding(prediction, model, q_LB))) return T(HUGE_VAL);
    const T other = other_torque(prediction, model, t, q_LB);
    const T least = model.applied.coulomb > other ? near(t) / T(4) : T(kTurn) * t;
    return std::max(T(kOfTheWay) * momentum / (model.applied.coulomb + other), least);
  }

  /// Whether a motion that moved until now comes to rest here. If so, it is noted as resting from then on.
  bool comes(Prediction prediction, const Model<T>& model, T t, const Quaternion<T>& q_LB, const Vec3<T>& w_LB_B) {
    if (rests(prediction)) return false;
    const T spare = model.applied.coulomb - other_torque(prediction, model, t, q_LB);
    const T left = norm(Vec3<T>(times(model.I_BP_B, w_LB_B)));
    if (!(spare > T(0)) || left > spare * near(t)) return false;
    rests_[index(prediction)] = true;
    stops_.push_back(end_of_motion(prediction, model, t, q_LB, w_LB_B));
    return true;
  }

 private:
  /// The round-off of the momentum relative to the laboratory: for the rotating motion it is a difference in which the Earth's
  /// rate cancels.
  static T rounding(Prediction prediction, const Model<T>& model, const Quaternion<T>& q_LB) {
    if (prediction == Prediction::reference) return T(0);
    const Vec3<T> W_B = transposed_times(rotation_matrix(q_LB), model.W_IL_L);
    return T(8) * real::epsilon<T>() * norm(Vec3<T>(times(model.I_BP_B, W_B)));
  }
  /// The time before a stop from which a motion is taken to rest: a part of the time since the release or, where that is
  /// tiny, a few of the shortest steps.
  T near(T t) const { return std::max(share_ * t, T(64) * least_step<T>()); }

  /// d(w_LB)/dt at a given attitude.
  static Vec3<T> slowing(Prediction prediction, const Model<T>& model, T t, const Quaternion<T>& q_LB, const Vec3<T>& w_LB_B) {
    const PivotField<T> field = pivot_field<SceneKind::full>(model, t);
    const bool earth = prediction == Prediction::rotating;
    const Vec3<T> friction = times(model.I_BP_B_inverse, applied_torque_B(model, t, q_LB, w_LB_B, earth));
    if (!earth) return body_equation<false, SceneKind::full>(model, {q_LB, w_LB_B}, field.reference_L).m + friction;
    const Vec3<T> W_B = transposed_times(rotation_matrix(q_LB), model.W_IL_L);
    const Motion<T> motion{q_LB, w_LB_B + W_B};
    return body_equation<true, SceneKind::full>(model, motion, field.rotating_L).m + w_LB_B.cross(W_B) + friction;
  }

  /// Follows the motion to its stop by Runge and Kutta's method of order 4, in steps of a fifth of the way that is left. The
  /// attitude does not change on that way, but the direction of the rate may. The error of a step is about 1e-5 of its length,
  /// which is 1e-13 of the time since the release. The last millionth of the way is taken as a straight line.
  static Stop end_of_motion(Prediction prediction, const Model<T>& model, T t, const Quaternion<T>& q_LB, Vec3<T> w) {
    constexpr double kStep = 0.2, kEnd = 1e-6;
    constexpr int kMostSteps = 1000;
    const T begin = norm(w);
    if (!(begin > T(0))) return {prediction, t, T(0)};
    const auto rate = [&](const Vec3<T>& at) { return slowing(prediction, model, t, q_LB, at); };
    T gone = T(0);
    for (int i = 0; i < kMostSteps && norm(w) > T(kEnd) * begin; ++i) {
      const Vec3<T> k1 = rate(w);
      const T h = T(kStep) * norm(w) / norm(k1);
      if (!real::isfinite(h)) break;
      const Vec3<T> k2 = rate(Vec3<T>(w + (h / T(2)) * k1)), k3 = rate(Vec3<T>(w + (h / T(2)) * k2));
      const Vec3<T> k4 = rate(Vec3<T>(w + h * k3));
      w += (h / T(6)) * (k1 + T(2) * k2 + T(2) * k3 + k4);
      gone += h;
    }
    const T fall = -rate(w).dot(w) / norm(w);
    if (!(fall > T(0))) return {prediction, t, T(0)};
    return {prediction, t + gone + norm(w) / fall, fall};
  }

  /// The size of the torque that friction has to hold when the motion is at rest.
  static T other_torque(Prediction prediction, const Model<T>& model, T t, const Quaternion<T>& q_LB) {
    const bool earth = prediction == Prediction::rotating;
    const Vec3<T> at_rest = Vec3<T>::Zero();
    const PivotField<T> field = pivot_field<SceneKind::full>(model, t);
    const Vec3<T> field_B = transposed_times(rotation_matrix(q_LB), earth ? field.rotating_L : field.reference_L);
    return norm(Vec3<T>(field_torque(model.mass_moment_B, field_B) + applied_torque_B(model, t, q_LB, at_rest, earth)));
  }
  static std::size_t index(Prediction prediction) { return prediction == Prediction::reference ? 0 : 1; }

  // Not a static number: that would be computed where a host loads the library, in whatever state its processor is then.
  T share_ = real::pow(real::epsilon<T>(), T(2) / T(3));
  std::array<bool, 2> rests_ = {false, false};
  std::vector<Stop> stops_;
};

}  // namespace earthtop
