// SPDX-License-Identifier: GPL-3.0-or-later
#include "drift/jet.hpp"  // must come first: the formulas included below are compiled for jets
//
#include <algorithm>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <vector>

#include "drift/measures.ipp"
#include "drift/problem_derivative.hpp"
#include "earthtop/drift/deviation.hpp"
#include "earthtop/drift/sensitivity.hpp"
#include "earthtop/model/converted.hpp"
#include "integrate/inline_all.hpp"
#include "model/applied_motion.ipp"

namespace earthtop {
namespace {

constexpr std::size_t kInputs = kInputsAtOnce;
using Inputs = std::array<ProblemDerivative, kInputs>;
using Jet = real::Jet<kInputs>;
constexpr std::size_t kVariables = 14;       // q and w of the reference; w, y and p of the deviation
constexpr std::size_t kSlots = kInputs + 1;  // one for the values, and one for the derivatives by each input
using State = std::array<double, kVariables * kSlots>;

/// Variables that the step control measures together, against their common size.
struct Group {
  std::size_t first, count;
};
constexpr Group kGroups[] = {{0, 4}, {4, 3}, {7, 4}, {11, 3}};

Jet jet_at(const State& x, std::size_t i) {
  Jet jet = x[i];
  for (std::size_t k = 0; k < kInputs; ++k) jet.d[k] = x[(k + 1) * kVariables + i];
  return jet;
}
void put(const Jet& jet, State& x, std::size_t i) {
  x[i] = jet.value;
  for (std::size_t k = 0; k < kInputs; ++k) x[(k + 1) * kVariables + i] = jet.d[k];
}
Vec3<Jet> vector_at(const State& x, std::size_t i) { return {jet_at(x, i), jet_at(x, i + 1), jet_at(x, i + 2)}; }
void put(const Vec3<Jet>& v, State& x, std::size_t i) {
  for (std::size_t k = 0; k < 3; ++k) put(v[static_cast<int>(k)], x, i + k);
}
Motion<Jet> motion_in(const State& x) { return {{jet_at(x, 0), vector_at(x, 1)}, vector_at(x, 4)}; }
Deviation<Jet> deviation_in(const State& x) { return {jet_at(x, 7), vector_at(x, 8), vector_at(x, 11)}; }
void put(const Motion<Jet>& motion, const Deviation<Jet>& deviation, State& x) {
  put(motion.q.w, x, 0);
  put(motion.q.v, x, 1);
  put(motion.m, x, 4);
  put(deviation.w, x, 7);
  put(deviation.y, x, 8);
  put(deviation.p, x, 11);
}

/// A matrix or vector of the problem as jets. @param member  takes a ProblemDerivative to its derivative of that quantity
template <class Derived, class Member>
auto with_derivatives(const Eigen::MatrixBase<Derived>& values, const Inputs& inputs, const Member& member) {
  Eigen::Matrix<Jet, Derived::RowsAtCompileTime, Derived::ColsAtCompileTime> jets;
  for (int i = 0; i < values.rows(); ++i)
    for (int j = 0; j < values.cols(); ++j) {
      jets(i, j) = values(i, j);
      for (std::size_t k = 0; k < kInputs; ++k) jets(i, j).d[k] = member(inputs[k])(i, j);
    }
  return jets;
}

/// Takes a coefficient to a jet whose derivatives are zero. Functions of time are left out: their values are added (System).
struct ToJet {
  Jet operator()(double number) const { return number; }
  std::shared_ptr<const AngleSpline<Jet>> operator()(const std::shared_ptr<const AngleSpline<double>>&) const {
    return nullptr;
  }
  TideSeries<Jet> operator()(const TideSeries<double>&) const { return {}; }
};

Model<Jet> jet_model(const Model<double>& model, const Inputs& inputs) {
  Model<Jet> jets = converted<Jet>(model, ToJet());
  for (std::size_t k = 0; k < kInputs; ++k) {
    const auto differentiate = ByKind{
        [k](double d, Jet& jet) { jet.d[k] = d; },
        [k]<int rows, int columns>(const Eigen::Matrix<double, rows, columns>& d, Eigen::Matrix<Jet, rows, columns>& jet) {
          for (int i = 0; i < rows; ++i)
            for (int j = 0; j < columns; ++j) jet(i, j).d[k] = d(i, j);
        },
        // These are added as torques: see System.
        [](const AppliedTorques<double>&, AppliedTorques<Jet>&) {}, [](const TideSeries<double>&, TideSeries<Jet>&) {}};
    for_each_derivative(differentiate, inputs[k], jets);
  }
  jets.W_IL_L = jets.epsilon * jets.W_IL_L_scaled;
  return jets;
}

State initial_state(const MotionProblem<double>& problem, const Model<Jet>& model, const Inputs& inputs) {
  const Release<double>& release = problem.release;
  Quaternion<Jet> q;
  q.w = release.q_LB.w;
  for (std::size_t k = 0; k < kInputs; ++k) q.w.d[k] = inputs[k].q_LB.w;
  q.v = with_derivatives(release.q_LB.v, inputs, [](const ProblemDerivative& d) { return d.q_LB.v; });
  const Vec3<Jet> w = with_derivatives(problem.units.rate_from_rad_s(release.w_XB_B), inputs,
                                       [](const ProblemDerivative& d) { return d.w_XB_B; });
  Deviation<Jet> deviation;
  // If the release gives the rates relative to the laboratory, the two motions' inertial rates differ by W (share 1); if it
  // gives the inertial rates, they do not (share 0).
  Jet share = release.X == RatesRelativeTo::laboratory ? 1 : 0;
  for (std::size_t k = 0; k < kInputs; ++k) share.d[k] = inputs[k].release;
  deviation.p = share * times(model.I_BP_B, transposed_times(rotation_matrix(q), model.W_IL_L_scaled));
  State x;
  put({q, w}, deviation, x);
  return x;
}

/// Keeps the largest size that each group has had in each slot, against which its errors are measured.
class Sizes {
 public:
  void include(const State& x) {
    for (std::size_t slot = 0; slot < kSlots; ++slot)
      for (std::size_t g = 0; g < std::size(kGroups); ++g) largest_[slot][g] = std::max(largest_[slot][g], norm_of(x, slot, g));
  }
  /// The largest error relative to its size; infinite where one is not finite. Sizes are taken to be at least a thousandth, in
  /// natural units.
  double relative(const State& error) const {
    double worst = 0;
    for (std::size_t slot = 0; slot < kSlots; ++slot)
      for (std::size_t g = 0; g < std::size(kGroups); ++g) {
        const double share = norm_of(error, slot, g) / std::max(1e-3, largest_[slot][g]);
        if (!std::isfinite(share)) return HUGE_VAL;
        worst = std::max(worst, share);
      }
    return worst;
  }

 private:
  static double norm_of(const State& x, std::size_t slot, std::size_t group) {
    double square = 0;
    for (std::size_t i = 0; i < kGroups[group].count; ++i) {
      const double xi = x[slot * kVariables + kGroups[group].first + i];
      square += xi * xi;
    }
    return std::sqrt(square);
  }
  std::array<std::array<double, std::size(kGroups)>, kSlots> largest_ = {};
};

/// Appends the derivatives by the first `count` inputs of a jet, and sets the value.
void include(Differentiated& quantity, const Jet& jet, std::size_t count) {
  quantity.value = jet.value;
  quantity.derivatives.insert(quantity.derivatives.end(), jet.d.begin(), jet.d.begin() + static_cast<std::ptrdiff_t>(count));
}

/// The right-hand side for reference and deviation with their derivatives, including torques whose strengths are inputs.
template <SceneKind K>
class System {
 public:
  System(const Model<double>& plain, const Model<Jet>& model, const Inputs& inputs)
      : values_(plain), model_(model), inputs_(inputs) {
    const auto is_torque = [](const ProblemDerivative& d) { return d.applied.any || !d.tide.empty(); };
    rests_ = plain.platform.turn.never_turns() && norm(plain.platform.pivot_offset_P) == 0;
    has_torques_ = plain.applied.any || std::any_of(inputs.begin(), inputs.end(), is_torque);
  }

  EARTHTOP_INLINE_ALL void operator()(const State& x, State& dxdt, double t) {
    if constexpr (K == SceneKind::full)
      if (values_.platform.turn.table) follow_table(t);
    const PivotField<Jet> field = field_at(t);
    const Motion<Jet> reference = motion_in(x);
    const Deviation<Jet> deviation = deviation_in(x);
    Motion<Jet> reference_rate = body_equation<false, K>(model_, reference, field.reference_L);
    Deviation<Jet> deviation_rate = body_deviation_equation<K>(model_, reference, deviation, field);
    if (has_torques_) add_torques(t, reference, deviation, reference_rate, deviation_rate);
    put(reference_rate, deviation_rate, dxdt);
  }

 private:
  /// Sets the platform's turn to a parabola that agrees with its table at t in angle, rate and acceleration.
  void follow_table(double t) {
    const PrescribedMotion<double>& table = values_.platform.turn;
    const double rate = table.angle_rate(t), acceleration = table.angle_acceleration(t);
    PrescribedMotion<Jet>& turn = model_.platform.turn;
    turn.acceleration = acceleration;
    turn.rate = rate - acceleration * t;
    turn.angle0 = table.angle(t) - t * (rate - acceleration * t / 2);
  }
  PivotField<Jet> field_at(double t) const {
    PivotField<Jet> field = rests_ ? pivot_field<SceneKind::plain>(model_, Jet(t)) : pivot_field<K>(model_, Jet(t));
    if constexpr (K == SceneKind::full)
      if (!values_.tide.empty()) {
        const Vec3<Jet> tide_L = values_.tide.acceleration_L(t).cast<Jet>();
        field.reference_L += tide_L;
        field.rotating_L += tide_L;
      }
    return field;
  }
  [[gnu::noinline]] void add_torques(double t, const Motion<Jet>& reference, const Deviation<Jet>& deviation,
                                     Motion<Jet>& reference_rate, Deviation<Jet>& deviation_rate) const {
    if (model_.applied.any) {
      const Vec3<Jet> Dw = times(model_.I_BP_B_inverse, deviation.p);
      const auto torques = applied_torques_B(model_, Jet(t), reference.q, reference.m, deviation.w, deviation.y, Dw);
      const Vec3<Jet> on_reference(torques[0].ref, torques[1].ref, torques[2].ref);
      reference_rate.m += times(model_.I_BP_B_inverse, on_reference);
      for (int i = 0; i < 3; ++i) deviation_rate.p[i] += torques[i].diff;
    }
    for (std::size_t k = 0; k < kInputs; ++k) {
      if (!inputs_[k].applied.any && inputs_[k].tide.empty()) continue;
      const auto torques = torques_of_input(k, t, reference, deviation);
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) reference_rate.m[i].d[k] += values_.I_BP_B_inverse(i, j) * torques[j].ref;
        deviation_rate.p[i].d[k] += torques[i].diff;
      }
    }
  }
  /// The torques of input k at strength 1, including the reaction of a gimbal to them.
  Vec3<Paired<double>> torques_of_input(std::size_t k, double t, const Motion<Jet>& reference,
                                        const Deviation<Jet>& deviation) const {
    const Quaternion<double> q = value_of(reference.q);
    const Vec3<double> w = value_of(reference.m), y = value_of(deviation.y);
    const Vec3<double> Dw = times(values_.I_BP_B_inverse, value_of(deviation.p));
    Model<double> model = values_;
    const auto torques_at = [&](const AppliedTorques<double>& applied) {
      model.applied = applied;
      return applied_torques_B(model, t, q, w, deviation.w.value, y, Dw);
    };
    AppliedTorques<double> applied = inputs_[k].applied, gimbal;
    gimbal.any = gimbal.level_axis = applied.level_axis = values_.applied.level_axis;
    if (!inputs_[k].tide.empty()) model.tide = inputs_[k].tide;
    Vec3<Paired<double>> torques = torques_at(applied);
    if (gimbal.level_axis) {
      model.tide = {};
      torques -= torques_at(gimbal);
    }
    if (!inputs_[k].tide.empty()) {
      const Vec3<double> a_B = transposed_times(rotation_matrix(q), inputs_[k].tide.acceleration_L(t));
      const Vec3<double> change = turn_back_minus_one_scaled(deviation.w.value, y, values_.epsilon, a_B);
      const Vec3<double> ref = values_.mass_moment_B.cross(a_B), diff = values_.mass_moment_B.cross(change);
      for (int i = 0; i < 3; ++i) torques[i] += Paired<double>(ref[i], ref[i] + values_.epsilon * diff[i], diff[i]);
    }
    return torques;
  }
  static Vec3<double> value_of(const Vec3<Jet>& v) { return {v[0].value, v[1].value, v[2].value}; }
  static Quaternion<double> value_of(const Quaternion<Jet>& q) { return {q.w.value, value_of(q.v)}; }

  const Model<double>& values_;
  Model<Jet> model_;
  bool has_torques_;
  bool rests_;  ///< whether the pivot is at rest in the laboratory: the formulas of a platform are half of the work
  const Inputs& inputs_;
};

DriftState<Jet> drift_state_of(const State& x, const Model<Jet>& model) {
  const Deviation<Jet> deviation = deviation_in(x);
  DriftState<Jet> state;
  state.ref_q_LB = motion_in(x).q;
  state.e_w = deviation.w;
  state.e_v_scaled = deviation.y;
  state.epsilon = model.epsilon;
  return state;
}

/// Notes how far each input moves the two axes at this state.
void follow_responses(const State& x, const Model<Jet>& model, std::array<Responses, kInputs>& responses) {
  const drift_measures::AxisPair<Jet> axes(drift_state_of(x, model));
  const auto length = [](const Vec3<Jet>& v, std::size_t k) { return real::hypot(v[0].d[k], v[1].d[k], v[2].d[k]); };
  for (std::size_t k = 0; k < kInputs; ++k) {
    Responses& r = responses[k];
    r.displacement_final = length(axes.n, k);
    r.drift_final = model.epsilon.value * length(axes.d_scaled, k);
    r.displacement_largest = std::max(r.displacement_largest, r.displacement_final);
    r.drift_largest = std::max(r.drift_largest, r.drift_final);
  }
}

FollowedStep followed_step(const State& x, const Model<double>& model, double t) {
  FollowedStep step;
  const auto vector = [&](std::size_t i) { return Vec3<double>(x[i], x[i + 1], x[i + 2]); };
  step.t = t;
  step.ref_q_LB = {x[0], vector(1)};
  step.ref_w_LB_B = vector(4);
  step.q_LB = step.ref_q_LB * Quaternion<double>{x[7], model.epsilon * vector(8)};
  step.w_LB_B = step.ref_w_LB_B + model.epsilon * times(model.I_BP_B_inverse, vector(11)) -
                transposed_times(rotation_matrix(step.q_LB), model.W_IL_L);
  return step;
}

/// Integrates with one group of inputs, of which `count` are asked for, and appends their derivatives to the result.
template <SceneKind K>
void follow(const MotionProblem<double>& problem, const Inputs& inputs, std::size_t count, double time_s,
            double relative_tolerance, const Watch& watch, const std::function<void(const FollowedStep&)>& on_step,
            DriftSensitivity& result) {
  const Model<Jet> model = jet_model(problem.model, inputs);
  System<K> equations(problem.model, model, inputs);
  std::array<Responses, kInputs> responses;
  const auto system = [&](const State& x, State& dxdt, double t) {
    ++result.counters.evaluations;
    equations(x, dxdt, t);
  };
  State x = initial_state(problem, model, inputs), after, error;
  Sizes sizes;
  sizes.include(x);
  follow_responses(x, model, responses);
  if (on_step) on_step(followed_step(x, problem.model, 0));
  boost::numeric::odeint::runge_kutta_fehlberg78<State> stepper;
  const double end = problem.units.time_from_s(time_s);
  double t = 0, dt = std::min(end, 0.1 / problem.fastest_rate);
  const std::int64_t before = result.counters.accepted + result.counters.rejected;
  const std::int64_t most = variational_limit(problem, time_s, relative_tolerance).steps;
  while (t < end) {
    if (result.counters.accepted + result.counters.rejected - before >= most) {
      result.status = RunStatus::step_limit;
      return;
    }
    watch.reach(t / end);
    if (watch.asks_to_stop()) {
      result.status = RunStatus::interrupted;
      return;
    }
    const bool last = t + dt >= end;
    const double step = last ? end - t : dt;
    stepper.do_step(system, x, t, after, step, error);
    const double used = sizes.relative(error) / relative_tolerance;
    const double factor = std::clamp(0.9 * real::pow(std::max(used, 1e-12), -1.0 / 8), 0.2, 4.0);
    if (!(used <= 1)) {
      ++result.counters.rejected;
      dt = step * (std::isfinite(used) ? std::min(factor, 0.9) : 0.2);
      if (t + dt > t) continue;
      result.status = RunStatus::step_underflow;
      return;
    }
    ++result.counters.accepted;
    x = after;
    t = last ? end : t + step;
    if (!last) dt = step * factor;
    sizes.include(x);
    follow_responses(x, model, responses);
    if (on_step) on_step(followed_step(x, problem.model, t));
  }
  const DriftMeasures<Jet> measures = measure_drift(drift_state_of(x, model));
  include(result.axis, measures.axis, count);
  include(result.attitude, measures.attitude, count);
  include(result.tilt, measures.tilt, count);
  if (measures.azimuth_defined) {
    if (!result.azimuth) result.azimuth.emplace();
    include(*result.azimuth, measures.azimuth, count);
  }
  result.responses.insert(result.responses.end(), responses.begin(), responses.begin() + static_cast<std::ptrdiff_t>(count));
}

}  // namespace

DriftSensitivity drift_sensitivity(const MotionProblem<double>& problem, const std::vector<ProblemDerivative>& inputs,
                                   double time_s, double relative_tolerance, const Watch& watch,
                                   const std::function<void(const FollowedStep&)>& on_step) {
  const bool plain = problem.model.kind == SceneKind::plain &&
                     std::none_of(inputs.begin(), inputs.end(),
                                  [](const ProblemDerivative& d) { return d.coriolis != 0 || d.centrifugal != 0; });
  DriftSensitivity result;
  for (std::size_t first = 0; first < inputs.size() && result.status == RunStatus::completed; first += kInputs) {
    const std::size_t count = std::min(kInputs, inputs.size() - first);
    Inputs group;
    std::copy_n(inputs.begin() + static_cast<std::ptrdiff_t>(first), count, group.begin());
    const std::size_t groups = (inputs.size() + kInputs - 1) / kInputs, before = first / kInputs;
    const Watch part = watch.part(double(before) / double(groups), double(before + 1) / double(groups));
    const auto& watched = first == 0 ? on_step : nullptr;
    if (plain)
      follow<SceneKind::plain>(problem, group, count, time_s, relative_tolerance, part, watched, result);
    else
      follow<SceneKind::full>(problem, group, count, time_s, relative_tolerance, part, watched, result);
  }
  return result;
}

}  // namespace earthtop
