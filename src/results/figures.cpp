// SPDX-License-Identifier: GPL-3.0-or-later
// The table of the members of summary.json.
#include "results/figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "budget/effects.hpp"
#include "drift/row_quantities.hpp"
#include "earthtop/results/headline.hpp"
#include "earthtop/results/provenance.hpp"
#include "earthtop/results/results.hpp"
#include "earthtop/run/each_row.hpp"
#include "earthtop/scenario/support.hpp"
#include "results/contact_members.hpp"
#include "results/member_entries.hpp"
#include "results/motion_members.hpp"
#include "results/sensitivity_members.hpp"
#include "results/top_members.hpp"
#include "scenario/quantities.hpp"
#include "text/json.hpp"

namespace earthtop {
namespace figure_table {
namespace {

// Functions for values that are not simply a member of the result.

/// The change of the mean precession rate, counterclockwise about Up: minus the secular rate of the azimuth.
std::optional<double> mean_precession_rate_change(const SecularDrift& trend) {
  if (!trend.azimuth_rate_rad_s) return std::nullopt;
  return 0.0 - *trend.azimuth_rate_rad_s;
}

const DoubtType& doubt(R r, I interval) { return type_of(r.verdict.intervals[interval].why); }
std::string_view to_word(RatesRelativeTo frame) { return frame == RatesRelativeTo::laboratory ? "laboratory" : "inertial"; }
std::string_view to_word(Prediction prediction) { return prediction == Prediction::rotating ? "rotating" : "non_rotating"; }

/// A value that belongs to another one; null where there is no other.
template <class T>
Json if_there(const std::optional<double>& other, const T& value) {
  return other ? Json(value) : Json();
}

/// A value that only a top on a table has; left out for others.
Json of_contact(R r, const std::optional<double>& value) {
  return r.scene.support().has_contact || r.contact ? json_from(value) : kLeftOut;
}
/// A number of the rotor on the rotating Earth at the release, or in the last row.
std::optional<double> of_rotor_row(R r, bool last, double BasicRotorRow<double>::*member) {
  if (r.rows.empty()) return std::nullopt;
  const auto& rotor = (last ? r.rows.back() : r.rows.front()).rotor;
  return rotor ? std::optional((*rotor).*member) : std::nullopt;
}
using OfAngle = DriftSummary::OfAngle;
/// A number of the drift of a suspension's angle; left out for other tops.
Json of_gimbals(R r, const std::optional<OfAngle>& angle, double OfAngle::*member) {
  if (!r.scene.scenario().gimbals) return kLeftOut;
  return angle ? Json((*angle).*member) : Json();
}
/// A component of the tip's drift at the end.
std::optional<double> tip_final(R r, std::size_t component) {
  if (r.rows.empty() || !r.rows.back().contact) return std::nullopt;
  return r.rows.back().contact->drift_tip_xy_m[component];
}
Json relative_tolerance(const IntegrationReport& report) {
  return report.relative_tolerance > 0 ? Json(report.relative_tolerance) : Json();
}
/// The status of an integration that ended early; left out if it completed.
Json trouble(const IntegrationReport& report) {
  return report.status != RunStatus::completed ? Json(to_string(report.status)) : kLeftOut;
}

/// The numbers of a sentence; none for a result that lacks it, from which the forms of all members are told.
Json numbers_of(R r, I sentence) {
  Json numbers = Json::object();
  if (sentence >= r.why.size()) return numbers;
  for (const auto& [name, value] : r.why[sentence].numbers) numbers[std::string(name)] = value;
  return numbers;
}

Json libraries() {
  Json versions = Json::object();
  for (const auto& [name, version] : build_info().libraries) versions[name] = version;
  return versions;
}

constexpr auto kFirstMembers = [] {
  using enum FigureKind;
  using enum FigureScope;
  return std::array{
      told("$schema", kFromRows, kLabel, [](R) { return "earthtop-summary-1.json"; }),
      told("name", kAtEnd, kLabel, [](R r) { return r.scene.scenario().name; }),
      told("title", kAtEnd, kLabel, [](R r) { return r.scene.scenario().title; }),
      object("outcome"),
      compared("outcome.status", outcome, any, kAtEnd, [](R r) { return to_string(r.status); }),
      compared("outcome.reached_s", input, span, kAtEnd, [](R r) { return r.reached_s; }),
      told("outcome.rows", kFromRows, kRowCount, [](R r) { return row_count(r); }),
      object("matching_rule"),
      told("matching_rule.rates_relative_to", kAtEnd, kOfScenario,
           [](R r) { return to_word(r.scene.scenario().release.rates_relative_to); }),
      told("matching_rule.statement", kAtEnd, kOfScenario, [](R r) { return matching_rule(r.scene.scenario()); }),
  };
}();

constexpr auto
    kDriftMembers =
        [] {
          using enum FigureKind;
          using enum FigureScope;
          using MemberForm::document, MemberForm::vector;
          return std::array{
      of_rows(object("drift")),
      of_last_row("drift_axis_rad",
                  compared("drift.axis_final_rad", drift_axis, end, kAtEnd, [](R r) { return r.drift.axis_final_rad; })),
      compared("drift.axis_max_rad", drift_axis, motion, kFromRows, [](R r) { return r.drift.axis_max_rad; }),
      told("drift.axis_max_at_s", kFromRows, kTimeOfLargest, [](R r) { return r.drift.axis_max_at_s; }),
      told("drift.axis_max_bound_rad", kFromRows, kIsBounded, [](R r) { return r.drift.axis_max_bound_rad; }),
      compared("drift.axis_bound_rad", error, rows, kAtEnd, [](R r) { return r.drift.axis_bound_rad; }),
      of_last_row("drift_attitude_rad", compared("drift.attitude_final_rad", drift_attitude, end, kAtEnd,
                                                 [](R r) { return r.drift.attitude_final_rad; })),
      compared("drift.attitude_bound_rad", error, rows, kAtEnd, [](R r) { return r.drift.attitude_bound_rad; }),
      of_last_row("drift_spin_rad",
                  compared("drift.spin_final_rad", drift_spin, end, kAtEnd, [](R r) { return r.drift.spin_final_rad; })),
      of_last_row("drift_azimuth_rad", compared("drift.azimuth_final_rad", drift_azimuth, end, kAtEnd,
                                                [](R r) { return r.drift.azimuth_final_rad; })),
      of_last_row("drift_tilt_rad",
                  compared("drift.tilt_final_rad", drift_tilt, end, kAtEnd, [](R r) { return r.drift.tilt_final_rad; })),
      compared("drift.azimuth_max_rad", drift_azimuth, motion, kFromRows, [](R r) { return r.drift.azimuth_max_rad; }),
      told("drift.azimuth_max_at_s", kFromRows, kTimeOfLargest,
           [](R r) { return if_there(r.drift.azimuth_max_rad, r.drift.azimuth_max_at_s); }),
      told("drift.azimuth_max_bound_rad", kFromRows, kIsBounded,
           [](R r) { return if_there(r.drift.azimuth_max_rad, r.drift.azimuth_max_bound_rad); }),
      compared("drift.tilt_max_rad", drift_tilt, motion, kFromRows, [](R r) { return r.drift.tilt_max_rad; }),
      told("drift.tilt_max_at_s", kFromRows, kTimeOfLargest, [](R r) { return r.drift.tilt_max_at_s; }),
      told("drift.tilt_max_bound_rad", kFromRows, kIsBounded, [](R r) { return r.drift.tilt_max_bound_rad; }),
      of_last_row("drift_tip_m", compared("drift.tip_final_m", drift_tip, end, kAtEnd,
                                          [](R r) { return of_contact(r, r.drift.tip_final_m); })),
      of_last_row("drift_tip_x_m",
                  compared("drift.tip_final_x_m", drift_tip, end, kAtEnd, [](R r) { return of_contact(r, tip_final(r, 0)); })),
      of_last_row("drift_tip_y_m",
                  compared("drift.tip_final_y_m", drift_tip, end, kAtEnd, [](R r) { return of_contact(r, tip_final(r, 1)); })),
      compared("drift.tip_max_m", drift_tip, motion, kFromRows, [](R r) { return of_contact(r, r.drift.tip_max_m); }),
      told("drift.tip_max_at_s", kFromRows, kTimeOfLargest, [](R r) { return of_contact(r, r.drift.tip_max_at_s); }),
      told("drift.tip_max_bound_m", kFromRows, kIsBounded, [](R r) { return of_contact(r, r.drift.tip_max_bound_m); }),
      compared("drift.tip_bound_m", error, rows, kAtEnd, [](R r) { return of_contact(r, r.drift.tip_bound_m); }),
      of_last_row("drift_rotor_axis_rad", compared("drift.rotor_axis_final_rad", drift_axis, end, kAtEnd,
                                                   [](R r) { return of_a_rotor(r, r.drift.rotor_axis_final_rad); })),
      compared("drift.rotor_axis_max_rad", drift_axis, motion, kFromRows,
               [](R r) { return of_a_rotor(r, r.drift.rotor_axis_max_rad); }),
      told("drift.rotor_axis_max_at_s", kFromRows, kTimeOfLargest,
           [](R r) { return of_a_rotor(r, r.drift.rotor_axis_max_at_s); }),
      told("drift.rotor_axis_max_bound_rad", kFromRows, kIsBounded,
           [](R r) { return of_a_rotor(r, r.drift.rotor_axis_max_bound_rad); }),
      compared("drift.rotor_axis_bound_rad", error, rows, kAtEnd,
               [](R r) { return of_a_rotor(r, r.drift.rotor_axis_bound_rad); }),
      of_last_row("drift_outer_angle_rad",
                  compared("drift.outer_angle_final_rad", drift_axis, end, kAtEnd,
                           [](R r) { return of_gimbals(r, r.drift.outer_angle, &OfAngle::final_rad); })),
      compared("drift.outer_angle_max_rad", drift_axis, motion, kFromRows,
               [](R r) { return of_gimbals(r, r.drift.outer_angle, &OfAngle::max_rad); }),
      told("drift.outer_angle_max_at_s", kFromRows, kTimeOfLargest,
           [](R r) { return of_gimbals(r, r.drift.outer_angle, &OfAngle::max_at_s); }),
      told("drift.outer_angle_max_bound_rad", kFromRows, kIsBounded,
           [](R r) { return of_gimbals(r, r.drift.outer_angle, &OfAngle::max_bound_rad); }),
      compared("drift.outer_angle_bound_rad", error, rows, kAtEnd,
               [](R r) { return of_gimbals(r, r.drift.outer_angle, &OfAngle::bound_rad); }),
      of_last_row("drift_inner_angle_rad",
                  compared("drift.inner_angle_final_rad", drift_axis, end, kAtEnd,
                           [](R r) { return of_gimbals(r, r.drift.inner_angle, &OfAngle::final_rad); })),
      compared("drift.inner_angle_max_rad", drift_axis, motion, kFromRows,
               [](R r) { return of_gimbals(r, r.drift.inner_angle, &OfAngle::max_rad); }),
      told("drift.inner_angle_max_at_s", kFromRows, kTimeOfLargest,
           [](R r) { return of_gimbals(r, r.drift.inner_angle, &OfAngle::max_at_s); }),
      told("drift.inner_angle_max_bound_rad", kFromRows, kIsBounded,
           [](R r) { return of_gimbals(r, r.drift.inner_angle, &OfAngle::max_bound_rad); }),
      compared("drift.inner_angle_bound_rad", error, rows, kAtEnd,
               [](R r) { return of_gimbals(r, r.drift.inner_angle, &OfAngle::bound_rad); }),
      compared("drift.axis_final_over_earth_angle", ratio, end, kAtEnd,
               [](R r) { return r.drift.axis_final_over_earth_angle; }),
      compared("drift.verdict", outcome, span, kAtEnd, [](R r) { return to_string(r.verdict.verdict); }),
      compared("drift.verdict_from_s", error, span, kFromRows, [](R r) { return r.verdict.from_s; }),
      told("drift.verdict_reason", kFromRows, kWords, [](R r) { return r.verdict.reason; }),
      // The times in which the drift is not to be trusted; none where all of it is.
      list("drift.verdict_intervals", [](R r) { return r.verdict.intervals.size(); }),
      told("drift.verdict_intervals.*.from_s", kFromRows, kIsMarked, [](R r, I i) { return r.verdict.intervals[i].from_s; }),
      told("drift.verdict_intervals.*.until_s", kFromRows, kIsMarked, [](R r, I i) { return r.verdict.intervals[i].until_s; }),
      told("drift.verdict_intervals.*.why", kFromRows, kWords, [](R r, I i) { return doubt(r, i).name; }),
      told("drift.verdict_intervals.*.text", kFromRows, kWords, [](R r, I i) { return doubt(r, i).words; }),
      object("drift.reliable"),
      compared("drift.reliable.until_s", error, span, kFromRows, [](R r) { return r.verdict.reliable_until_s; }),
      told("drift.reliable.at_s", kFromRows, kIsRow, [](R r) { return reliable(r, &DriftRow::t_s); }),
      told("drift.reliable.axis_rad", kFromRows, kIsRow, [](R r) { return reliable(r, &DriftRow::drift_axis_rad); }),
      told("drift.reliable.axis_bound_rad", kFromRows, kIsRow,
           [](R r) { return reliable(r, &DriftRow::drift_axis_bound_rad); }),
      told("drift.reliable.attitude_rad", kFromRows, kIsRow, [](R r) { return reliable(r, &DriftRow::drift_attitude_rad); }),
      told("drift.reliable.attitude_bound_rad", kFromRows, kIsRow,
           [](R r) { return reliable(r, &DriftRow::drift_attitude_bound_rad); }),
      object_or_null("drift.secular", [](R r) { return r.drift.secular.has_value(); }),
      compared("drift.secular.azimuth_rate_rad_s", azimuth_rate, span, kFromRows,
               [](R r) { return r.drift.secular->azimuth_rate_rad_s; }),
      compared("drift.secular.azimuth_rate_bound_95_rad_s", error, span, kFromRows,
               [](R r) { return r.drift.secular->azimuth_rate_bound_95_rad_s; }),
      compared("drift.secular.mean_precession_rate_change_rad_s", azimuth_rate, span, kFromRows,
               [](R r) { return mean_precession_rate_change(*r.drift.secular); }),
      compared("drift.secular.turns_seen", derived, motion, kFromRows, [](R r) { return r.drift.secular->turns_seen; }),
      told(
          "drift.secular.window_s", kFromRows, kIsMarked, [](R r) { return r.drift.secular->window_s; }, document),
      told("drift.secular.mean_of_window", kFromRows, kWords, [](R r) { return r.drift.secular->of_window; }),
      told("drift.secular.reason", kFromRows, kWords, [](R r) { return r.drift.secular->reason; }),
      object_or_null("drift.oscillation", [](R r) { return r.drift.secular.has_value(); }),
      compared("drift.oscillation.azimuth_rad", drift_azimuth, motion, kFromRows,
               [](R r) { return r.drift.secular->azimuth_oscillation_rad; }),
      told("drift.oscillation.azimuth_bound_rad", kFromRows, kIsBounded,
           [](R r) {
             return if_there(r.drift.secular->azimuth_oscillation_rad, r.drift.secular->azimuth_oscillation_bound_rad);
           }),
      told(
          "drift.oscillation.azimuth_at_s", kFromRows, kTimeOfLargest,
          [](R r) { return if_there(r.drift.secular->azimuth_oscillation_rad, r.drift.secular->azimuth_oscillation_at_s); },
          document),
      compared("drift.threshold_rad", input, any, kFromRows, [](R r) { return r.scene.scenario().threshold_rad; }),
      of_event(
          compared("drift.threshold_time_s", threshold_time, at_event, kAtEnd, [](R r) { return r.drift.threshold_time_s; }),
          "threshold_time_s", "threshold_time_bound_s"),
      of_event(
          compared("drift.threshold_time_bound_s", error, at_event, kAtEnd, [](R r) { return r.drift.threshold_time_bound_s; }),
          "threshold_time_s", "threshold_time_bound_s"),
      of_event(compared("drift.threshold_crossing", word, at_event, kAtEnd,
                        [](R r) { return r.drift.threshold_crossing ? Json(to_string(*r.drift.threshold_crossing)) : Json(); }),
               "threshold_time_s", "threshold_time_bound_s"),
      object_or_nothing("drift.digits", [](R r) { return drift_digits(r).has_value(); }),
      told("drift.digits.axis_final_rad", kFromRows, kDigits, [](R r) { return drift_digits(r)->axis_final_rad; }),
      told("drift.digits.axis_max_rad", kFromRows, kDigits, [](R r) { return drift_digits(r)->axis_max_rad; }),
      told("drift.digits.attitude_final_rad", kFromRows, kDigits, [](R r) { return drift_digits(r)->attitude_final_rad; }),
      told("drift.digits.spin_final_rad", kFromRows, kDigits, [](R r) { return drift_digits(r)->spin_final_rad; }),

      // Body axis 3 in the laboratory (East, North, Up).
      of_rows(object_or_null("motion", [](R r) { return !r.rows.empty(); })),
      of_last_row("axis_L",
                  compared(
                      "motion.axis_final_L", attitude, end, kAtEnd, [](R r) { return r.rows.back().axis_L; }, vector)),
      of_last_row("ref_axis_L", compared(
                                    "motion.reference_axis_final_L", attitude, end, kAtEnd,
                                    [](R r) { return r.rows.back().ref_axis_L; }, vector)),
      compared(
          "motion.axis_mean_L", attitude, rows, kFromRows, [](R r) { return axis_means(r).axis_L; }, vector),
      compared(
          "motion.reference_axis_mean_L", attitude, rows, kFromRows, [](R r) { return axis_means(r).ref_axis_L; }, vector)};
        }();

constexpr auto kRotorMembers = [] {
  using enum FigureKind;
  using enum FigureScope;
  using MemberForm::document, MemberForm::vector;
  return std::array{
      // The rotor of a gyrostat, on the rotating Earth: its rate relative to the body, and its angle since the release.
      object_or_nothing("rotor", [](R r) { return !r.rows.empty() && r.rows.front().rotor; }),
      compared("rotor.rate_initial_rad_s", derived, any, kAtEnd,
               [](R r) { return of_rotor_row(r, false, &BasicRotorRow<double>::rate_rad_s); }),
      compared("rotor.rate_final_rad_s", derived, end, kAtEnd,
               [](R r) { return of_rotor_row(r, true, &BasicRotorRow<double>::rate_rad_s); }),
      compared("rotor.angle_final_rad", derived, end, kAtEnd,
               [](R r) { return of_rotor_row(r, true, &BasicRotorRow<double>::angle_rad); }),
      of_rows(object("growth_of_disturbances")),
      compared("growth_of_disturbances.lyapunov_exponent_1_s", time, span, kAtEnd,
               [](R r) { return r.verdict.lyapunov_exponent_1_s; }),
      compared("growth_of_disturbances.round_off_grown_s", error, span, kAtEnd,
               [](R r) { return r.verdict.round_off_grown_s; }),
      compared("growth_of_disturbances.earth_grown_s", time, span, kAtEnd, [](R r) { return r.verdict.earth_grown_s; }),
      // The events of a Cardan suspension on its way.
      list("gimbal_events", [](R r) { return r.gimbal_events.size(); }),
      of_event(compared("gimbal_events.*.type", word, at_event, kFromRows,
                        [](R r, I i) { return to_string(r.gimbal_events[i].kind); })),
      of_event(compared("gimbal_events.*.t_s", time, at_event, kFromRows, [](R r, I i) { return r.gimbal_events[i].t_s; })),
      of_event(
          compared("gimbal_events.*.bound_s", error, at_event, kFromRows, [](R r, I i) { return r.gimbal_events[i].bound_s; })),
      told("gimbal_events.*.axis_angle_rad", kFromRows, kIsRow, [](R r, I i) { return r.gimbal_events[i].axis_angle_rad; }),
      told("gimbal_events.*.outer_rate_rad_s", kFromRows, kIsRow, [](R r, I i) { return r.gimbal_events[i].outer_rate_rad_s; }),
      // The times at which dry friction brought a motion to rest.
      list("stops", [](R r) { return r.stops.size(); }),
      of_event(
          compared("stops.*.prediction", word, at_event, kFromRows, [](R r, I i) { return to_word(r.stops[i].prediction); })),
      of_event(compared("stops.*.t_s", time, at_event, kFromRows, [](R r, I i) { return r.stops[i].t_s; })),
      of_event(compared("stops.*.bound_s", error, at_event, kFromRows, [](R r, I i) { return r.stops[i].bound_s; })),
  };
}();

constexpr auto kSolutionMembers = [] {
  using enum FigureKind;
  using enum FigureScope;
  return std::array{
      object_or_null("headline", [](R r) { return r.scene.scenario().headline.has_value(); }),
      told("headline.quantity", kFromRows, kHeadline, [](R r) { return r.scene.scenario().headline->quantity; }),
      told("headline.at_s", kFromRows, kHeadline, [](R r) { return check_headline(r)->at_s; }),
      told("headline.stated", kFromRows, kHeadline, [](R r) { return r.scene.scenario().headline->value; }),
      told("headline.tolerance", kFromRows, kHeadline, [](R r) { return r.scene.scenario().headline->tolerance; }),
      told("headline.computed", kFromRows, kHeadline, [](R r) { return check_headline(r)->computed; }),
      told("headline.difference", kFromRows, kHeadline, [](R r) { return check_headline(r)->difference; }),
      told("headline.met", kFromRows, kHeadline, [](R r) { return check_headline(r)->met; }),
      told("headline.origin", kFromRows, kHeadline, [](R r) { return r.scene.scenario().headline->origin; }),

      object("solution"),
      work("solution.reason", [](R r) { return r.solution.reason; }),
      work("solution.observer", [](R r) { return to_string(r.solution.observer); }),
      work("solution.model", [](R r) { return to_string(r.solution.form); }),
      work("solution.method", [](R r) { return to_string(r.solution.method); }),
      work("solution.precision", [](R r) { return r.solution.precision; }),
      work("solution.relative_tolerance", [](R r) { return relative_tolerance(r.solution); }),
      work("solution.step_s", [](R r) { return r.solution.step_s; }),
      work("solution.steps_accepted", [](R r) { return r.solution.counters.accepted; }),
      work("solution.steps_rejected", [](R r) { return r.solution.counters.rejected; }),
      work("solution.right_hand_side_evaluations", [](R r) { return r.solution.counters.evaluations; }),
      work("solution.status", [](R r) { return trouble(r.solution); }),
      object("certificate"),
      work("certificate.reason", [](R r) { return r.certificate.reason; }),
      work("certificate.observer", [](R r) { return to_string(r.certificate.observer); }),
      work("certificate.model", [](R r) { return to_string(r.certificate.form); }),
      work("certificate.method", [](R r) { return to_string(r.certificate.method); }),
      work("certificate.precision", [](R r) { return r.certificate.precision; }),
      work("certificate.relative_tolerance", [](R r) { return relative_tolerance(r.certificate); }),
      work("certificate.step_s", [](R r) { return r.certificate.step_s; }),
      work("certificate.steps_accepted", [](R r) { return r.certificate.counters.accepted; }),
      work("certificate.steps_rejected", [](R r) { return r.certificate.counters.rejected; }),
      work("certificate.right_hand_side_evaluations", [](R r) { return r.certificate.counters.evaluations; }),
      work("certificate.status", [](R r) { return trouble(r.certificate); }),
      of_rows(compared("attitude_bound_rad", error, rows, kAtEnd, [](R r) { return r.attitude_bound_rad; })),
      list("invariants", [](R r) { return r.invariants.size(); }),
      told("invariants.*.name", kFromRows, kLabel, [](R r, I i) { return r.invariants[i].name; }),
      told("invariants.*.unit", kFromRows, kLabel, [](R r, I i) { return r.invariants[i].unit; }),
      sized_by("scale",
               compared("invariants.*.initial", input, any, kFromRows, [](R r, I i) { return r.invariants[i].initial; })),
      compared("invariants.*.largest_change", conserved, rows, kFromRows,
               [](R r, I i) { return r.invariants[i].largest_change; }),
      compared("invariants.*.scale", derived, rows, kFromRows, [](R r, I i) { return r.invariants[i].scale; }),
      list("theory", [](R r) { return r.theory.size(); }),
      told("theory.*.name", kFromRows, kLabel, [](R r, I i) { return r.theory[i].name; }),
      told("theory.*.statement", kFromRows, kLabel, [](R r, I i) { return r.theory[i].statement; }),
      told("theory.*.unit", kFromRows, kLabel, [](R r, I i) { return r.theory[i].unit; }),
      sized_by("predicted_error",
               compared("theory.*.predicted", derived, span, kFromRows, [](R r, I i) { return r.theory[i].predicted; })),
      compared("theory.*.predicted_error", error, span, kFromRows, [](R r, I i) { return r.theory[i].predicted_error; }),
      told("theory.*.applies", kFromRows, kWords, [](R r, I i) { return r.theory[i].applies; }),
      sized_by("computed_error",
               compared("theory.*.computed", derived, motion, kFromRows, [](R r, I i) { return r.theory[i].computed; })),
      compared("theory.*.computed_error", error, span, kFromRows, [](R r, I i) { return r.theory[i].computed_error; }),
      // Why the drift is what it is, in sentences; left out where theory has none to say.
      list(
          "why", [](R r) { return r.why.empty() ? std::nullopt : std::optional(r.why.size()); }, true),
      told("why.*.name", kFromRows, kLabel, [](R r, I i) { return r.why[i].name; }),
      told("why.*.text", kFromRows, kWords, [](R r, I i) { return r.why[i].text; }),
      told(
          "why.*.numbers", kFromRows, kWords, [](R r, I i) { return numbers_of(r, i); }, MemberForm::document),
  };
}();

constexpr auto kLastMembers = [] {
  using enum FigureKind;
  using enum FigureScope;
  using MemberForm::document, MemberForm::words;
  return std::array{
      object_or_nothing("ledger", [](R r) { return r.ledger.has_value(); }),
      compared("ledger.observer", word, any, kFromRows, [](R r) { return to_string(r.ledger->observer); }),
      compared("ledger.tau_phys_max_N_m", derived, rows, kFromRows, [](R r) { return r.ledger->largest.tau_phys; }),
      compared("ledger.tau_cor_max_N_m", derived, rows, kFromRows, [](R r) { return r.ledger->largest.tau_cor; }),
      compared("ledger.tau_trans_max_N_m", derived, rows, kFromRows, [](R r) { return r.ledger->largest.tau_trans; }),
      compared("ledger.tau_cent_max_N_m", derived, rows, kFromRows, [](R r) { return r.ledger->largest.tau_cent; }),
      compared("ledger.dL_dt_max_N_m", derived, rows, kFromRows, [](R r) { return r.ledger->largest.dL_dt; }),
      compared("ledger.residual_max_N_m", error, rows, kFromRows, [](R r) { return r.ledger->largest.residual; }),
      compared("ledger.residual_over_largest_torque", error, rows, kFromRows,
               [](R r) { return r.ledger->largest.relative_residual(); }),

      object("effects"),
      compared(
          "effects.modelled", word, any, kAtEnd, [](R r) { return Json(effect_names(r.modelled, true)); }, words),
      told(
          "effects.left_out", kAtEnd, kSelected, [](R r) { return Json(effect_names(r.modelled, false)); }, words),
      // The effects chosen for a scene that left them open, and the error reached where one was asked for.
      object_or_nothing("selection", [](R r) { return r.selection.has_value(); }),
      compared("selection.accuracy_rad", input, any, kAtEnd, [](R r) { return r.selection->accuracy_rad; }),
      told(
          "selection.switched_on", kAtEnd, kSelected, [](R r) { return r.selection->switched_on; }, words),
      told(
          "selection.left_out", kAtEnd, kSelected, [](R r) { return r.selection->left_out; }, words),
      compared("selection.left_out_drift_rad", derived, span, kAtEnd, [](R r) { return r.selection->left_out_drift_rad; }),
      object_or_nothing("accuracy", [](R r) { return r.accuracy.has_value(); }),
      compared("accuracy.asked_rad", input, any, kAtEnd, [](R r) { return r.accuracy->asked_rad; }),
      compared("accuracy.reached_rad", error, span, kAtEnd, [](R r) { return r.accuracy->reached_rad; }),
      compared("accuracy.reached", word, span, kAtEnd, [](R r) { return r.accuracy->reached(); }),
      told("accuracy.attempts", kAtEnd, kEffort, [](R r) { return r.accuracy->attempts; }),
      told(
          "notes", kFromRows, kWords, [](R r) { return r.notes; }, words),
      told(
          "scenario", kAtEnd, "its keys are compared one by one, before any figure",
          [](R r) { return json_of(canonical_json(r.scene.scenario())); }, document),
      object("provenance"),
      told("provenance.program", kAtEnd, kOrigin, [](R) { return "earthtop"; }),
      told("provenance.version", kAtEnd, kOrigin, [](R) { return build_info().version; }),
      told("provenance.commit", kAtEnd, kOrigin, [](R) { return build_info().commit; }),
      told("provenance.compiler", kAtEnd, kOrigin, [](R) { return build_info().compiler; }),
      told("provenance.flags", kAtEnd, kOrigin, [](R) { return build_info().flags; }),
      told(
          "provenance.libraries", kAtEnd, kOrigin, [](R) { return libraries(); }, document),
      told("provenance.scenario_sha256", kAtEnd, kOfScenario, [](R r) { return r.scene.sha256(); }),
      list("provenance.constants", [](R r) { return constants_used(r.scene).size(); }),
      told("provenance.constants.*.name", kAtEnd, kOfScenario, [](R r, I i) { return constants_used(r.scene)[i].name; }),
      told("provenance.constants.*.value", kAtEnd, kOfScenario, [](R r, I i) { return constants_used(r.scene)[i].value; }),
      told("provenance.constants.*.unit", kAtEnd, kOfScenario, [](R r, I i) { return constants_used(r.scene)[i].unit; }),
      told("provenance.constants.*.source", kAtEnd, kOfScenario, [](R r, I i) { return constants_used(r.scene)[i].source; }),
  };
}();

constexpr auto kMembers = joined(kFirstMembers, kTopMembers, kDriftMembers, kMotionMembers, kRotorMembers, kContactMembers,
                                 kContactBalanceMembers, kSolutionMembers, kSensitivityMembers, kLastMembers);

constexpr bool each_is_compared_or_says_why_not() {
  for (const SummaryMember& member : kMembers)
    if ((member.kind == FigureKind::not_compared) != !member.why_not.empty()) return false;
  return true;
}
static_assert(each_is_compared_or_says_why_not(), "a figure is compared, or says why it is not");

constexpr bool scopes_are_whole() {
  for (const SummaryMember& member : kMembers) {
    if ((member.scope == FigureScope::at_event) != !member.event_time.empty()) return false;
    if (member.of_row.empty()) continue;
    if (member.scope != FigureScope::end) return false;
    if (std::none_of(kDriftQuantities.begin(), kDriftQuantities.end(),
                     [&](const RowQuantity& quantity) { return quantity.is_called(member.of_row); }))
      return false;
  }
  return true;
}
static_assert(scopes_are_whole(), "a figure of the end names a quantity of the rows, a figure of an event the event's time");

/// Whether a path is a member's, in which a star stands for the number of an element.
constexpr bool is_of(std::string_view member, std::string_view path) {
  while (!member.empty() && !path.empty()) {
    const std::string_view wanted = member.substr(0, member.find('.')), step = path.substr(0, path.find('.'));
    if (wanted != step && wanted != "*") return false;
    member.remove_prefix(std::min(wanted.size() + 1, member.size()));
    path.remove_prefix(std::min(step.size() + 1, path.size()));
  }
  return member.empty() && path.empty();
}

constexpr bool headlines_are_figures() {
  std::string_view names = scenario::kSummaryFigures;
  while (!names.empty()) {
    const std::string_view name = names.substr(0, names.find('|'));
    names.remove_prefix(std::min(name.size() + 1, names.size()));
    bool found = false;
    for (const SummaryMember& member : kMembers)
      found = found || (is_of(member.path, name) && member.form == MemberForm::value && member.kind > FigureKind::outcome);
    if (!found) return false;
  }
  return true;
}
static_assert(headlines_are_figures(), "a headline may be about a number of the summary that is compared");

}  // namespace
}  // namespace figure_table

std::span<const SummaryMember> summary_members() { return figure_table::kMembers; }

}  // namespace earthtop
