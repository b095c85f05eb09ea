/// The right-hand side of a drift integration on one state vector:
///   [0,7) non-rotating reference   7 deviation w   [8,11) y   [11,14) p   [14,21) rotating motion, where it is integrated
#pragma once

#include <array>

#include "drift/deviation_state.hpp"
#include "drift/taylor/general_drift_series.hpp"
#include "earthtop/drift/drift_integration.hpp"
#include "integrate/drive_problem.hpp"
#include "integrate/group_norms.hpp"
#include "integrate/motion_system.hpp"

namespace earthtop {

namespace drift_state {

constexpr std::size_t kReference = 0;
constexpr std::size_t kDeviation = 7;
constexpr std::size_t kRotating = 14;

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

/// @tparam O  whose equations; fixed at compile time, so that the right-hand side has no branch.
/// @tparam R  whether the rotating motion is integrated too, or composed from the reference and the deviation
template <class T, Observer O, SceneKind K, RotatingMotion R>
class DriftSystem : public std::conditional_t<O == Observer::body && K == SceneKind::plain && R == RotatingMotion::composed,
                                              WithSeries<GeneralDriftSeries<T>>, WithoutSeries> {
 public:
  static constexpr bool kIntegrated = R == RotatingMotion::integrated;
  static constexpr bool kBoundOnly = !kIntegrated;  ///< made for the second integration of a run, and for the series
  static constexpr std::size_t kSize = kIntegrated ? 21 : 14;
  using State = std::array<T, kSize>;
  explicit DriftSystem(const Model<T>& model) : model_(model) {}

  /// Attitudes and rates against their own size. The deviation is one group: where one part of it vanishes (as the rates' does
  /// at a pole) its round-off is that of the other part. It starts from zero, so its scale has a floor.
  static constexpr auto groups() {
    constexpr std::array<ComponentGroup, 6> all{
        {{0, 4, 1.0}, {4, 3, 1e-3}, {7, 1, 1.0}, {8, 6, 1e-5}, {14, 4, 1.0}, {18, 3, 1e-3}}};
    if constexpr (kIntegrated)
      return all;
    else
      return std::array<ComponentGroup, 4>{all[0], all[1], all[2], all[3]};
  }

  EARTHTOP_INLINE_ALL void operator()(const State& x, State& dxdt, T t) const {
    using namespace drift_state;
    const Motion<T> reference = load_motion(x, kReference);
    const Deviation<T> deviation = load_deviation(x);
    const PivotField<T> field = pivot_field<K>(model_, t);
    if constexpr (O == Observer::laboratory) {
      if constexpr (kIntegrated) {
        const Motion<T> rotating = load_motion(x, kRotating);
        const Vec3<T> torque_L = non_inertial_torque<K>(model_, rotating);
        store_motion(laboratory_equation(model_, rotating, field.rotating_L, torque_L), dxdt, kRotating);
      }
      const Vec3<T> no_torque = Vec3<T>::Zero();
      store_motion(laboratory_equation(model_, reference, field.reference_L, no_torque), dxdt, kReference);
      store_deviation(laboratory_deviation_equation<K>(model_, reference, deviation, field), dxdt);
    } else if constexpr (O == Observer::body) {
      if constexpr (kIntegrated)
        store_motion(body_equation<true, K>(model_, load_motion(x, kRotating), field.rotating_L), dxdt, kRotating);
      store_motion(body_equation<false, K>(model_, reference, field.reference_L), dxdt, kReference);
      store_deviation(body_deviation_equation<K>(model_, reference, deviation, field), dxdt);
    } else {
      const LaboratoryTurn<T> turn = laboratory_turn(model_, t);
      const Mat3<T> R_NL = rotation_matrix(turn.quaternion(model_.epsilon));
      const Mat3<T> unturned = Mat3<T>::Identity();
      if constexpr (kIntegrated)
        store_motion(inertial_equation<true, K>(model_, load_motion(x, kRotating), field.rotating_L, R_NL), dxdt, kRotating);
      store_motion(inertial_equation<false, K>(model_, reference, field.reference_L, unturned), dxdt, kReference);
      store_deviation(inertial_deviation_equation<K>(model_, reference, deviation, field, turn), dxdt);
    }
  }

  GeneralDriftSeries<T> series() const { return GeneralDriftSeries<T>(model_); }

  /// The state at release: both predictions at the same attitude, with the same rates of the kind the release names.
  /// @param w_XB_B  in natural units
  State initial_state(const Quaternion<T>& q_LB, const Vec3<T>& w_XB_B, RatesRelativeTo X) const {
    const Mat3<T> R_LB = rotation_matrix(q_LB);
    const Vec3<T> W_B_scaled = R_LB.transpose() * model_.W_IL_L_scaled;
    const Vec3<T> W_B = model_.epsilon * W_B_scaled;
    const bool inertial_rates = X == RatesRelativeTo::inertial;
    // Rates of the rotating body relative to L and to I, and their deviations over epsilon, from the same given rates.
    const Vec3<T> w_LB_B = inertial_rates ? Vec3<T>(w_XB_B - W_B) : w_XB_B;
    const Vec3<T> w_IB_B = inertial_rates ? w_XB_B : Vec3<T>(w_XB_B + W_B);
    const Vec3<T> zero = Vec3<T>::Zero();
    const Vec3<T> Dw_LB_B = inertial_rates ? Vec3<T>(-W_B_scaled) : zero;
    const Vec3<T> Dw_IB_B = inertial_rates ? zero : W_B_scaled;
    State x;
    const auto store = [&](const Vec3<T>& rotating, const Vec3<T>& reference, const Vec3<T>& deviation) {
      if constexpr (kIntegrated) drift_state::store_motion<T>({q_LB, rotating}, x, drift_state::kRotating);
      drift_state::store_motion<T>({q_LB, reference}, x, drift_state::kReference);
      drift_state::store_deviation<T>({T(1), zero, deviation}, x);
    };
    if constexpr (O == Observer::laboratory)
      store(R_LB * (model_.I_BP_B * w_LB_B), R_LB * (model_.I_BP_B * w_XB_B), R_LB * (model_.I_BP_B * Dw_LB_B));
    else if constexpr (O == Observer::body)
      store(w_IB_B, w_XB_B, model_.I_BP_B * Dw_IB_B);
    else
      store(R_LB * (model_.I_BP_B * w_IB_B), R_LB * (model_.I_BP_B * w_XB_B), R_LB * (model_.I_BP_B * Dw_IB_B));
    return x;
  }

  /// The observer's variables turned into those all observers share; rates in natural units, `t_s` left to the caller.
  DriftState<T> shared_state(const State& x, T t) const {
    using namespace drift_state;
    const Motion<T> reference = load_motion(x, kReference);
    const Motion<T> rotating = rotating_motion(x, reference, load_deviation(x));
    const auto body_rate = [&](const Motion<T>& m) {
      return times(model_.I_BP_B_inverse, transposed_times(rotation_matrix(m.q), m.m));
    };
    const auto earth_rate = [&](const Quaternion<T>& q_LB) { return transposed_times(rotation_matrix(q_LB), model_.W_IL_L); };
    DriftState<T> s = deviation_state(x, t);
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

  /// The part of it that the drift is measured from: `ref_q_LB`, `e_w`, `e_v_scaled` and `epsilon`; cheap.
  DriftState<T> deviation_state(const State& x, T t) const {
    const Quaternion<T> ref_q = drift_state::load_motion(x, drift_state::kReference).q;
    return seen_from_laboratory<O>(model_, ref_q, drift_state::load_deviation(x), t);
  }
  /// Called after every step: the attitude quaternions are integrated, and continuous by themselves.
  void follow(const State&) {}

 private:
  Motion<T> rotating_motion(const State& x, const Motion<T>& reference, const Deviation<T>& deviation) const {
    const T epsilon = model_.epsilon;
    const Quaternion<T> e{deviation.w, epsilon * deviation.y};
    if constexpr (kIntegrated) {
      return drift_state::load_motion(x, drift_state::kRotating);
    } else if constexpr (O == Observer::body) {
      return {reference.q * e, reference.m + epsilon * times(model_.I_BP_B_inverse, deviation.p)};
    } else {
      return {e * reference.q, times(rotation_matrix(e), Vec3<T>(reference.m + epsilon * deviation.p))};
    }
  }

  const Model<T>& model_;
};

}  // namespace earthtop
