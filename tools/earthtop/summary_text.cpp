// SPDX-License-Identifier: GPL-3.0-or-later
#include "summary_text.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include "contact_text.hpp"
#include "earthtop/results/headline.hpp"
#include "earthtop/results/results.hpp"
#include "earthtop/results/top_lines.hpp"
#include "number_text.hpp"
#include "results/compared_words.hpp"
#include "screen.hpp"
#include "summary_parts.hpp"
#include "text/number_words.hpp"
#include "wrapped.hpp"

namespace earthtop::tool {
namespace {

std::string grouped(std::int64_t number) {
  std::string digits = fmt::format("{}", number);
  for (auto at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > (number < 0 ? 1 : 0); at -= 3)
    digits.insert(static_cast<std::size_t>(at), 1, ',');
  return digits;
}

std::string_view axes_of(Method method, Observer observer) {
  if (method == Method::fourier)
    return observer == Observer::laboratory ? "axes of the effective vertical" : "the laboratory's axes";
  switch (observer) {
    case Observer::laboratory: return "the laboratory's axes";
    case Observer::body: return "the body's axes";
    case Observer::inertial: return "inertial axes";
  }
  return "";
}

/// The angle by which the Earth turns, whichever way it does.
std::string_view earth_angle(const Scene& scene) { return scene.rotation_rate_rad_s() < 0 ? "|Ω| t" : "Ω t"; }

void write_scene(TextPage& page, const Scene& scene, double reached_s) {
  const Site& site = scene.site();
  const double turn = std::abs(scene.rotation_rate_rad_s()) * reached_s;
  page.entry("Place", fmt::format("latitude {}°, longitude {}°, height {} m; gravity {} m/s²", site.latitude_deg,
                                  site.longitude_deg, site.height_m, site.gravity_m_s2));
  page.entry("Earth", fmt::format("Ω = {} rad/s; in {} it turns by {} = {:.5g} rad = {}", scene.rotation_rate_rad_s(),
                                  time_text(reached_s), earth_angle(scene), turn, pictured(turn)));
  page.entry("Compared", fmt::format("the motion with {}, minus the motion without:", compared_words(scene.scenario()).cause));
  page.entry("", matching_rule(scene.scenario()));
}

void write_top(TextPage& page, const Scene& scene) {
  page.heading("Your top");
  for (const auto& [label, text] : top_lines(scene.top())) page.entry(fmt::format("  {}", label), text, 19);
}

/// A part of the drift; what is no larger than the bound on the whole is not known to differ from 0.
std::string part_of_drift(double part, double bound) {
  return std::abs(part) <= bound ? fmt::format("0 rad within {:.1e}", bound)
                                 : fmt::format("{:+.6e} rad = {}", part, pictured(part));
}

void write_drift(TextPage& page, const RunResult& result) {
  if (!has_drift(result)) {
    page.heading("Drift");
    page.line("  not known: the run has no row beyond the release");
    return;
  }
  const DriftRow* last = last_reliable_row(result);
  if (last == nullptr || last->t_s == 0) {
    page.heading("Drift");
    page.line("  none that can be trusted; {} are written, marked as not reliable",
              last == nullptr ? "all rows" : "the rows beyond the release");
    return;
  }
  const DriftSummary drift = reliable_drift(result);
  page.heading(fmt::format("Drift after {}", time_text(last->t_s)));
  std::string share;
  if (drift.axis_final_over_earth_angle)
    share = fmt::format(" = {:.4g} {}", *drift.axis_final_over_earth_angle, earth_angle(result.scene));
  page.line("  spin axis   {} = {}{}", page.strong(with_bound(drift.axis_final_rad, drift.axis_bound_rad, "rad")),
            page.strong(pictured(drift.axis_final_rad)), share);
  if (const auto digits = drift_digits(result); digits && last == &result.rows.back())
    page.line("  in full     {} rad", digits->axis_final_rad);
  if (result.verdict.trusts(result.drift.axis_max_at_s))
    page.line("  at most     {} = {}, at {:.6g} s",
              with_bound(result.drift.axis_max_rad, result.drift.axis_max_bound_rad, "rad"),
              pictured(result.drift.axis_max_rad), result.drift.axis_max_at_s);
  if (drift.azimuth_final_rad)
    page.line("  azimuth    {} (+ is clockwise seen from above)",
              part_of_drift(*drift.azimuth_final_rad, horizontal(*last) > 0 ? drift.axis_bound_rad / horizontal(*last) : 0));
  else
    page.line("  azimuth     none: an axis is vertical");
  page.line("  tilt       {} (+ is farther from Up)", part_of_drift(drift.tilt_final_rad, drift.axis_bound_rad));
  page.line("  spin angle {}", part_of_drift(drift.spin_final_rad, drift.attitude_bound_rad));
  page.line("  attitude    {} (the whole turn between the two)",
            with_bound(drift.attitude_final_rad, drift.attitude_bound_rad, "rad"));
  if (const auto& rotor = last->rotor) {
    const std::string axis = with_bound(rotor->drift_axis_rad, rotor->drift_axis_bound_rad, "rad");
    page.line("  rotor axis  {}",
              judges_rotor_axis(result) ? page.strong(axis) + ", which verdict and threshold follow" : axis);
    page.line("  rotor rate  {}, relative to the body",
              with_bound(rotor->drift_rate_rad_s, rotor->drift_rate_bound_rad_s, "rad/s"));
    page.line("  and angle   {}", with_bound(rotor->drift_angle_rad, rotor->drift_angle_bound_rad, "rad"));
  }
  if (const auto& gimbals = last->gimbals) {
    const auto angle = [&](double drift_rad, double bound_rad, bool is_judged) {
      const std::string text = with_bound(drift_rad, bound_rad, "rad");
      return is_judged ? page.strong(text) + ", which verdict and threshold follow" : text;
    };
    page.line("  outer angle {}", angle(gimbals->drift_outer_angle_rad, gimbals->drift_outer_angle_bound_rad,
                                        gimbals->headline == GimbalHeadline::outer));
    page.line("  inner angle {}", angle(gimbals->drift_inner_angle_rad, gimbals->drift_inner_angle_bound_rad,
                                        gimbals->headline == GimbalHeadline::inner));
  }
  const char* label = "tip";
  for (const std::string& line : tip_drift_lines(result, *last, drift.tip_bound_m.value_or(0))) {
    page.line("  {:<11} {}", label, line);
    label = "";
  }
  if (last != &result.rows.back())
    page.line("  later rows are written, marked as not reliable");
  else if (!is_all_reliable(result))
    page.line("  some rows before are written, marked as not reliable");
}

/// When spin and tilt come to the values asked for, the spin that is left, and the swing of a pendulum.
void write_motion(TextPage& page, const RunResult& result) {
  if (!result.motion) return;
  const MotionReport& motion = *result.motion;
  const Scenario& scenario = result.scene.scenario();
  const double spin = result.rows.front().w_LB_B[2], left = motion.spin_end_rad_s.rotating.value;
  constexpr double kTold = 1e-3;  // of the spin
  if (std::abs(left - spin) > kTold * std::abs(spin))
    page.entry("Spin", fmt::format("{} at the end, of {:.6g} rad/s",
                                   with_bound(left, motion.spin_end_rad_s.rotating.bound, "rad/s"), spin));
  const auto reached = [&](const std::optional<MotionReport::Reached>& when, const std::string& what) {
    if (!when) return;
    page.entry("Reached", when->rotating_s
                              ? fmt::format("{} at t = {}", what, time_with_bound(*when->rotating_s, when->rotating_bound_s))
                              : fmt::format("{} is not reached", what));
    if (!when->rotating_is_sure)
      page.entry("", page.warning("within its error it may be reached at another time, or not at all"));
  };
  reached(motion.spin, fmt::format("a spin of {} rad/s", scenario.reported_spin_rad_s.value_or(0)));
  reached(motion.tilt, fmt::format("a tilt of {} deg", scenario.reported_tilt_deg.value_or(0)));
  if (const auto& swing = motion.swing) {
    const auto degrees = [](double rad) { return rad * 180 / std::numbers::pi; };
    page.entry(
        "Swing",
        fmt::format(
            "semi-axes {:.6g} and {:.4g} deg at the release, {:.6g} and {:.4g} deg at the end (the second one: + is clockwise)",
            degrees(swing->major_start_rad.rotating.value), degrees(swing->minor_start_rad.rotating.value),
            degrees(swing->major_end_rad.rotating.value), degrees(swing->minor_end_rad.rotating.value)));
    page.entry(
        "", fmt::format("its plane turns by {}, without {} by {} (+ is clockwise seen from above)",
                        with_bound(swing->plane_rate_rad_s.rotating.value, swing->plane_rate_rad_s.rotating.bound, "rad/s"),
                        compared_words(scenario).agent,
                        with_bound(swing->plane_rate_rad_s.reference.value, swing->plane_rate_rad_s.reference.bound, "rad/s")));
  }
}

/// A prediction of theory with its error, and the computed number. @param sign  -1 for a rate that is counted counterclockwise:
/// the page counts azimuths clockwise
std::string theory_line(const TheoryReport& report, double sign) {
  if (!report.applies)
    return fmt::format("first-order theory does not apply: it leaves out {:.1e} {} of {:+.3e}", report.predicted_error,
                       report.unit, 0.0 + sign * report.predicted);
  const std::string predicted = report.predicted == 0 ? "0" : fmt::format("{:+.4e}", sign * report.predicted);
  return fmt::format("first-order theory: {} ± {:.1e} {}", predicted, report.predicted_error, report.unit);
}

/// Why the drift is what it is.
void write_why(TextPage& page, const RunResult& result) {
  const char* label = "Why";
  for (const WhySentence& sentence : result.why) page.entry(std::exchange(label, ""), sentence.text);
}

void write_trend(TextPage& page, const RunResult& result) {
  if (const auto& secular = result.drift.secular) {
    if (secular->azimuth_rate_rad_s) {
      page.entry("Trend", fmt::format("azimuth drifts by {:+.4e} ± {:.1e} rad/s (+ is clockwise seen from above)",
                                      *secular->azimuth_rate_rad_s, secular->azimuth_rate_bound_95_rad_s.value_or(0)));
      if (secular->of_window)
        page.entry("", fmt::format("the mean over {:.6g} to {:.6g} s and no more than that, as {}", secular->window_s[0],
                                   secular->window_s[1], secular->reason));
      else if (result.solution.method == Method::fourier)
        page.entry("", fmt::format("± is a bound; the rates of the motions' Fourier sums tell it, for all time; the run covers "
                                   "{:.3g} turns of precession",
                                   secular->turns_seen.value_or(0)));
      else
        page.entry("", fmt::format("± is a 95 % interval; from {:.3g} turns of precession, {:.6g} to {:.6g} s",
                                   secular->turns_seen.value_or(0), secular->window_s[0], secular->window_s[1]));
    } else {
      page.entry("Trend", "not determined: " + secular->reason);
    }
    for (const TheoryReport& report : result.theory)
      if (report.name == "precession_rate_change") page.entry("", theory_line(report, -1));
    if (secular->azimuth_oscillation_rad)
      page.entry("Swings", *secular->azimuth_oscillation_rad <= secular->azimuth_oscillation_bound_rad
                               ? fmt::format("none beyond the error of {:.1e} rad", secular->azimuth_oscillation_bound_rad)
                               : fmt::format("up to {:.3g} rad of azimuth to either side of the trend",
                                             *secular->azimuth_oscillation_rad));
  }
  for (const TheoryReport& report : result.theory) {
    if (report.name == "precession_rate_change") continue;  // printed above, with the trend
    page.entry("Theory",
               fmt::format("{}: {}; {:.6g} {} computed", spoken(report.name), theory_line(report, 1),
                           std::abs(report.computed.value_or(0)) <= report.computed_error.value_or(0) ? 0 : *report.computed,
                           report.unit));
  }
  write_threshold(page, result);
  write_motion(page, result);
  for (const InvariantReport& invariant : result.invariants) {
    const std::optional<double> share = share_of(invariant.largest_change, invariant.scale);
    page.entry("Conserved", fmt::format("{} to {:.1e}{}{}", spoken(invariant.name), share.value_or(invariant.largest_change),
                                        share ? " of its size" : " ", share ? "" : invariant.unit));
  }
}

/// The bound on a derivative's own error, where the digits shown do not all hold.
std::string loose_bound(const InputSensitivity& input) {
  constexpr double kShown = 1e-6;
  if (input.axis_bound_rad <= kShown * std::abs(input.axis_rad)) return "";
  return fmt::format("; to ± {:.1e} rad", input.axis_bound_rad);
}

void write_sensitivities(TextPage& page, const RunResult& result) {
  const SensitivityReport& report = *result.sensitivities;
  if (!report.unavailable.empty()) {
    page.entry("Inputs", page.warning("no sensitivities: " + report.unavailable));
    return;
  }
  page.entry("Inputs", fmt::format("per unit of the input, the axis drift at {} changes by", time_text(report.at_s)));
  for (const InputSensitivity& input : report.inputs) {
    if (!input.unavailable.empty()) {
      page.entry("", page.warning(fmt::format("{}: {}", input.name, input.unavailable)));
      continue;
    }
    page.entry("",
               fmt::format("{:+.5e} rad  {:<20} (now {:.9g}{}){}", input.axis_rad, input.name, input.value, loose_bound(input),
                           input.axis_error_rad > 0 ? fmt::format(", its error makes {:.2e} rad", input.axis_error_rad) : ""));
  }
}

std::string described(const IntegrationReport& report) {
  const std::string precision = report.precision == to_string(Precision::bits53) ? "" : spoken(report.precision) + ", ";
  return fmt::format("{}{} in {}, {}{} evaluations, {:.3g} s", spoken(std::string(to_string(report.method))),
                     report.form == ModelForm::reduced ? " without the spin" : "", axes_of(report.method, report.observer),
                     precision, grouped(report.counters.evaluations), report.seconds);
}

}  // namespace

std::string summary_text(const RunResult& result, const Written& where, bool changed, const Screen& screen,
                         std::string_view picture) {
  const Scenario& scenario = result.scene.scenario();
  TextPage page(screen);
  page.heading(printable(scenario.title.empty() ? scenario.name : scenario.title));
  write_scene(page, result.scene, result.reached_s);
  write_status(page, result);
  page.gap();
  write_top(page, result.scene);
  page.gap();
  write_drift(page, result);
  page.gap();
  write_verdict(page, result);
  write_stops(page, result);
  write_lines(page, contact_event_lines(result));
  write_choice(page, result);
  write_accuracy(page, result);
  write_trend(page, result);
  write_why(page, result);
  write_lines(page, contact_balance_lines(result));
  write_lines(page, prediction_change_lines(result));
  if (result.sensitivities) write_sensitivities(page, result);
  write_known_to(page, result);
  if (const auto check = check_headline(result)) write_headline(page, *check, result, changed);
  page.entry("Computed", described(result.solution));
  if (!is_partial(result)) page.entry("Checked", described(result.certificate));
  write_notes(page, result);
  if (const auto& ledger = result.ledger)
    page.entry("Torques", fmt::format("torques.csv, as the {} observer counts them: they miss dL'/dt by {:.1e} N m at most",
                                      to_string(ledger->observer), ledger->largest.residual));
  page.entry("Files",
             fmt::format("trajectory.csv, {}summary.json, drift.svg, timing.json", result.ledger ? "torques.csv, " : ""));
  TextPage end(screen);
  write_end(end, where, false);
  return std::move(page).text() + std::string(picture) + std::move(end).text();
}

}  // namespace earthtop::tool
