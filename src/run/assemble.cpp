// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/assemble.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "drift/motion_way.hpp"
#include "run/assessment.hpp"
#include "run/drift_bound.hpp"
#include "run/event_bounds.hpp"
#include "run/later_rows.hpp"
#include "run/look_between.hpp"
#include "run/motion_report.hpp"
#include "run/rows.hpp"
#include "run/sensitivities.hpp"
#include "run/support_reports.hpp"
#include "run/verdict.hpp"
#include "run/why.hpp"

namespace earthtop {
namespace {

/// The factor by which the distance to the second integration is multiplied to give the bound. The distance is less than a tenth
/// of the rows' error only if both errors have the same sign and agree to a tenth. Where round-off decides both errors this is a
/// matter of chance: in 5,900 random scenes with methods and tolerances of every kind, three times the distance was too small in
/// ten scenes, six times in one, and ten times in none. With long_horizon checked by itself, ten times the distance was too
/// small in one.
constexpr int kSafety = 10;

/// Returns up to which look the two integrations are compared for the bound at look i. They may agree by chance at the first looks, so
/// the bound also uses the distances at the next two looks for judgement.
std::size_t compared_ahead(const Looks& looks, std::size_t i, std::size_t count) {
  int ahead = 2;
  for (++i; i < count && ahead > 0; ++i)
    if (looks.serves(i, LookFor::judgement)) --ahead;
  return i;
}

/// The angle between two attitudes (rad), given by the square of the tangent of its half, which is cheap, and grows with it.
template <class T>
struct AttitudeDistance {
  Quaternion<T> d;
  T tangent_squared;
  AttitudeDistance(const Quaternion<T>& p, const Quaternion<T>& q)
      : d(p.conjugate() * q), tangent_squared(d.v.dot(d.v) / (d.w * d.w)) {}
  double angle() const { return static_cast<double>(T(2) * real::atan2(norm(d.v), real::abs(d.w))); }
};

/// Appends a row in double and, for a wider scalar, also in full precision.
template <class T>
void add_row(const BasicDriftRow<T>& row, RunResult& result) {
  if constexpr (std::is_same_v<T, double>) {
    result.rows.push_back(row);
  } else {
    result.rows.push_back(row_cast<double>(row));
    result.extended_rows.push_back(row_cast<float128>(row));
  }
}

/// Keeps the rows of a complete solution whose error bounds have not been computed.
template <class T>
void keep_rows(const TwoIntegrations<T>& made, RunResult& result) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  const DriftBound<T> none(0);
  const RowParts<T> parts(result.scene, made.first.contact_events);
  for (std::size_t i = 0; i < made.first.samples.size(); ++i) {
    if (!made.looks.serves(i, LookFor::row)) continue;
    BasicDriftRow<T> row = make_row(made.first.samples[i], none, parts);
    row.drift_axis_bound_rad = row.drift_attitude_bound_rad = T(kUnknown);
    if (row.contact) row.contact->drift_tip_bound_m = T(kUnknown);
    if (row.rotor)
      row.rotor->drift_axis_bound_rad = row.rotor->drift_rate_bound_rad_s = row.rotor->drift_angle_bound_rad = T(kUnknown);
    if (row.gimbals) row.gimbals->drift_outer_angle_bound_rad = row.gimbals->drift_inner_angle_bound_rad = T(kUnknown);
    add_row(row, result);
  }
  result.drift = summarize_drift(result.rows, result.scene.rotation_rate_rad_s());
  if (made.first.threshold) result.drift.threshold_time_s = made.first.threshold->time_s();
  result.drift.axis_bound_rad = result.drift.attitude_bound_rad = result.attitude_bound_rad = kUnknown;
  result.drift.axis_max_bound_rad = result.drift.tilt_max_bound_rad = result.drift.azimuth_max_bound_rad = kUnknown;
  if (parts.table) result.drift.tip_bound_m = result.drift.tip_max_bound_m = kUnknown;
  if (result.drift.rotor_axis_bound_rad) result.drift.rotor_axis_bound_rad = result.drift.rotor_axis_max_bound_rad = kUnknown;
  for (auto* angle : {&result.drift.outer_angle, &result.drift.inner_angle})
    if (*angle) (*angle)->bound_rad = (*angle)->max_bound_rad = kUnknown;
  result.stops = made.first.stops;
  result.gimbal_events = made.first.gimbal_events;
  result.verdict.reason = "interrupted after the rows were computed, but before the bounds on their errors were";
  result.notes.emplace_back(
      "partial: interrupted before error bounds and verdict were computed; run the scenario again for them");
  mark_rows(result);
}

/// Makes the result of a run that was asked to stop: the time that its solution reached, and the rows if they are to be kept.
template <class T>
RunResult stopped(const Scene& scene, const TwoIntegrations<T>& made, bool partial) {
  RunResult result;
  result.scene = result.modelled = scene;
  result.solution = made.solution;
  result.certificate = made.certificate;
  result.status = RunStatus::interrupted;
  result.reached_s = made.first.samples.empty() ? 0 : static_cast<double>(made.first.samples.back().state.t_s);
  result.solution_is_whole = made.first.status == RunStatus::completed;
  result.verdict = not_judged("interrupted before the verdict was computed");
  if (partial && result.solution_is_whole) keep_rows(made, result);
  return result;
}

/// Returns a note if the flow at a disc changes during the run, because the drag formula chosen at release is kept.
std::optional<std::string> note_on_air(const RunResult& result) {
  const auto& disc = result.modelled.scenario().effects.applied.air_drag;
  if (!disc || disc->flow != DiscFlow::automatic || result.looks.empty()) return std::nullopt;
  const bool turbulent = is_turbulent(*disc, result.looks.front().w_LB_B[2]);
  const auto other = std::find_if(result.looks.begin(), result.looks.end(),
                                  [&](const DriftRow& row) { return is_turbulent(*disc, row.w_LB_B[2]) != turbulent; });
  if (other == result.looks.end()) return std::nullopt;
  return fmt::format(
      "after {:.4g} s the flow round the disc is {}, but the drag remains that of the release, {}: give /effects/air_drag/flow",
      other->t_s, turbulent ? "laminar" : "turbulent", turbulent ? "turbulent" : "laminar");
}

bool first_is_limited(const RunResult& result) { return result.solution.status == RunStatus::step_limit; }
const IntegrationReport& limited(const RunResult& result) {
  return first_is_limited(result) ? result.solution : result.certificate;
}
std::int64_t steps_of(const IntegrationReport& report) { return report.counters.accepted + report.counters.rejected; }

/// Makes the result of a run from its integrations, in stages that take seconds for millions of rows.
template <class T>
class Assembly {
 public:
  Assembly(const Scene& scene, TwoIntegrations<T> made, const RunSeconds& seconds, Parts parts, const RunOptions& options)
      : scene_(scene),
        scenario_(scene.scenario()),
        made_(std::move(made)),
        seconds_(seconds),
        parts_(std::move(parts)),
        options_(options),
        rows_(parts_.next(seconds.rows)),
        support_(reports_in<T>(scene)),
        row_parts_(scene, made_.first.contact_events) {
    result_.scene = result_.modelled = scene;
    result_.solution = made_.solution;
    result_.certificate = made_.certificate;
    result_.status = made_.first.status != RunStatus::completed ? made_.first.status : made_.second.status;
  }

  RunResult result() {
    static constexpr void (Assembly::*kStages[])() = {
        &Assembly::compare,    &Assembly::look,          &Assembly::report_support,
        &Assembly::judge,      &Assembly::differentiate, &Assembly::take_invariants,
        &Assembly::find_trend, &Assembly::find_largest,  &Assembly::report_motion,
        &Assembly::explain,    &Assembly::keep_ledger};
    for (const auto stage : kStages) {
      (this->*stage)();
      if (stops()) return stopped(scene_, made_, options_.partial);
    }
    add_notes();
    result_.looks_seconds = made_.way->looked_seconds;
    keep_for_later_rows();
    return std::move(result_);
  }

 private:
  bool stops() const { return rows_.asks_to_stop(); }

  /// Makes the rows, and the bounds from the distance of the two integrations.
  void compare() {
    between_ = take_between(made_);
    DriftBound<T> bound(kSafety, round_off_of(scene_.problem_without_rows<T>()));
    const std::size_t count = std::min(made_.first.samples.size(), made_.second.samples.size());
    const std::size_t steps = is_exact(made_.options.method) ? 0 : static_cast<std::size_t>(made_.first.counters.accepted);
    std::size_t compared = 0;
    T farthest = T(0);  // squared tangent of half the largest distance of two attitudes so far
    double turned = 0;
    std::size_t ahead = 0;
    for (std::size_t i = 0; i < count && !stops(); ++i) {
      if (i % 64 == 0) rows_.reach(static_cast<double>(i) / static_cast<double>(count));
      if (i == 0 || made_.looks.serves(i, LookFor::judgement)) ahead = compared_ahead(made_.looks, i, count);
      for (; compared < ahead; ++compared) {
        const DriftSample<T>& sample = made_.first.samples[compared];
        const DriftSample<T>& second = made_.second.samples[compared];
        bound.include(sample, second);
        bound.include_stated(sample.drift_error);
      }
      const DriftSample<T>& sample = made_.first.samples[i];
      const DriftSample<T>& other = made_.second.samples[i];
      if (made_.looks.serves(i, LookFor::row)) add_row(make_row(sample, bound, row_parts_), result_);
      if (made_.looks.serves(i, LookFor::judgement)) judged_.push_back(judged_look(sample, bound));
      const AttitudeDistance<T> distances[] = {{sample.state.q_LB, other.state.q_LB},
                                               {sample.state.ref_q_LB, other.state.ref_q_LB}};
      turned = std::max(turned, support_.turned_by_rounding(sample, steps, scenario_.duration_s));
      bounds_.include(sample.state.w_LB_B, other.state.w_LB_B);
      bounds_.include(sample.state.ref_w_LB_B, other.state.ref_w_LB_B);
      // Where the method states no error, only an angle that may be the largest so far counts.
      const T squared = std::max(distances[0].tangent_squared, distances[1].tangent_squared);
      if (sample.attitude_error == T(0) && squared < T(0.999) * farthest) continue;
      farthest = std::max(farthest, squared);
      const double distance = std::max(distances[0].angle(), distances[1].angle());
      result_.attitude_bound_rad =
          std::max(result_.attitude_bound_rad, kSafety * distance + static_cast<double>(sample.attitude_error));
    }
    result_.attitude_bound_rad += turned;
    bounds_.complete(kSafety, result_.attitude_bound_rad, turned / scenario_.duration_s, scene_.fastest_rate_rad_s());
  }

  void look() {
    result_.reached_s = result_.rows.empty() ? 0 : result_.rows.back().t_s;
    result_.drift = summarize_drift(result_.rows, scene_.rotation_rate_rad_s());
    if (scenario_.threshold_rad && has_drift(result_))
      assess_threshold(made_, *scenario_.threshold_rad, kSafety, result_.drift);
    result_.stops = assess_stops(made_, kSafety);
    result_.gimbal_events = assess_gimbal_events(made_, kSafety);
    if (has_drift(result_)) azimuths_ = look_between(scene_, made_, std::move(between_), judged_, rows_, result_);
  }

  void report_support() {
    keep(LookFor::row, LookFor::row, made_.looks, made_.first.samples);
    support_.report(made_, kSafety, result_);
  }

  void judge() {
    const Watch growth = parts_.next(seconds_.growth, "growth of disturbances");
    const GrowthFound found = growth_of(result_, growth);
    result_.verdict = assess_verdict(result_, judged_, found);
    if (!options_.between && result_.verdict.earth_grown_s) {
      // Few looks tell only roughly when the drift has grown.
      made_.plan = plan_looks(scene_, made_.options);
      look_between(scene_, made_, {}, judged_, rows_, result_);
      result_.verdict = assess_verdict(result_, judged_, found);
    }
    mark_rows(result_);
    support_.report_judged(result_, rows_);
    // The two integrations can agree on a threshold crossing although rounding has moved it in both.
    if (const auto& passed_s = result_.drift.threshold_time_s; passed_s && !result_.verdict.trusts(*passed_s)) {
      result_.drift.threshold_crossing = ThresholdCrossing::uncertain;
      result_.drift.threshold_time_bound_s.reset();
    }
  }

  void differentiate() {
    if (has_drift(result_))
      result_.sensitivities = assess_sensitivities(result_, parts_.next(seconds_.sensitivities, "sensitivities"));
  }
  void take_invariants() {
    if (has_drift(result_)) result_.invariants = support_.invariants(result_, made_.first.samples, rows_);
  }
  void find_trend() {
    if (has_drift(result_)) result_.drift.secular = assess_trend(result_, made_.plan.trend, azimuths_);
  }
  void find_largest() {
    if (has_drift(result_) && options_.between)
      assess_largest(source_of(scene_, made_, parts_.next(seconds_.largest, "largest drifts")), judged_, result_);
  }
  void report_motion() {
    if (has_drift(result_))
      result_.motion = motion_report(source_of(scene_, made_, rows_.with_progress(nullptr)), bounds_, result_);
  }
  void explain() {
    if (!has_drift(result_)) return;
    result_.theory = assess_theory(scene_, result_.looks, result_.drift);
    result_.why = why_sentences(result_);
  }
  void keep_ledger() { result_.ledger = support_.ledger(result_, made_.first.samples, parts_.next(seconds_.ledger, "ledger")); }

  void add_notes() {
    if (const auto note = note_on_air(result_)) result_.notes.push_back(*note);
    if (const std::string why = why_limited(result_); !why.empty()) result_.notes.push_back(why);
    if (!scenario_.effects.all_on()) result_.notes.emplace_back("non-physical scenario: a non-inertial torque is switched off");
    if (!scenario_.travel) return;
    if (scenario_.travel->reference == TravelReference::at_rest)
      result_.notes.emplace_back(
          "the prediction is that of a laboratory which stays at the place of the release, on the Earth that "
          "turns: the drift is what the journey does");
    if (scenario_.travel->eotvos == TravelEotvos::off)
      result_.notes.emplace_back("non-physical scenario: the Coriolis force on the laboratory is left out");
  }

  void keep_for_later_rows() {
    if (!made_.all_rows || judged_.empty()) return;
    for (DriftRow& row : result_.rows) take_bounds(judged_, row);
    result_.later_rows = std::make_shared<const LaterRows>(scene_, *made_.all_rows, made_.options, made_.memory(),
                                                           std::move(judged_), options_.jobs > 1);
  }

  const Scene& scene_;
  const Scenario& scenario_;
  TwoIntegrations<T> made_;
  const RunSeconds& seconds_;
  Parts parts_;
  const RunOptions& options_;
  const Watch rows_;
  const SupportReportsIn<T>& support_;
  RowParts<T> row_parts_;
  RunResult result_;
  std::vector<DriftSample<double>> between_;  ///< what the first integration has shown between its rows
  std::vector<JudgedLook> judged_;
  std::vector<AzimuthSample> azimuths_;
  MotionBounds bounds_;
};

}  // namespace

bool stopped_beyond_estimate(const RunResult& result) {
  const IntegrationOptions& numerics = result.scene.scenario().numerics;
  return result.status == RunStatus::step_limit && numerics.stops_beyond_estimate &&
         steps_of(limited(result)) < numerics.step_limit;
}

std::string why_limited(const RunResult& result) {
  if (result.status != RunStatus::step_limit) return "";
  const bool first = first_is_limited(result);
  const IntegrationReport& stopped = limited(result);
  return fmt::format("{} ({}) was stopped after {} steps, {} of them rejected: {}; {}",
                     first ? "the integration" : "the second integration, from which the bounds come,",
                     to_string(stopped.method), steps_of(stopped), stopped.counters.rejected,
                     stopped_beyond_estimate(result) ? "at least ten times the work estimated" : "as many as are allowed",
                     first ? "later rows were not reached" : "later rows would have no bound and are left out");
}

bool is_partial(const RunResult& result) { return result.status == RunStatus::interrupted && !result.rows.empty(); }

template <class T>
void plan_first(const Scene& scene, bool between, TwoIntegrations<T>& made, DriftProblem<T>& problem) {
  made.plan = plan_looks(scene, made.options);
  if (!between) made.plan.picture = {0, made.plan.judged_s.empty() ? problem.times_s : made.plan.judged_s, 0};
  made.looks.add(problem.times_s, LookFor::row);
  // Where steps end at the looks, the rows serve for judgement.
  made.looks.add(made.plan.judged_s.empty() ? problem.times_s : made.plan.judged_s, LookFor::judgement);
  if (looks_between_rows(made.options, scene.scenario().precision)) {
    made.looks.add(made.plan.trend.times_s, LookFor::trend);
    made.looks.add(made.plan.picture.times_s, LookFor::picture);
  }
  problem.times_s = made.looks.times_s;
  if (!between) return;
  made.way->leave_at_s = made.plan.picture.times_s;
  problem.way = made.way;
}

template <class T>
void make_second(DriftProblem<T>& problem, const Looks& looks, std::size_t count, const IntegrationOptions& first,
                 std::optional<double> nudge_units) {
  problem.rotating = RotatingMotion::composed;
  problem.sought = DriftSought::distances;
  problem.way.reset();
  problem.times_s = looks.compared(std::max<std::size_t>(1, count)).times_s;
  nudge(problem, T(nudge_units.value_or(round_off_of(problem).nudge)), nudged_for(problem, first));
}

template <class T>
void describe(const DriftProblem<T>& problem, const IntegrationOptions& options, const DriftTrajectory<T>& trajectory,
              Precision precision, IntegrationReport& report) {
  report.observer = options.observer;
  report.form = takes_reduced_form(problem.model, options) ? ModelForm::reduced : ModelForm::general;
  report.method = options.method;
  report.precision = to_string(precision);
  if (!is_exact(options.method)) report.relative_tolerance = options.relative_tolerance;
  report.step_s = trajectory.step_s;
  report.counters = trajectory.counters;
  report.status = trajectory.status;
}

template <class T>
RunResult assemble_result(const Scene& scene, TwoIntegrations<T> made, const RunSeconds& seconds, Parts parts,
                          const RunOptions& options) {
  return Assembly<T>(scene, std::move(made), seconds, std::move(parts), options).result();
}

#define EARTHTOP_ASSEMBLE(T)                                                                                                \
  template void plan_first(const Scene&, bool, TwoIntegrations<T>&, DriftProblem<T>&);                                      \
  template void make_second(DriftProblem<T>&, const Looks&, std::size_t, const IntegrationOptions&, std::optional<double>); \
  template void describe(const DriftProblem<T>&, const IntegrationOptions&, const DriftTrajectory<T>&, Precision,           \
                         IntegrationReport&);                                                                               \
  template RunResult assemble_result(const Scene&, TwoIntegrations<T>, const RunSeconds&, Parts, const RunOptions&);
EARTHTOP_ASSEMBLE(double)
EARTHTOP_ASSEMBLE(float80)
EARTHTOP_ASSEMBLE(float128)

}  // namespace earthtop
