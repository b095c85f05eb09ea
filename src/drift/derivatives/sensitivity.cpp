// SPDX-License-Identifier: GPL-3.0-or-later
#include "drift/derivatives/jet.hpp"  // must come first: the formulas included below are compiled for jets
//
#include <algorithm>
#include <cmath>
#include <vector>

#include "drift/derivatives/growth_work.hpp"
#include "drift/derivatives/problem_jets.hpp"
#include "drift/derivatives/record_tangents.hpp"
#include "drift/measures.ipp"
#include "drift/pivot/drift_system.hpp"
#include "drift/pivot/driven_reduced_drift.hpp"
#include "earthtop/drift/sensitivity.hpp"
#include "integrate/taylor/tangent_shape.hpp"
#include "integrate/taylor/taylor_stepper.hpp"
#include "model/reduced_top.ipp"

namespace earthtop {
namespace {

constexpr std::size_t kInputs = kInputsAtOnce;

/// The least size, in natural units, that a derivative's error is measured against.
constexpr double least_scale(double) { return 1e-3; }

/// Any body in body axes.
class AnyBody {
 public:
  using System = DriftSystem<Jet, Observer::body, SceneKind::full, RotatingMotion::composed>;

  AnyBody(const MotionProblem<double>& problem, const Inputs& inputs, std::size_t count)
      : beside_{problem.model, inputs, count}, model_(jets_of(problem.model, inputs)), system_(model_) {
    const NaturalRelease<Jet> release = jets_of(problem.natural_release(), inputs);
    initial_ = system_.initial_state(release);
    // The share of the Earth's rate in the deviation at release may itself be an input.
    Jet share = 0.0;
    for (std::size_t k = 0; k < kInputs; ++k) share.d[k] = inputs[k].release;
    Deviation<Jet> deviation = drift_state::load_deviation(initial_);
    const Vec3<Jet> W_B_scaled = transposed_times(rotation_matrix(release.q_LB), model_.W_IL_L_scaled);
    deviation.p += share * times(model_.I_BP_B, W_B_scaled);
    drift_state::store_deviation(deviation, initial_);
  }
  const System::State& initial_state() const { return initial_; }
  const System& system() const { return system_; }
  void follow(const System::State&) {}
  taylor::Operations<double> record(std::span<const double> x, double t) const {
    return record_tangents(model_, beside_, x, t);
  }

 private:
  BesideJets beside_;
  Model<Jet> model_;
  System system_;
  System::State initial_;
};

/// A symmetric top without its spin, where no input breaks the symmetry.
class SymmetricTop {
 public:
  using System = DrivenReducedDrift<Jet, Observer::laboratory>;

  SymmetricTop(const MotionProblem<double>& problem, const Inputs& inputs, std::size_t count)
      : beside_{problem.model, inputs, count},
        system_(jets_of(problem.model, inputs), jets_of(problem.natural_release(), inputs)) {}
  static bool fits(const MotionProblem<double>& problem, double time_s, const Inputs& inputs) {
    return is_reducible_when_driven(problem.model) && has_smooth_series(problem, time_s) &&
           std::ranges::all_of(inputs, [&](const ProblemDerivative& d) { return keeps_symmetry(problem.model, d); });
  }
  System::State initial_state() const { return system_.initial_state(); }
  const System& system() const { return system_; }
  void follow(const System::State& x) { system_.follow(x); }
  taylor::Operations<double> record(std::span<const double> x, double t) const {
    return record_tangents(system_.equations(), beside_, x, t);
  }

 private:
  static bool keeps_symmetry(const Model<double>& model, const ProblemDerivative& d) {
    const int axis = symmetry_axis(model.I_BP_B, model.mass_moment_B), i = (axis + 1) % 3, j = (axis + 2) % 3;
    const Mat3<double>& I = d.I_BP_B;
    const Vec3<double>& m = d.mass_moment_B;
    return I(i, i) == I(j, j) && I(i, j) == 0 && I(i, axis) == 0 && I(j, axis) == 0 && m[i] == 0 && m[j] == 0 &&
           d.coriolis == 0 && d.centrifugal == 0 && d.release == 0 && (axis == 2 || !d.applied.has_disc());
  }
  BesideJets beside_;
  System system_;
};

/// The Taylor series of a form's state with its derivatives, for the stepper.
template <class Form>
struct Followed {
  static constexpr std::size_t kValues = Form::System::kSize;
  using Shape = taylor::TangentShape<typename Form::System::Shape, kValues, kInputs, least_scale>;
  static constexpr std::size_t kSize = Shape::kSize;
  using State = std::array<double, kSize>;
  using Series = RecordedSeries<double, kSize>;

  static State packed(const std::array<Jet, kValues>& jets) {
    State x;
    for (std::size_t i = 0; i < kValues; ++i) {
      x[i] = jets[i].value;
      for (std::size_t k = 0; k < kInputs; ++k) x[(k + 1) * kValues + i] = jets[i].d[k];
    }
    return x;
  }
  static std::array<Jet, kValues> unpacked(const State& x) {
    std::array<Jet, kValues> jets;
    for (std::size_t i = 0; i < kValues; ++i) {
      jets[i] = x[i];
      for (std::size_t k = 0; k < kInputs; ++k) jets[i].d[k] = x[(k + 1) * kValues + i];
    }
    return jets;
  }
};

/// Appends the derivatives by the first `count` inputs of a jet, and sets the value.
void include(Differentiated& quantity, const Jet& jet, std::size_t count) {
  quantity.value = jet.value;
  quantity.derivatives.insert(quantity.derivatives.end(), jet.d.begin(), jet.d.begin() + static_cast<std::ptrdiff_t>(count));
}

/// Notes how far each input moves the two axes at this state.
void follow_responses(const DriftState<Jet>& state, std::array<Responses, kInputs>& responses) {
  const drift_measures::AxisPair<Jet> axes(state);
  const auto length = [](const Vec3<Jet>& v, std::size_t k) { return real::hypot(v[0].d[k], v[1].d[k], v[2].d[k]); };
  for (std::size_t k = 0; k < kInputs; ++k) {
    Responses& r = responses[k];
    r.displacement_final = length(axes.n, k);
    r.drift_final = state.epsilon.value * length(axes.d_scaled, k);
    r.displacement_largest = std::max(r.displacement_largest, r.displacement_final);
    r.drift_largest = std::max(r.drift_largest, r.drift_final);
  }
}

Quaternion<double> values_of(const Quaternion<Jet>& q) {
  return {q.w.value, Vec3<double>(q.v[0].value, q.v[1].value, q.v[2].value)};
}
Vec3<double> values_of(const Vec3<Jet>& v) { return {v[0].value, v[1].value, v[2].value}; }

/// Integrates with one group of inputs, of which `count` are asked for, and appends their derivatives to the result.
template <class Form>
void follow(Form form, const MotionProblem<double>& problem, std::size_t count, double time_s, double relative_tolerance,
            const Watch& watch, SensitivitySought sought, const std::function<void(const FollowedStep&)>& on_step,
            DriftSensitivity& result) {
  using Tangents = Followed<Form>;
  using State = typename Tangents::State;
  const int looks = sought == SensitivitySought::responses ? 8 : 1;  // a step
  const auto& system = form.system();
  std::array<Responses, kInputs> responses;
  const auto look = [&](const State& x, double t) {
    const auto jets = Tangents::unpacked(x);
    form.follow(jets);
    if (sought == SensitivitySought::nothing) return;
    follow_responses(system.deviation_state(jets, Jet(t)), responses);
    if (!on_step) return;
    const DriftState<Jet> s = system.shared_state(jets, Jet(t));
    on_step({t, values_of(s.ref_q_LB), values_of(s.ref_w_LB_B), values_of(s.q_LB), values_of(s.w_LB_B)});
  };
  State x = Tangents::packed(form.initial_state());
  GroupScales<double, typename Tangents::Shape> scales;
  typename Tangents::Series series([&](const State& at, double t) { return form.record(at, t); });
  taylor::TaylorStepper<double, Tangents> stepper(relative_tolerance, scales);
  scales.include(x);
  stepper.initialize(x, 0);
  look(x, 0);
  const double end = problem.units.time_from_s(time_s);
  double t = 0;
  const std::int64_t before = result.counters.accepted;
  const std::int64_t most = variational_limit(problem, time_s, relative_tolerance).steps;
  while (t < end) {
    if (result.counters.accepted - before >= most) {
      result.status = RunStatus::step_limit;
      return;
    }
    watch.reach(t / end);
    if (watch.asks_to_stop()) {
      result.status = RunStatus::interrupted;
      return;
    }
    stepper.limit_step(end - t);
    stepper.do_step(series);
    result.counters.evaluations += stepper.evaluations();
    const double step = stepper.current_time_step();
    if (!(step > 0) || !(t + step > t) || !all_finite(stepper.current_state())) {
      result.status = RunStatus::step_underflow;
      return;
    }
    ++result.counters.accepted;
    for (int i = 1; i < looks; ++i) {
      stepper.state_after(step * i / looks, x);
      look(x, t + step * i / looks);
    }
    t = step < end - t ? stepper.current_time() : end;
    x = stepper.current_state();
    scales.include(x);
    look(x, t);
  }
  const DriftMeasures<Jet> measures = measure_drift(system.deviation_state(Tangents::unpacked(x), Jet(t)));
  include(result.axis, measures.axis, count);
  include(result.attitude, measures.attitude, count);
  include(result.tilt, measures.tilt, count);
  if (measures.azimuth_defined) {
    if (!result.azimuth) result.azimuth.emplace();
    include(*result.azimuth, measures.azimuth, count);
  }
  if (sought == SensitivitySought::responses)
    result.responses.insert(result.responses.end(), responses.begin(), responses.begin() + static_cast<std::ptrdiff_t>(count));
}

}  // namespace

DriftSensitivity drift_sensitivity(const MotionProblem<double>& problem, const std::vector<ProblemDerivative>& inputs,
                                   double time_s, double relative_tolerance, const Watch& watch, SensitivitySought sought,
                                   const std::function<void(const FollowedStep&)>& on_step) {
  DriftSensitivity result;
  for (std::size_t first = 0; first < inputs.size() && result.status == RunStatus::completed; first += kInputs) {
    const std::size_t count = std::min(kInputs, inputs.size() - first);
    Inputs group;
    std::copy_n(inputs.begin() + static_cast<std::ptrdiff_t>(first), count, group.begin());
    const std::size_t groups = (inputs.size() + kInputs - 1) / kInputs, before = first / kInputs;
    const Watch part = watch.part(double(before) / double(groups), double(before + 1) / double(groups));
    const auto& watched = first == 0 ? on_step : nullptr;
    if (SymmetricTop::fits(problem, time_s, group))
      follow(SymmetricTop(problem, group, count), problem, count, time_s, relative_tolerance, part, sought, watched, result);
    else
      follow(AnyBody(problem, group, count), problem, count, time_s, relative_tolerance, part, sought, watched, result);
  }
  return result;
}

}  // namespace earthtop
