/// Which of the two motions dry friction has brought to rest, and when.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/model/applied_motion.hpp"
#include "integrate/drive_options.hpp"

namespace earthtop {

/// A motion rests from when dry friction, stronger than every other torque on it, will have stopped it within 1e-8 of the time
/// since the release: the angle that it would still turn through is 1e-16 of the one behind it. Steps come that near in the
/// end, as each is limited to a part of the way.
template <class T>
class RestingMotions {
 public:
  bool any() const { return rests_[0] || rests_[1]; }
  bool rests(Prediction prediction) const { return rests_[index(prediction)]; }
  const std::vector<std::pair<Prediction, T>>& stops() const { return stops_; }

  /// A step that does not pass the corner of the friction, where the motion comes to rest or turns round: what estimates a
  /// step's error may miss a corner in its middle. Without end for a motion at rest, which sets out or stays.
  T longest_step(Prediction prediction, const Model<T>& model, T t, const Quaternion<T>& q_LB, const Vec3<T>& w_LB_B) const {
    constexpr double kOfTheWay = 0.9, kTurn = 1e-13;
    const T momentum = norm(Vec3<T>(times(model.I_BP_B, w_LB_B)));
    if (rests(prediction) || !(momentum > T(0))) return T(HUGE_VAL);
    const T other = other_torque(prediction, model, t, q_LB);
    const T least = model.applied.coulomb > other ? near(t) / T(4) : T(kTurn) * t;
    return std::max(T(kOfTheWay) * momentum / (model.applied.coulomb + other), least);
  }

  /// Whether a motion that moved until now comes to rest here; it is held from then on.
  bool comes(Prediction prediction, const Model<T>& model, T t, const Quaternion<T>& q_LB, const Vec3<T>& w_LB_B) {
    if (rests(prediction)) return false;
    const T spare = model.applied.coulomb - other_torque(prediction, model, t, q_LB);
    const T left = norm(Vec3<T>(times(model.I_BP_B, w_LB_B)));
    if (!(spare > T(0)) || left > spare * near(t)) return false;
    rests_[index(prediction)] = true;
    stops_.emplace_back(prediction, t);
    return true;
  }

 private:
  /// How near a stop is one: of the time since the release, and where that is next to nothing, of the steps there are.
  static T near(T t) { return std::max(T(1e-8) * t, T(64) * least_step<T>()); }

  /// What friction has to hold in a motion at rest.
  static T other_torque(Prediction prediction, const Model<T>& model, T t, const Quaternion<T>& q_LB) {
    const bool earth = prediction == Prediction::rotating;
    const Vec3<T> at_rest = Vec3<T>::Zero();
    const PivotField<T> field = pivot_field<SceneKind::full>(model, t);
    const Vec3<T> field_B = transposed_times(rotation_matrix(q_LB), earth ? field.rotating_L : field.reference_L);
    return norm(Vec3<T>(field_torque(model.mass_moment_B, field_B) + applied_torque_B(model, t, q_LB, at_rest, earth)));
  }
  static std::size_t index(Prediction prediction) { return prediction == Prediction::reference ? 0 : 1; }

  std::array<bool, 2> rests_ = {false, false};
  std::vector<std::pair<Prediction, T>> stops_;
};

}  // namespace earthtop
