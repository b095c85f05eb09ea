// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/verdict.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include "drift/stability.hpp"
#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/drift/growth.hpp"
#include "earthtop/vectors.hpp"
#include "run/drift_bound.hpp"
#include "run/largest.hpp"
#include "run/later_rows.hpp"
#include "run/support_reports.hpp"

namespace earthtop {
namespace {

constexpr double kLostAngle = 1e-6;    // rad: rounding that has grown to this takes digits that a drift needs
constexpr double kRoundings = 8;       // rounding error of the scene's own numbers, in units in the last place
constexpr double kGrownAngle = 0.1;    // rad: the growth of a larger disturbance is not linear
constexpr double kEquilibrium = 1e-2;  // a motion that departs less from its release counts as steady
constexpr double kLoose = 1e-2;        // rad: above this bound the motion is lost, if disturbances grow
constexpr double kResolved = 3;        // a drift larger than this many times its bound is more than noise
constexpr double kStill = 1e-3;        // an axis whose drift is a smaller share of the attitude's stands still

std::optional<double> earlier(std::optional<double> a, std::optional<double> b) {
  if (!a || !b) return a ? a : b;
  return std::min(*a, *b);
}

/// Returns why the motion is marginal, for an upright top near its critical spin.
std::optional<std::string> marginal_reason(const MotionProblem<double>& problem) {
  const auto upright = marginal_top(problem);
  if (!upright) return std::nullopt;
  return fmt::format(
      "an upright top at {:.6g} times its critical spin: whether it stands or falls depends on digits of its spin and moments "
      "that are not known",
      std::sqrt(upright->spin_ratio_squared));
}

/// Returns when the drift has grown to an angle at which growth is no longer linear (s). It says nothing where the Earth itself turns by
/// half as much until then.
std::optional<double> earth_grown_s(const RunResult& result) {
  const std::size_t a_window =
      result.looks_a_window > 0 ? result.looks_a_window : std::max<std::size_t>(1, result.looks.size());
  std::optional<double> grown_s;
  std::vector<double> times_s, drifts;
  for (std::size_t begin = 0; begin < result.looks.size() && !grown_s; begin += a_window) {
    times_s.clear(), drifts.clear();
    for (std::size_t i = begin; i < std::min(begin + a_window, result.looks.size()); ++i) {
      const DriftRow& look = result.looks[i];
      if (look.drift_attitude_bound_rad > kGrownAngle) break;  // later drifts are not known
      times_s.push_back(look.t_s), drifts.push_back(look.drift_attitude_rad);
    }
    grown_s = first_passing(times_s, drifts, kGrownAngle);
  }
  const bool is_large_effect = grown_s && 2 * std::abs(result.modelled.rotation_rate_rad_s()) * *grown_s > kGrownAngle;
  return is_large_effect ? std::nullopt : grown_s;
}

/// Returns the growth of disturbances along one motion. Growth that a coarse integration finds may be its own error, so a finer
/// integration has to confirm it.
GrowthReport confirmed_growth(const MotionProblem<double>& problem, MotionKind kind, double until_s, double tolerance,
                              const Watch& watch) {
  GrowthReport report = disturbance_growth(problem, kind, until_s, tolerance, watch);
  const bool grows = report.exponential_s || report.late_exponent_1_s.value_or(0) > 0;
  return grows && tolerance > kConfirmingGrowthTolerance
             ? disturbance_growth(problem, kind, until_s, kConfirmingGrowthTolerance, watch)
             : report;
}

/// The natural logarithm of the growth that makes an angle of a run's rounding which takes digits that a drift needs.
double log_of_lost_rounding(const RunResult& result) {
  return real::log(kLostAngle / (kRoundings * epsilon_of(result.modelled.scenario().precision)));
}

FollowedGrowth follow_growth(const RunResult& result, const MotionProblem<double>& problem, double tolerance,
                             double log_round_off, const Watch& watch) {
  const bool one_motion = norm(problem.model.W_IL_L) == 0 && !problem.model.journey.has_still_reference();  // both are the same
  // The damping by dry friction increases as the motion slows down, without limit at rest; so the growth ends before a stop.
  const double until_s = result.stops.empty() ? result.reached_s : 0.99 * result.stops.front().t_s;
  FollowedGrowth growth;
  for (const MotionKind kind : {MotionKind::reference, MotionKind::rotating}) {
    if (kind == MotionKind::rotating && one_motion) break;
    const Watch part = kind == MotionKind::reference ? watch.part(0, one_motion ? 1 : 0.5) : watch.part(0.5, 1);
    const GrowthReport report = confirmed_growth(problem, kind, until_s, tolerance, part);
    growth.mean_exponent_1_s = std::max(growth.mean_exponent_1_s, report.mean_exponent_1_s);
    if (report.late_exponent_1_s)
      growth.late_exponent_1_s = std::max(growth.late_exponent_1_s.value_or(-HUGE_VAL), *report.late_exponent_1_s);
    growth.critical_spin_s = earlier(growth.critical_spin_s, report.critical_spin_s);
    growth.completed = growth.completed && report.completed;
    growth.followed_s = std::min(growth.followed_s, report.end_s);
    if (!report.exponential_s) continue;
    growth.departure = std::max(growth.departure, kind == MotionKind::reference ? report.departure : 0);
    growth.exponential_s = earlier(growth.exponential_s, report.exponential_s);
    growth.round_off_s = earlier(growth.round_off_s, report.passes_s(log_round_off));
  }
  return growth;
}

/// A doubt that begins at some time, at the end of a reason.
std::string when(std::optional<double> time_s, Doubt doubt) {
  return time_s ? fmt::format("; {} at {:.4g} s", type_of(doubt).words, *time_s) : "";
}

/// Returns the first time (s) from which the largest drift so far, of axis or attitude, is not well above its bound.
std::optional<double> noise_from_s(std::span<const JudgedLook> judged) {
  double axis = 0, attitude = 0;
  std::optional<double> from_s;
  for (const JudgedLook& look : judged) {
    if (look.t_s == 0) continue;
    axis = std::max(axis, look.watched_axis_rad());
    attitude = std::max(attitude, look.attitude_rad);
    // The noise of an axis that stands still does not count, as it is far below the drift of an attitude that moves.
    const double axis_bound = look.watched_axis_bound_rad();
    const bool axis_noise = axis <= kResolved * axis_bound && axis_bound > kStill * attitude;
    const bool noise = axis_noise || (look.attitude_bound_rad > 0 && attitude <= kResolved * look.attitude_bound_rad);
    if (!noise)
      from_s.reset();
    else if (!from_s)
      from_s = look.t_s;
  }
  return from_s;
}

std::optional<double> loose_from_s(std::span<const JudgedLook> judged) {
  const auto look = std::ranges::find_if(judged, [](const JudgedLook& l) { return l.attitude_bound_rad > kLoose; });
  return look == judged.end() ? std::nullopt : std::optional(look->t_s);
}

/// Judges a run by the growth of disturbances along its motions.
void judge_growth(const RunResult& result, const GrowthFound& found, std::span<const JudgedLook> judged,
                  VerdictReport& report) {
  const FollowedGrowth& growth = found.growth;
  const std::optional<double> earth_s = found.tells_of_drift && growth.exponential_s ? earth_grown_s(result) : std::nullopt;
  report.lyapunov_exponent_1_s = growth.late_exponent_1_s;
  const std::optional<double> loose_s = loose_from_s(judged);
  const bool braked = growth.critical_spin_s.value_or(0) > 0;
  if (!growth.exponential_s && !braked) {
    report.reason = growth.completed
                        ? "disturbances grow no faster than the motion's own angles"
                        : fmt::format("disturbances do not grow exponentially, as far as they were followed, to {:.6g} s",
                                      growth.followed_s);
    return;
  }
  report.round_off_grown_s = growth.round_off_s;
  report.earth_grown_s = earth_s;
  const std::string loose = when(loose_s, Doubt::bound_loose);
  const std::string rounding = when(growth.round_off_s, Doubt::rounding_grown);
  const std::string earth = when(earth_s, Doubt::earth_grown);
  if (growth.round_off_s) report.intervals.push_back({*growth.round_off_s, growth.round_off_until_s, Doubt::rounding_grown});
  if (loose_s) report.intervals.push_back({*loose_s, {}, Doubt::bound_loose});
  const bool steady = growth.departure < kEquilibrium || growth.critical_spin_s.has_value();
  // Where the late exponent is known, it tells whether disturbances still grow; otherwise friction is taken to end their growth.
  const bool goes_on = growth.late_exponent_1_s ? *growth.late_exponent_1_s > 0 : !found.contracts;
  if (braked) {
    report.verdict = Verdict::unstable;
    report.intervals.push_back({*growth.critical_spin_s, {}, Doubt::critical_spin});
    report.reason = fmt::format("{} at {:.6g} s: from then on it falls, and disturbances grow as it does{}{}{}",
                                type_of(Doubt::critical_spin).words, *growth.critical_spin_s, earth, rounding, loose);
  } else if (found.is_integrable || steady || !goes_on) {
    report.verdict = Verdict::unstable;
    report.reason = goes_on ? fmt::format("disturbances of this motion grow exponentially, {:.4g} per second on average{}{}{}",
                                          growth.mean_exponent_1_s, earth, rounding, loose)
                            : fmt::format(
                                  "disturbances of this motion grow exponentially for a while: after {:.4g} s they are more "
                                  "than a hundred times as large as its own angles would make them{}{}{}",
                                  *growth.exponential_s, earth, rounding, loose);
  } else {
    report.verdict = Verdict::chaotic;
    if (earth_s) report.intervals.push_back({*earth_s, {}, Doubt::earth_grown});
    report.reason =
        fmt::format("disturbances grow exponentially wherever the motion goes, Lyapunov exponent about {:.4g} per second{}{}{}",
                    growth.late_exponent_1_s.value_or(growth.mean_exponent_1_s), earth, rounding, loose);
  }
}

/// Where a drift that nothing else speaks against does not stand out of its errors, the verdict says so.
void judge_noise(std::span<const JudgedLook> judged, VerdictReport& report) {
  if (report.verdict != Verdict::reliable) return;
  if (const auto from_s = noise_from_s(judged)) {
    report.verdict = Verdict::noise_floor;
    report.intervals.push_back({*from_s, {}, Doubt::noise});
    report.reason = fmt::format("the drift is not above {:g} times the bound on its error", kResolved);
  }
}

/// Adds the times between two moments that the two motions pass one after the other: there their distance shows which one was
/// first, not how the Earth turns them.
/// @param moments_s  ascending; no second one where only one motion passes it   @param apart  whether they differ from the release
void add_between(std::span<const double> moments_s, bool apart, Doubt doubt, VerdictReport& report) {
  if (apart) report.intervals.push_back({0, moments_s.empty() ? std::nullopt : std::optional(moments_s.front()), doubt});
  if (apart || moments_s.empty()) return;
  const std::optional<double> until_s = moments_s.size() < 2 ? std::nullopt : std::optional(moments_s.back());
  if (!until_s || *until_s > moments_s.front()) report.intervals.push_back({moments_s.front(), until_s, doubt});
}

void add_unlike_motions(const RunResult& result, VerdictReport& report) {
  std::vector<double> rests_s, slip_stops_s;
  for (const StopEvent& stop : result.stops) rests_s.push_back(stop.t_s);
  add_between(rests_s, false, Doubt::one_at_rest, report);
  if (!result.contact) return;
  for (const ContactEvent& event : result.contact->events)
    if (event.kind == ContactEventKind::slip_stopped) slip_stops_s.push_back(event.t_s);
  const auto& release = result.rows.front().contact;
  add_between(slip_stops_s, release && release->state == ContactState::mixed, Doubt::mixed_contact, report);
}

/// Brings the intervals in order, and sets the times that follow from them.
void conclude(const RunResult& result, VerdictReport& report) {
  std::vector<VerdictInterval> found = std::move(report.intervals), between;
  std::ranges::stable_sort(found, {}, &VerdictInterval::from_s);
  std::vector<VerdictInterval>& all = report.intervals = {};
  for (const VerdictInterval& interval : found) {
    if (!type_of(interval.why).of_verdict)
      between.push_back(interval);
    else if (all.empty() || (all.back().until_s && *all.back().until_s < interval.from_s))
      all.push_back(interval);
    else if (all.back().until_s)
      all.back().until_s = interval.until_s ? std::max(*interval.until_s, *all.back().until_s) : interval.until_s;
  }
  if (!all.empty()) report.from_s = all.front().from_s, report.until_s = all.back().until_s;
  all.insert(all.end(), between.begin(), between.end());
  std::ranges::stable_sort(all, {}, &VerdictInterval::from_s);
  report.reliable_until_s = all.empty() ? result.reached_s : all.front().from_s;
}

}  // namespace

GrowthFound growth_on_pivot(const DriftProblem<double>& problem, const RunResult& result, double log_round_off,
                            const Watch& watch) {
  VerdictReport report;
  if (const auto reason = marginal_reason(problem)) {
    report.verdict = Verdict::marginal;
    report.intervals.push_back({0, {}, Doubt::stability_limit});
    report.reason = *reason;
  } else if (const auto tolerance = growth_tolerance(problem, result.reached_s)) {
    const AppliedTorques<double>& applied = problem.model.applied;
    return {.growth = follow_growth(result, problem, *tolerance, log_round_off, watch),
            .is_integrable = is_integrable(problem),
            .tells_of_drift = true,
            .contracts = applied.friction() || applied.gimbal_damping > 0};
  } else {
    report.reason =
        "the motion is close to one in closed form that is far from every separatrix: no disturbance grows exponentially";
  }
  return {report};
}

GrowthFound growth_of(const RunResult& result, const Watch& watch) {
  if (!has_drift(result)) return {};
  const DriftProblem<double>& problem = result.modelled.problem_without_rows<double>();
  return reports_of(result.modelled).growth(problem, result, log_of_lost_rounding(result), watch);
}

VerdictReport assess_verdict(const RunResult& result, std::span<const JudgedLook> judged, const GrowthFound& found) {
  if (!has_drift(result)) {
    VerdictReport report = not_judged("there is no row beyond the release");
    report.from_s.reset();  // there is no drift that could not be trusted
    return report;
  }
  VerdictReport report;
  if (found.settled)
    report = *found.settled;
  else
    judge_growth(result, found, judged, report);
  judge_noise(judged, report);
  add_unlike_motions(result, report);
  conclude(result, report);
  return report;
}

VerdictReport not_judged(std::string reason) {
  VerdictReport report;
  report.verdict = Verdict::unassessed;
  report.intervals.push_back({0, {}, Doubt::not_assessed});
  report.from_s = 0;
  report.reason = std::move(reason);
  return report;
}

bool VerdictReport::trusts(double t_s) const {
  return std::ranges::none_of(intervals, [&](const VerdictInterval& interval) { return interval.contains(t_s); });
}

bool VerdictReport::doubts_motion(double t_s) const {
  return std::ranges::any_of(
      intervals, [&](const VerdictInterval& interval) { return type_of(interval.why).of_verdict && interval.contains(t_s); });
}

void mark_rows(RunResult& result) {
  for (std::vector<DriftRow>* rows : {&result.rows, &result.looks})
    for (DriftRow& row : *rows) row.drift_reliable = result.verdict.trusts(row.t_s);
  for (ExtendedDriftRow& row : result.extended_rows) row.drift_reliable = result.verdict.trusts(static_cast<double>(row.t_s));
}

bool has_drift(const RunResult& result) { return result.rows.size() > 1; }

bool is_all_reliable(const RunResult& result) {
  if (result.later_rows) return result.later_rows->are_all_trusted(result);
  return std::ranges::all_of(result.rows, &DriftRow::drift_reliable);
}

const DriftRow* last_reliable_row(const RunResult& result) {
  const auto row = std::find_if(result.rows.rbegin(), result.rows.rend(), [](const DriftRow& r) { return r.drift_reliable; });
  return row == result.rows.rend() ? nullptr : &*row;
}

std::string_view to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::reliable: return "reliable";
    case Verdict::noise_floor: return "noise_floor";
    case Verdict::unstable: return "unstable";
    case Verdict::chaotic: return "chaotic";
    case Verdict::marginal: return "marginal";
    case Verdict::unassessed: return "unassessed";
  }
  return "unknown";
}

}  // namespace earthtop
