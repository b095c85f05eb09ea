// SPDX-License-Identifier: GPL-3.0-or-later
#include "drift/derivatives/jet.hpp"  // must come first: the formulas included below are compiled for jets
//
#include <algorithm>
#include <cmath>
#include <vector>

#include "drift/derivatives/contact_derivatives.hpp"
#include "drift/derivatives/contact_tangents.hpp"
#include "drift/derivatives/growth_work.hpp"
#include "drift/derivatives/tangent_steps.hpp"
#include "drift/measures.ipp"
#include "drift/pivot/drift_system.hpp"
#include "drift/pivot/driven_reduced_drift.hpp"
#include "earthtop/drift/sensitivity.hpp"
#include "model/reduced_top.ipp"

namespace earthtop {
namespace {

constexpr std::size_t kInputs = kInputsAtOnce;

/// A motion about a pivot.
template <class Made>
struct OnPivot {
  using System = Made;
  static constexpr std::size_t kValues = System::kSize;
  /// The least size, in natural units, that a derivative's error is measured against.
  static constexpr double least_scale(double) { return 1e-3; }
};

/// Any body in body axes.
class AnyBody : public OnPivot<DriftSystem<Jet, Observer::body, SceneKind::full, RotatingMotion::composed>> {
 public:
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
  void follow(const System::State&, double) {}
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
class SymmetricTop : public OnPivot<DrivenReducedDrift<Jet, Observer::laboratory>> {
 public:
  SymmetricTop(const MotionProblem<double>& problem, const Inputs& inputs, std::size_t count)
      : beside_{problem.model, inputs, count},
        system_(jets_of(problem.model, inputs), jets_of(problem.natural_release(), inputs)) {}
  static bool fits(const MotionProblem<double>& problem, double time_s, const Inputs& inputs) {
    return is_reducible_when_driven(problem.model) && has_smooth_series(problem, time_s) &&
           std::ranges::all_of(inputs, [&](const ProblemDerivative& d) { return keeps_symmetry(problem.model, d); });
  }
  System::State initial_state() const { return system_.initial_state(); }
  const System& system() const { return system_; }
  void follow(const System::State& x, double) { system_.follow(x); }
  taylor::Operations<double> record(std::span<const double> x, double t) const {
    return record_tangents(system_.equations(), beside_, x, t);
  }

 private:
  static bool keeps_symmetry(const Model<double>& model, const ProblemDerivative& d) {
    const int axis = symmetry_axis(model.I_BP_B, model.mass_moment_B), i = (axis + 1) % 3, j = (axis + 2) % 3;
    const Mat3<double>& I = d.I_BP_B;
    const Vec3<double>& m = d.mass_moment_B;
    return I(i, i) == I(j, j) && I(i, j) == 0 && I(i, axis) == 0 && I(j, axis) == 0 && m[i] == 0 && m[j] == 0 &&
           d.coriolis == 0 && d.centrifugal == 0 && d.release == 0 && d.applied.is_symmetric_about(axis);
  }
  BesideJets beside_;
  System system_;
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

/// What is asked of an integration.
struct Asked {
  double time_s, relative_tolerance;
  Watch watch;
  SensitivitySought sought;
  const std::function<void(const FollowedStep&)>& on_step;
};

/// Integrates with one group of inputs, of which `count` are asked for, and appends their derivatives to the result.
template <class Form>
void follow(Form&& form, const MotionProblem<double>& problem, std::size_t count, const Asked& asked,
            DriftSensitivity& result) {
  using Tangents = JetTangents<std::remove_reference_t<Form>>;
  using State = typename Tangents::State;
  const bool responds = asked.sought == SensitivitySought::responses;
  const int looks = responds ? 8 : 1;  // a step
  const auto& system = form.system();
  std::array<Responses, kInputs> responses;
  const auto look = [&](const State& x, double t) {
    const auto jets = Tangents::unpacked(x);
    form.follow(jets, t);
    if (!responds) return;
    follow_responses(system.deviation_state(jets, Jet(t)), responses);
    if (!asked.on_step) return;
    const DriftState<Jet> s = system.shared_state(jets, Jet(t));
    asked.on_step({t, values_of(s.ref_q_LB), values_of(s.ref_w_LB_B), values_of(s.q_LB), values_of(s.w_LB_B)});
  };
  State x = Tangents::packed(form.initial_state());
  TangentSteps<Tangents> steps(typename Tangents::Series([&](const State& at, double t) { return form.record(at, t); }), x,
                               asked.relative_tolerance);
  if constexpr (requires { form.typical_state(); }) steps.include(Tangents::packed(form.typical_state()));
  look(x, 0);
  const double end = problem.units.time_from_s(asked.time_s);
  const TangentLimits limits{.end = end, .steps = variational_limit(problem, asked.time_s, asked.relative_tolerance).steps};
  result.status = follow_tangents(steps, x, limits, result.counters, asked.watch, [&](const State& now, double t) {
    for (int i = 1; i < looks; ++i) look(steps.within(double(i) / looks), t - steps.last_step() * (looks - i) / looks);
    look(now, t);
  });
  if (result.status != RunStatus::completed) return;
  const DriftMeasures<Jet> measures = measure_drift(system.deviation_state(Tangents::unpacked(x), Jet(end)));
  include(result.axis, measures.axis, count);
  include(result.attitude, measures.attitude, count);
  include(result.tilt, measures.tilt, count);
  if (measures.azimuth_defined) {
    if (!result.azimuth) result.azimuth.emplace();
    include(*result.azimuth, measures.azimuth, count);
  }
  if (responds)
    result.responses.insert(result.responses.end(), responses.begin(), responses.begin() + static_cast<std::ptrdiff_t>(count));
}

/// Follows the inputs in groups.   @param follow_group  called with (inputs, their number, what is asked, the result)
template <class FollowGroup>
DriftSensitivity in_groups(const std::vector<ProblemDerivative>& inputs, const Asked& asked, const FollowGroup& follow_group) {
  DriftSensitivity result;
  const std::size_t groups = (inputs.size() + kInputs - 1) / kInputs;
  for (std::size_t g = 0; g < groups && result.status == RunStatus::completed; ++g) {
    const std::size_t first = g * kInputs, count = std::min(kInputs, inputs.size() - first);
    Inputs group;
    std::copy_n(inputs.begin() + static_cast<std::ptrdiff_t>(first), count, group.begin());
    const Watch part = asked.watch.part(double(g) / double(groups), double(g + 1) / double(groups));
    follow_group(group, count,
                 Asked{asked.time_s, asked.relative_tolerance, part, asked.sought, g == 0 ? asked.on_step : nullptr}, result);
  }
  return result;
}

/// Whether a symmetric body stays so.
bool keeps_symmetry(const TableDerivative& d) {
  const Mat3<double>& I = d.contact.I_BC_B;
  const Vec3<double>& center = d.contact.p_OC_B;
  return I(0, 0) == I(1, 1) && I(0, 1) == 0 && I(0, 2) == 0 && I(1, 2) == 0 && center[0] == 0 && center[1] == 0 &&
         d.contact.air.viscous_1 == d.contact.air.viscous_2;
}

}  // namespace

DriftSensitivity drift_sensitivity(const MotionProblem<double>& problem, const std::vector<ProblemDerivative>& inputs,
                                   double time_s, double relative_tolerance, const Watch& watch, SensitivitySought sought,
                                   const std::function<void(const FollowedStep&)>& on_step) {
  return in_groups(inputs, {time_s, relative_tolerance, watch, sought, on_step},
                   [&](const Inputs& group, std::size_t count, const Asked& asked, DriftSensitivity& result) {
                     if (SymmetricTop::fits(problem, time_s, group))
                       follow(SymmetricTop(problem, group, count), problem, count, asked, result);
                     else
                       follow(AnyBody(problem, group, count), problem, count, asked, result);
                   });
}

DriftSensitivity drift_sensitivity(const DriftProblem<double>& problem, const std::vector<ProblemDerivative>& inputs,
                                   double time_s, double relative_tolerance, const Watch& watch, SensitivitySought sought,
                                   const std::function<void(const FollowedStep&)>& on_step) {
  if (!problem.table)
    return drift_sensitivity(static_cast<const MotionProblem<double>&>(problem), inputs, time_s, relative_tolerance, watch,
                             sought, on_step);
  const DriftProblem<double> smooth = with_law_of_tangents(problem);
  if (!has_tangents(problem)) {
    DriftSensitivity none;
    none.status = RunStatus::step_underflow;
    return none;
  }
  const bool symmetric = is_symmetric(smooth.table->contact) &&
                         std::ranges::all_of(inputs, [](const ProblemDerivative& d) { return keeps_symmetry(d.table); });
  return in_groups(inputs, {time_s, relative_tolerance, watch, sought, on_step},
                   [&](const Inputs& group, std::size_t count, const Asked& asked, DriftSensitivity& result) {
                     if (symmetric)
                       follow(ContactTangents<ContactReducedJets, OnTable::both_motions>(smooth, group, count), smooth, count,
                              asked, result);
                     else
                       follow(ContactTangents<ContactGeneralJets, OnTable::both_motions>(smooth, group, count), smooth, count,
                              asked, result);
                   });
}

}  // namespace earthtop
