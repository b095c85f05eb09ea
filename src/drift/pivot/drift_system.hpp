// SPDX-License-Identifier: GPL-3.0-or-later
/// The right-hand side of a drift integration, for any body. It works on one state vector:
///   [0,7) non-rotating reference   7 deviation w   [8,11) y   [11,14) p   [14,21) rotating motion, where it is integrated
/// With a rotor or moving masses in the body (rotor.hpp) the rotating motion is never integrated, and there are
///   14 deviation of h   15 h of the reference   16 its rotor's angle minus that of a steady spin   17 deviation of the angle
#pragma once

#include <array>
#include <optional>

#include "drift/deviation_state.hpp"
#include "drift/pivot/record_drift.hpp"
#include "drift/watch/resting_motions.hpp"
#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/model/applied_motion.hpp"
#include "integrate/drive_problem.hpp"
#include "integrate/group_norms.hpp"
#include "integrate/motion_system.hpp"
#include "integrate/taylor/recorded_series.hpp"

namespace earthtop {

namespace drift_state {

constexpr std::size_t kReference = 0;
constexpr std::size_t kDeviation = 7;
constexpr std::size_t kRotating = 14;
constexpr std::size_t kMomentumDeviation = 14, kMomentum = 15, kAngle = 16, kAngleDeviation = 17;  // of a rotor

template <class T, std::size_t N>
Motion<T> load_motion(const std::array<T, N>& x, std::size_t at) {
  return {{x[at], Vec3<T>(x[at + 1], x[at + 2], x[at + 3])}, Vec3<T>(x[at + 4], x[at + 5], x[at + 6])};
}
template <class T, std::size_t N>
void store_motion(const Motion<T>& motion, std::array<T, N>& x, std::size_t at) {
  x[at] = motion.q.w;
  for (std::size_t i = 0; i < 3; ++i) x[at + 1 + i] = motion.q.v[static_cast<int>(i)];
  for (std::size_t i = 0; i < 3; ++i) x[at + 4 + i] = motion.m[static_cast<int>(i)];
}
template <class T, std::size_t N>
Deviation<T> load_deviation(const std::array<T, N>& x) {
  const Motion<T> packed = load_motion(x, kDeviation);
  return {packed.q.w, packed.q.v, packed.m};
}
template <class T, std::size_t N>
void store_deviation(const Deviation<T>& deviation, std::array<T, N>& x) {
  store_motion<T>({{deviation.w, deviation.y}, deviation.p}, x, kDeviation);
}

}  // namespace drift_state

/// The longest time between two states that are seen. Both motions may turn at the fastest rate, and the angle between them must change
/// by less than half a turn.
template <class T>
T longest_unseen_step(const DriftProblem<T>& problem) {
  return T(1.5) / problem.fastest_rate;
}

/// The shape of a state: the reference's attitude and rate, the deviation, and where it is integrated the rotating motion, or what is
/// said of a rotor.
template <RotatingMotion R, bool kRotor = false>
struct DriftShape {
  static_assert(R == RotatingMotion::composed || !kRotor);
  static constexpr std::size_t kSize = R == RotatingMotion::integrated ? 21 : kRotor ? 18 : 14;
  /// Attitudes and rates are measured against their own size. The vectors y and p of the deviation are one group: where one of
  /// them vanishes, as that of the rates does at a pole, its round-off is that of the other. As the deviation starts from zero,
  /// its size has a floor.
  static constexpr auto groups() {
    constexpr std::array<ComponentGroup, 6> all{
        {{0, 4, 1.0}, {4, 3, 1e-3}, {7, 1, 1.0}, {8, 6, 1e-5}, {14, 4, 1.0}, {18, 3, 1e-3}}};
    if constexpr (R == RotatingMotion::integrated)
      return all;
    else if constexpr (kRotor)
      return std::array<ComponentGroup, 7>{{all[0], all[1], all[2], {8, 7, 1e-5}, {15, 1, 1e-3}, {16, 1, 2.0}, {17, 1, 2.0}}};
    else
      return std::array<ComponentGroup, 4>{all[0], all[1], all[2], all[3]};
  }
};

/// The base class that names a system's Taylor series. There is one only where the rotating motion is composed.
template <class T, RotatingMotion R, bool kRotor>
using DriftSeriesOf = std::conditional_t<R == RotatingMotion::composed,
                                         WithSeries<RecordedSeries<T, DriftShape<R, kRotor>::kSize>>, WithoutSeries>;

/// @tparam O  the observer whose equations are integrated; known at compile time, so that the right-hand side has no branch
/// @tparam R  whether the rotating motion is integrated too, or composed from the reference and the deviation
template <class T, Observer O, SceneKind K, RotatingMotion R>
class DriftSystem : public DriftSeriesOf<T, R, K == SceneKind::gyrostat> {
 public:
  static constexpr bool kIntegrated = R == RotatingMotion::integrated, kGyrostat = K == SceneKind::gyrostat;
  static constexpr bool kSettles = O == Observer::body && K == SceneKind::full && kIntegrated;  ///< whether motions can stop
  static constexpr bool kBoundOnly = !kIntegrated;  ///< used only by the second integration of a run, and by the series
  using Shape = DriftShape<R, kGyrostat>;
  static constexpr std::size_t kSize = Shape::kSize;
  using State = std::array<T, kSize>;
  explicit DriftSystem(const Model<T>& model) : model_(model), in_time_(model) {}

  EARTHTOP_INLINE_ALL void operator()(const State& x, State& dxdt, T t) const {
    using namespace drift_state;
    const Model<T>& model = in_time_.at(t);
    const Motion<T> reference = load_motion(x, kReference);
    const Deviation<T> deviation = load_deviation(x);
    const PivotField<T> field = pivot_field<K>(model, t);
    const auto inside = inside_both(x, t, reference, deviation);
    const auto inside_reference = of_reference(inside);
    Motion<T> reference_rate, rotating_rate;
    Deviation<T> deviation_rate;
    if constexpr (O == Observer::laboratory) {
      if constexpr (kIntegrated) {
        const Motion<T> rotating = load_motion(x, kRotating);
        const Vec3<T> torque_L = non_inertial_torque<K>(model, rotating);
        rotating_rate = laboratory_equation(model, rotating, field.rotating_L, torque_L);
      }
      const Vec3<T> no_torque = Vec3<T>::Zero();
      reference_rate = laboratory_equation(model, reference, field.reference_L, no_torque, inside_reference);
      deviation_rate = laboratory_deviation_equation<K>(model, reference, deviation, field, inside);
    } else if constexpr (O == Observer::body) {
      if constexpr (kIntegrated) rotating_rate = body_equation<true, K>(model, load_motion(x, kRotating), field.rotating_L);
      reference_rate = body_equation<false, K>(model, reference, field.reference_L, inside_reference);
      deviation_rate = body_deviation_equation<K>(model, reference, deviation, field, inside);
    } else {
      const LaboratoryTurn<T> turn = laboratory_turn(model, t);
      const Mat3<T> R_NL = rotation_matrix(turn.quaternion(model.epsilon));
      const Mat3<T> unturned = Mat3<T>::Identity();
      if constexpr (kIntegrated)
        rotating_rate = inertial_equation<true, K>(model, load_motion(x, kRotating), field.rotating_L, R_NL);
      reference_rate = inertial_equation<false, K>(model, reference, field.reference_L, unturned, inside_reference);
      deviation_rate = inertial_deviation_equation<K>(model, reference, deviation, field, turn, inside);
    }
    if constexpr (K != SceneKind::plain)
      if (model_.applied.any) add_applied_torques(x, t, reference_rate, deviation_rate, rotating_rate);
    if constexpr (kSettles)
      if (rest_.any()) hold(x, t, reference_rate, deviation_rate, rotating_rate);
    if constexpr (kIntegrated) store_motion(rotating_rate, dxdt, kRotating);
    store_motion(reference_rate, dxdt, kReference);
    store_deviation(deviation_rate, dxdt);
    if constexpr (kGyrostat) {
      dxdt[kMomentum] = inside.torque.ref;
      dxdt[kMomentumDeviation] = inside.torque.diff;
      dxdt[kAngle] = inside.spin.ref - model_.rotor.spin;
      dxdt[kAngleDeviation] = inside.spin.diff;
      if constexpr (O == Observer::laboratory)
        if (!model.rotor.driven) dxdt[kMomentumDeviation] += laboratory_torque_on_rotor(model, reference, deviation, inside);
    }
  }

  auto series() const {
    return RecordedSeries<T, kSize>([this](const State& x, T t) { return record_drift<T>(model_, O, x, t); });
  }

  /// The state at release, where both motions have the same attitude and the same rates of the kind that the release names.
  State initial_state(const NaturalRelease<T>& release) const {
    const Quaternion<T>& q_LB = release.q_LB;
    const Vec3<T>& w_XB_B = release.w_XB_B;
    const Mat3<T> R_LB = rotation_matrix(q_LB);
    const Vec3<T> W_B_scaled = R_LB.transpose() * model_.W_IL_L_scaled;
    const Vec3<T> W_B = model_.epsilon * W_B_scaled;
    const bool inertial_rates = release.X == RatesRelativeTo::inertial;
    // The rates of the rotating body relative to L and to I, and their deviations over epsilon, all from the given rates.
    Vec3<T> w_LB_B = inertial_rates ? Vec3<T>(w_XB_B - W_B) : w_XB_B;
    Vec3<T> w_IB_B = inertial_rates ? w_XB_B : Vec3<T>(w_XB_B + W_B);
    const Vec3<T> zero = Vec3<T>::Zero();
    Vec3<T> Dw_LB_B = inertial_rates ? Vec3<T>(-W_B_scaled) : zero;
    Vec3<T> Dw_IB_B = inertial_rates ? zero : W_B_scaled;
    if (model_.journey.has_still_reference()) {
      const Vec3<T> change_B = rate_change_at_release(model_, release);
      for (Vec3<T>* difference : {&Dw_LB_B, &Dw_IB_B}) *difference += change_B;
      for (Vec3<T>* rate : {&w_LB_B, &w_IB_B}) *rate += model_.epsilon * change_B;
    }
    State x;
    const auto store = [&](const Vec3<T>& rotating, const Vec3<T>& reference, const Vec3<T>& deviation) {
      if constexpr (kIntegrated) drift_state::store_motion<T>({q_LB, rotating}, x, drift_state::kRotating);
      drift_state::store_motion<T>({q_LB, reference}, x, drift_state::kReference);
      drift_state::store_deviation<T>({T(1), zero, deviation}, x);
    };
    // The rotor turns at the same rate relative to the body in both motions.
    const Vec3<T>& Dw_B = O == Observer::laboratory ? Dw_LB_B : Dw_IB_B;
    Vec3<T> reference_B = model_.I_BP_B * w_XB_B, deviation_B = model_.I_BP_B * Dw_B;
    if constexpr (kGyrostat) {
      const Rotor<T>& rotor = model_.rotor;
      // A driven rotor has the momentum that its motor gives it, which is no variable.
      x[drift_state::kMomentum] = rotor.axial * (rotor.driven ? rotor.spin : T(rotor.axis_B.dot(w_XB_B) + rotor.spin));
      x[drift_state::kAngle] = x[drift_state::kAngleDeviation] = T(0);
      x[drift_state::kMomentumDeviation] = rotor.driven ? T(0) : T(rotor.axial * rotor.axis_B.dot(Dw_B));
      reference_B += x[drift_state::kMomentum] * rotor.axis_B;
      deviation_B += x[drift_state::kMomentumDeviation] * rotor.axis_B;
      if (model_.masses.any()) reference_B += model_.masses.at_release.momentum;
    }
    if constexpr (O == Observer::laboratory)
      store(R_LB * (model_.I_BP_B * w_LB_B), R_LB * reference_B, R_LB * deviation_B);
    else if constexpr (O == Observer::body)
      store(w_IB_B, w_XB_B, deviation_B);
    else
      store(R_LB * (model_.I_BP_B * w_IB_B), R_LB * reference_B, R_LB * deviation_B);
    return x;
  }

  /// The state in the variables that all observers share, with rates in natural units; `t_s` is left to the caller.
  DriftState<T> shared_state(const State& x, T t) const { return seen_from_journey(model_, state_in_A(x, t), t); }
  /// The same in the axes of the integration, which differ from the laboratory's on a journey.
  DriftState<T> state_in_A(const State& x, T t) const {
    using namespace drift_state;
    const Motion<T> reference = load_motion(x, kReference);
    const Deviation<T> deviation = load_deviation(x);
    const Model<T>& model = in_time_.at(t);
    const auto inside = inside_both(x, t, reference, deviation);
    const Motion<T> rotating = rotating_motion(model, x, reference, deviation, inside);
    const auto body_rate = [&](const Motion<T>& m) {
      Vec3<T> momentum_B = transposed_times(rotation_matrix(m.q), m.m);
      if constexpr (kGyrostat) momentum_B -= &m == &reference ? inside.reference.momentum_B : inside.rotating_B;
      return times(model.I_BP_B_inverse, momentum_B);
    };
    const auto earth_rate = [&](const Quaternion<T>& q_LB) { return transposed_times(rotation_matrix(q_LB), model_.W_IL_L); };
    DriftState<T> s = deviation_in_A(x, t);
    s.q_LB = rotating.q;
    if constexpr (O == Observer::laboratory) {
      s.w_LB_B = body_rate(rotating);
      s.ref_w_LB_B = body_rate(reference);
    } else if constexpr (O == Observer::body) {
      s.w_LB_B = rotating.m - earth_rate(s.q_LB);
      s.ref_w_LB_B = reference.m;
    } else {
      s.q_LB = laboratory_turn(model_, t).quaternion(model_.epsilon).conjugate() * rotating.q;
      s.w_LB_B = body_rate(rotating) - earth_rate(s.q_LB);
      s.ref_w_LB_B = body_rate(reference);
    }
    return s;
  }

  /// Whether a rotor turns in the body, and not only masses move in it.
  bool has_rotor() const requires(kGyrostat) { return model_.rotor.axial > T(0); }
  /// The rotor in both motions, with rates in natural units; none where there is no rotor.
  std::optional<RotorState<T>> rotor_state(const State& x, T t) const requires(kGyrostat) {
    if (!has_rotor()) return std::nullopt;
    const auto inside = inside_both(x, t, drift_state::load_motion(x, drift_state::kReference), drift_state::load_deviation(x));
    const T angle = model_.rotor.spin * t + x[drift_state::kAngle], difference = x[drift_state::kAngleDeviation];
    return RotorState<T>{inside.spin.rot, inside.spin.ref, inside.spin.diff,   angle + model_.epsilon * difference,
                         angle,           difference,      model_.rotor.axis_B};
  }

  /// The part of the shared state that the drift is measured from: `ref_q_LB`, `e_w`, `e_v_scaled` and `epsilon`. It is cheap.
  DriftState<T> deviation_state(const State& x, T t) const { return deviation_from_journey(model_, deviation_in_A(x, t), t); }
  DriftState<T> deviation_in_A(const State& x, T t) const {
    const Quaternion<T> ref_q = drift_state::load_motion(x, drift_state::kReference).q;
    DriftState<T> s = seen_from_laboratory<O>(model_, ref_q, drift_state::load_deviation(x), t);
    if constexpr (kGyrostat) s.watched_axis_B = model_.rotor.axis_B;
    return s;
  }
  /// Called after every step: if dry friction has brought a motion to rest, it is held there from then on.
  void settle(State& x, T t) requires kSettles {
    if (model_.applied.coulomb == T(0)) return;
    Motion<T> reference = drift_state::load_motion(x, drift_state::kReference);
    Motion<T> rotating = drift_state::load_motion(x, drift_state::kRotating);
    Deviation<T> deviation = drift_state::load_deviation(x);
    const T epsilon = model_.epsilon;
    const Vec3<T> w_ref_B = reference.m;
    const bool reference_stops = rest_.comes(Prediction::reference, model_, t, reference.q, reference.m);
    const Vec3<T> W_B = transposed_times(rotation_matrix(rotating.q), model_.W_IL_L);
    const bool rotating_stops = rest_.comes(Prediction::rotating, model_, t, rotating.q, Vec3<T>(rotating.m - W_B));
    if (!reference_stops && !rotating_stops) return;
    // A motion that is held before its stop misses half its rate times the time left. Of one motion that is nothing, but of the
    // drift, which is the difference of the two, it may be as large a share as the time left is of the time behind.
    Vec3<T> turn_scaled;
    if (reference_stops && rotating_stops) {
      const Vec3<T> Dw_scaled = times(model_.I_BP_B_inverse, deviation.p) - earth_rate_scaled(state_in_A(x, t));
      const T square = w_ref_B.dot(w_ref_B);
      turn_scaled = Dw_scaled;  // and the time left is longer by that share by which the rate is larger
      if (square > T(0)) turn_scaled += (w_ref_B.dot(Dw_scaled) / square) * w_ref_B;
      turn_scaled *= rest_.time_left(Prediction::reference, t) / T(2);
    } else if (reference_stops) {
      turn_scaled = -rest_.time_left(Prediction::reference, t) / (T(2) * epsilon) * w_ref_B;
    } else {
      turn_scaled = rest_.time_left(Prediction::rotating, t) / (T(2) * epsilon) * Vec3<T>(rotating.m - W_B);
    }
    if (reference_stops) {
      deviation.p += times<T>(model_.I_BP_B, reference.m / epsilon);  // the rotating motion's rate stays as it is
      reference.m = Vec3<T>::Zero();
    }
    if (rotating_stops) {
      deviation.p = times<T>(model_.I_BP_B, earth_rate_scaled(state_in_A(x, t)) - reference.m / epsilon);
      rotating.m = W_B;
    }
    const Vec3<T> y = deviation.y;
    deviation.y += (deviation.w * turn_scaled + epsilon * y.cross(turn_scaled)) / T(2);
    deviation.w -= epsilon * epsilon * y.dot(turn_scaled) / T(2);
    drift_state::store_motion(reference, x, drift_state::kReference);
    drift_state::store_motion(rotating, x, drift_state::kRotating);
    drift_state::store_deviation(deviation, x);
  }
  T longest_step(const State& x, T t) const requires kSettles {
    if (model_.applied.coulomb == T(0)) return T(HUGE_VAL);
    const Motion<T> reference = drift_state::load_motion(x, drift_state::kReference);
    const Motion<T> rotating = drift_state::load_motion(x, drift_state::kRotating);
    const Vec3<T> w_LB_B = rotating.m - transposed_times(rotation_matrix(rotating.q), model_.W_IL_L);
    return std::min(rest_.longest_step(Prediction::reference, model_, t, reference.q, reference.m),
                    rest_.longest_step(Prediction::rotating, model_, t, rotating.q, w_LB_B));
  }
  const std::vector<typename RestingMotions<T>::Stop>& stops() const { return rest_.stops(); }

  /// Called after every step. There is nothing to do: the attitude quaternions are integrated, and so are continuous.
  void follow(const State&) {}

 private:
  /// What turns inside the body in both motions.
  auto inside_both([[maybe_unused]] const State& x, [[maybe_unused]] T t, [[maybe_unused]] const Motion<T>& reference,
                   [[maybe_unused]] const Deviation<T>& deviation) const {
    if constexpr (kGyrostat) {
      const Mat3<T>& I_inverse = in_time_.at(t).I_BP_B_inverse;
      const Mat3<T> R_ref = rotation_matrix(reference.q);
      const auto rate = [&](const Vec3<T>& momentum_B) -> Vec3<T> {
        if constexpr (O == Observer::body)
          return reference.m;
        else
          return times<T>(I_inverse, transposed_times(R_ref, reference.m) - momentum_B);
      };
      const auto difference = [&](const Vec3<T>& momentum_B_scaled) -> Vec3<T> {
        const Vec3<T> p_B = O == Observer::body ? deviation.p : Vec3<T>(transposed_times(R_ref, deviation.p));
        return times<T>(I_inverse, p_B - momentum_B_scaled);
      };
      const auto h = Paired<T>::apart(x[drift_state::kMomentum], x[drift_state::kMomentumDeviation], model_.epsilon);
      return rotor_inside_both(model_.rotor, h, model_.epsilon, t, in_time_.masses_at(t), rate, difference);
    } else {
      return NothingInside{};
    }
  }
  static NothingInside of_reference(const NothingInside& nothing) { return nothing; }
  static const RotorInside<T>& of_reference(const RotorInsideBoth<T>& both) { return both.reference; }

  /// The torques of [F] on the rotor alone about its axis, over epsilon. Its centre, which is carried with the body, gives none.
  T laboratory_torque_on_rotor(const Model<T>& model, const Motion<T>& reference, const Deviation<T>& deviation,
                               const RotorInsideBoth<T>& inside) const {
    const Mat3<T> R_ref = rotation_matrix(reference.q);
    const Vec3<T> W_B_scaled = earth_rate_in_body_scaled(model, R_ref, deviation);
    const Vec3<T> momentum_B = transposed_times(R_ref, Vec3<T>(reference.m + model.epsilon * deviation.p));
    const Vec3<T> w_LB_B = times<T>(model.I_BP_B_inverse, momentum_B - inside.rotating_B);
    const Mat3<T> J_B = velocity_moment(model.rotor.S_B, w_LB_B) + spin_velocity_moment(model.rotor, inside.spin.rot);
    const Vec3<T> W_B = model.epsilon * W_B_scaled;
    return model.rotor.axis_B.dot(laboratory_torque<K>(model.weights, W_B, W_B_scaled, J_B, model.rotor.S_B));
  }

  template <class Inside>
  Motion<T> rotating_motion(const Model<T>& model, const State& x, const Motion<T>& reference, const Deviation<T>& deviation,
                            const Inside& inside) const {
    const T epsilon = model.epsilon;
    const Quaternion<T> e{deviation.w, epsilon * deviation.y};
    if constexpr (kIntegrated) {
      return drift_state::load_motion(x, drift_state::kRotating);
    } else if constexpr (O == Observer::body) {
      return {reference.q * e, reference.m + epsilon * times<T>(model.I_BP_B_inverse, without_difference(deviation.p, inside))};
    } else {
      return {e * reference.q, times(rotation_matrix(e), Vec3<T>(reference.m + epsilon * deviation.p))};
    }
  }

  /// Adds the applied torques to the time derivatives of the three rate variables.
  [[gnu::noinline]] void add_applied_torques(const State& x, T t, Motion<T>& reference_rate, Deviation<T>& deviation_rate,
                                             Motion<T>& rotating_rate) const {
    const Model<T>& model = in_time_.at(t);
    const Motion<T> reference = drift_state::load_motion(x, drift_state::kReference);
    const Mat3<T> R_ref = rotation_matrix(reference.q);  // the same in L and in N, which is parallel to the reference's L
    const DriftState<T> s = state_in_A(x, t);
    const Deviation<T> deviation = drift_state::load_deviation(x);
    const Vec3<T> p_B = O == Observer::body ? deviation.p : Vec3<T>(transposed_times(R_ref, deviation.p));
    Vec3<T> Dw_IB_B_scaled = times<T>(model.I_BP_B_inverse, without_difference(p_B, inside_both(x, t, reference, deviation)));
    if constexpr (O == Observer::laboratory) Dw_IB_B_scaled += earth_rate_scaled(s);
    const Vec3<Paired<T>> torques = applied_torques_B(model, t, s.ref_q_LB, s.ref_w_LB_B, s.e_w, s.e_v_scaled, Dw_IB_B_scaled);
    const Vec3<T> on_reference = parts(torques, &Paired<T>::ref), difference = parts(torques, &Paired<T>::diff);
    if constexpr (O == Observer::body) {
      reference_rate.m += times(model.I_BP_B_inverse, on_reference);
      deviation_rate.p += difference;
    } else {
      reference_rate.m += times(R_ref, on_reference);
      deviation_rate.p += times(R_ref, difference);
    }
    if constexpr (kIntegrated) {
      const Vec3<T> on_rotating = applied_torque_B(model, t, s.q_LB, s.w_LB_B, true);
      const Mat3<T> R_rot = rotation_matrix(drift_state::load_motion(x, drift_state::kRotating).q);
      rotating_rate.m += O == Observer::body ? times(model.I_BP_B_inverse, on_rotating) : times(R_rot, on_rotating);
    }
  }
  /// The Earth's rate in the rotating body's axes, divided by epsilon.
  Vec3<T> earth_rate_scaled(const DriftState<T>& s) const {
    const Vec3<T> W_ref_B = transposed_times(rotation_matrix(s.ref_q_LB), model_.W_IL_L_scaled);
    return W_ref_B + model_.epsilon * turn_back_minus_one_scaled(s.e_w, s.e_v_scaled, model_.epsilon, W_ref_B);
  }

  /// Changes the time derivatives where one motion rests, or both. A motion at rest has none, and the deviation changes with
  /// the other motion alone.
  [[gnu::noinline]] void hold(const State& x, T t, Motion<T>& reference_rate, Deviation<T>& deviation_rate,
                              Motion<T>& rotating_rate) const {
    const Motion<T> still{Quaternion<T>{T(0), Vec3<T>::Zero()}, Vec3<T>::Zero()};
    const T epsilon = model_.epsilon;
    const bool reference_rests = rest_.rests(Prediction::reference), rotating_rests = rest_.rests(Prediction::rotating);
    if (reference_rests && !rotating_rests) {
      const Motion<T> reference = drift_state::load_motion(x, drift_state::kReference);
      const Deviation<T> deviation = drift_state::load_deviation(x);
      const Motion<T> moving{reference.q * Quaternion<T>{deviation.w, epsilon * deviation.y},
                             epsilon * times(model_.I_BP_B_inverse, deviation.p)};
      const Vec3<T> w_LB_B = moving.m - transposed_times(rotation_matrix(moving.q), model_.W_IL_L);
      const Vec3<T> dw = body_equation<true, K>(model_, moving, pivot_field<K>(model_, t).rotating_L).m +
                         times(model_.I_BP_B_inverse, applied_torque_B(model_, t, moving.q, w_LB_B, true));
      deviation_rate.p = times<T>(model_.I_BP_B, dw / epsilon);
    } else if (rotating_rests && !reference_rests) {
      // The rotating motion rests. The moving one is taken by itself, as the torques on a pair would leave dry friction out.
      const Motion<T> reference = drift_state::load_motion(x, drift_state::kReference);
      reference_rate.m = body_equation<false, K>(model_, reference, pivot_field<K>(model_, t).reference_L).m +
                         times(model_.I_BP_B_inverse, applied_torque_B(model_, t, reference.q, reference.m, false));
      deviation_rate.p = -times<T>(model_.I_BP_B, reference_rate.m / epsilon);
    } else {
      deviation_rate = {T(0), Vec3<T>::Zero(), Vec3<T>::Zero()};
    }
    if (reference_rests) reference_rate = still;
    if (rotating_rests) rotating_rate = still;
  }

  const Model<T>& model_;
  ModelOfKind<K, T> in_time_;
  RestingMotions<T> rest_;
};

}  // namespace earthtop
