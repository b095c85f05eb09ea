// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/verdict.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "drift/stability.hpp"
#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/drift/growth.hpp"
#include "earthtop/vectors.hpp"
#include "run/contact_verdict.hpp"

namespace earthtop {
namespace {

constexpr double kLostAngle = 1e-6;    // rad: rounding that has grown to this takes digits that a drift needs
constexpr double kRoundings = 8;       // rounding error of the scene's own numbers, in units in the last place
constexpr double kGrownAngle = 0.1;    // rad: the growth of a larger disturbance is not linear
constexpr double kEquilibrium = 1e-2;  // a motion that departs less from its release counts as steady
constexpr double kLoose = 1e-2;        // rad: above this bound the motion is lost, if disturbances grow
constexpr double kResolved = 3;        // a drift larger than this many times its bound is more than noise
constexpr double kStill = 1e-3;        // an axis whose drift is a smaller share of the attitude's stands still

double epsilon_of(Precision precision) {
  switch (precision) {
    case Precision::bits53: break;
    case Precision::bits64: return static_cast<double>(real::epsilon<long double>());
    case Precision::bits113: return static_cast<double>(real::epsilon<float128>());
  }
  return real::epsilon<double>();
}

std::optional<double> earlier(std::optional<double> a, std::optional<double> b) {
  if (!a || !b) return a ? a : b;
  return std::min(*a, *b);
}

/// Returns why the motion is marginal, for an upright top near its critical spin.
std::optional<std::string> marginal_reason(const MotionProblem<double>& problem) {
  const auto upright = marginal_top(problem);
  if (!upright) return std::nullopt;
  return fmt::format(
      "an upright top at {:.6g} of its critical spin: whether it stands or falls depends on digits of its spin and moments "
      "that are not known",
      std::sqrt(upright->spin_ratio_squared));
}

/// The growth of disturbances along both motions, combined.
struct Growth {
  std::optional<double> exponential_s, round_off_s, earth_s, critical_spin_s, late_exponent_1_s;
  double mean_exponent_1_s = 0;
  double departure = 0;
  bool completed = true;
  double followed_s = HUGE_VAL;  ///< time to which both motions were followed (s)
};

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

Growth follow_growth(const RunResult& result, const MotionProblem<double>& problem, double tolerance, const Watch& watch) {
  const double earth_share = norm(problem.model.W_IL_L) / problem.fastest_rate;
  const double log_round_off = real::log(kLostAngle / (kRoundings * epsilon_of(result.modelled.scenario().precision)));
  const double log_earth = real::log(kGrownAngle / earth_share);
  // The damping by dry friction increases as the motion slows down, without limit at rest; so the growth ends before a stop.
  const double until_s = result.stops.empty() ? result.reached_s : 0.99 * result.stops.front().t_s;
  Growth growth;
  for (const MotionKind kind : {MotionKind::reference, MotionKind::rotating}) {
    if (kind == MotionKind::rotating && earth_share == 0) break;  // both motions are the same
    const Watch part = kind == MotionKind::reference ? watch.part(0, earth_share == 0 ? 1 : 0.5) : watch.part(0.5, 1);
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
    if (earth_share > 0) growth.earth_s = earlier(growth.earth_s, report.passes_s(log_earth));
  }
  const double W_IL = std::abs(result.modelled.rotation_rate_rad_s());
  if (growth.earth_s && W_IL * *growth.earth_s > kGrownAngle) growth.earth_s.reset();
  return growth;
}

std::string when(std::optional<double> time_s, std::string_view what) {
  return time_s ? fmt::format("; {} at {:.4g} s", what, *time_s) : "";
}

/// Returns the first time (s) from which the largest drift so far, of axis or attitude, is not well above its bound.
std::optional<double> noise_from_s(std::span<const JudgedLook> judged) {
  double axis = 0, attitude = 0;
  std::optional<double> from_s;
  for (const JudgedLook& look : judged) {
    if (look.t_s == 0) continue;
    axis = std::max(axis, look.axis_rad);
    attitude = std::max(attitude, look.attitude_rad);
    // The noise of an axis that stands still does not count, as it is far below the drift of an attitude that moves.
    const bool axis_noise = axis <= kResolved * look.axis_bound_rad && look.axis_bound_rad > kStill * attitude;
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
/// @param contracts  whether friction takes energy: neighbouring motions then come together wherever nothing drives them apart
void judge_growth(const Growth& growth, std::span<const JudgedLook> judged, bool integrable, bool contracts,
                  VerdictReport& report) {
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
  report.earth_grown_s = growth.earth_s;
  const std::string loose = when(loose_s, "the bound on the drift's error has passed 0.01 rad");
  const std::string rounding = when(growth.round_off_s, "rounding has grown to a microradian");
  const std::string earth = when(growth.earth_s, "the Earth's own disturbance has grown to 0.1 rad");
  const bool steady = growth.departure < kEquilibrium || growth.critical_spin_s.has_value();
  // Where the late exponent is known, it tells whether disturbances still grow; otherwise friction is taken to end their growth.
  const bool goes_on = growth.late_exponent_1_s ? *growth.late_exponent_1_s > 0 : !contracts;
  if (braked) {
    report.verdict = Verdict::unstable;
    report.from_s = earlier(growth.critical_spin_s, earlier(growth.round_off_s, loose_s));
    report.reason = fmt::format(
        "friction has slowed an upright top to its critical spin at {:.6g} s: from then on it falls, and disturbances grow as "
        "it does{}{}{}",
        *growth.critical_spin_s, earth, rounding, loose);
  } else if (integrable || steady || !goes_on) {
    report.verdict = Verdict::unstable;
    report.from_s = earlier(growth.round_off_s, loose_s);
    report.reason = goes_on ? fmt::format("disturbances of this motion grow exponentially, {:.4g} per second on average{}{}{}",
                                          growth.mean_exponent_1_s, earth, rounding, loose)
                            : fmt::format(
                                  "disturbances of this motion grow exponentially for a while: after {:.4g} s they are more "
                                  "than a hundred times as large as its own angles would make them{}{}{}",
                                  *growth.exponential_s, earth, rounding, loose);
  } else {
    report.verdict = Verdict::chaotic;
    report.from_s = earlier(growth.earth_s, earlier(growth.round_off_s, loose_s));
    report.reason =
        fmt::format("disturbances grow exponentially wherever the motion goes, Lyapunov exponent about {:.4g} per second{}{}{}",
                    growth.late_exponent_1_s.value_or(growth.mean_exponent_1_s), earth, rounding, loose);
  }
}

/// Whether the tip slides in one prediction and rolls in the other.
template <class Row>
bool is_mixed(const Row& row) {
  return row.contact && row.contact->state == ContactState::mixed;
}

/// Judges whether the drift stands out of its errors, and sets the time until which it is reliable.
void judge_noise(const RunResult& result, std::span<const JudgedLook> judged, VerdictReport& report) {
  report.reliable_until_s = report.from_s.value_or(result.reached_s);
  if (const auto from_s = noise_from_s(judged); from_s && report.verdict == Verdict::reliable) {
    report.verdict = Verdict::noise_floor;
    report.from_s = from_s;
    report.reliable_until_s = *from_s;
    report.reason = fmt::format("the drift is not above {:g} times the bound on its error", kResolved);
  }
}

}  // namespace

VerdictReport assess_verdict(const RunResult& result, std::span<const JudgedLook> judged, const Watch& watch) {
  VerdictReport report;
  if (!has_drift(result)) {
    report.verdict = Verdict::unassessed;
    report.reason = "there is no row beyond the release";
    return report;
  }
  const DriftProblem<double>& problem = result.modelled.problem<double>();
  if (problem.table) {
    report = contact_verdict(problem, result, watch);
    judge_noise(result, judged, report);
    return report;
  }
  if (const auto reason = marginal_reason(problem)) {
    report.verdict = Verdict::marginal;
    report.from_s = 0;
    report.reason = *reason;
    return report;
  }
  const auto tolerance = growth_tolerance(problem, result.reached_s);
  if (!tolerance)
    report.reason =
        "the motion is close to one in closed form that is far from every separatrix: no disturbance grows exponentially";
  else
    judge_growth(follow_growth(result, problem, *tolerance, watch), judged, is_integrable(problem),
                 problem.model.applied.friction() || problem.model.applied.gimbal_damping > 0, report);
  judge_noise(result, judged, report);
  return report;
}

void mark_rows(RunResult& result) {
  // Between the stops of the two motions, their distance shows which one stopped first, not how the Earth turns them.
  const double one_rests_s = result.stops.empty() ? HUGE_VAL : result.stops.front().t_s;
  const double both_rest_s = result.stops.size() < 2 ? HUGE_VAL : result.stops.back().t_s;
  const auto reliable = [&](double t_s) { return result.verdict.trusts(t_s) && !(t_s > one_rests_s && t_s < both_rest_s); };
  for (std::vector<DriftRow>* rows : {&result.rows, &result.looks})
    for (DriftRow& row : *rows) row.drift_reliable = reliable(row.t_s) && !is_mixed(row);
  for (ExtendedDriftRow& row : result.extended_rows)
    row.drift_reliable = reliable(static_cast<double>(row.t_s)) && !is_mixed(row);
}

bool has_drift(const RunResult& result) { return result.rows.size() > 1; }

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
