// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/finding.hpp"

#include <fmt/core.h>

#include <cmath>
#include <cstdlib>
#include <numbers>

#include "earthtop/elementary.hpp"
#include "earthtop/scene/top_figures.hpp"
#include "earthtop/vectors.hpp"
#include "report/html.hpp"
#include "report/known_html.hpp"
#include "text/short_number.hpp"

namespace earthtop::report {

std::optional<PlaneTurn> plane_turn(const Run& run) {
  const auto with = run.number("/motion/swing/plane_rate_rad_s"), without = run.number("/motion/swing/apsidal_rate_rad_s"),
             reached = run.number("/outcome/reached_s");
  if (!with || !without || !reached) return std::nullopt;
  const double bound = run.number("/motion/swing/plane_rate_bound_rad_s").value_or(kNoNumber) +
                       run.number("/motion/swing/apsidal_rate_bound_rad_s").value_or(kNoNumber);
  return PlaneTurn{(*with - *without) * *reached, bound * *reached};
}

namespace {

/// The last drift that can be trusted; of a run without one the last of all.
struct LastDrift {
  double axis_rad = kNoNumber, bound_rad = kNoNumber, at_s = 0;
  bool is_known = false;  ///< whether the verdict trusts it
};
LastDrift last_drift(const Run& run) {
  const auto drift = run.number("/drift/reliable/axis_rad"), bound = run.number("/drift/reliable/axis_bound_rad"),
             at = run.number("/drift/reliable/at_s");
  if (drift && bound && at && *at > 0) return {*drift, *bound, *at, true};
  return {run.number("/drift/axis_final_rad").value_or(kNoNumber), run.number("/drift/axis_bound_rad").value_or(kNoNumber),
          run.number("/outcome/reached_s").value_or(0), false};
}

/// "a minute", "2 hours", "12.5 s".
std::string duration_html(double t_s) {
  struct Span {
    const char* name;
    double s;
  };
  constexpr Span kSpans[] = {{"day", 86400}, {"hour", 3600}, {"minute", 60}};
  const auto element = [&](const std::string& words) { return fmt::format("<data value=\"{}\">{}</data>", t_s, words); };
  for (const Span& span : kSpans) {
    const double count = t_s / span.s;
    if (count < 1 || count != std::floor(count)) continue;
    if (count == 1) return element(fmt::format("{} {}", span.name[0] == 'h' ? "an" : "a", span.name));
    return element(fmt::format("{:.0f}", count)) + fmt::format(" {}s", span.name);
  }
  return t_s == 1 ? element("a second") : element(with_powers(fmt::format("{:.4g}", t_s))) + " s";
}

/// The angle that the title tells: of the axis, or, of a pendulum, of its plane of swing, or, where the axis stays, about it.
struct ToldAngle {
  double rad, bound_rad;
  ReadableUnit unit;
  enum { of_axis, of_plane, about_axis } which;
};
ToldAngle told_angle(const Run& run, const LastDrift& drift) {
  if (const auto turn = plane_turn(run); turn && turn->rad != 0 && run.word("/drift/verdict") == "reliable")
    return {std::abs(turn->rad), turn->bound_rad, angle_unit(1), ToldAngle::of_plane};
  const auto turned = run.number("/drift/reliable/attitude_rad"), bound = run.number("/drift/reliable/attitude_bound_rad");
  if (drift.is_known && drift.axis_rad == 0 && turned && *turned > 0)
    return {*turned, bound.value_or(kNoNumber), angle_unit(*turned), ToldAngle::about_axis};
  return {drift.axis_rad, drift.bound_rad, angle_unit(drift.axis_rad), ToldAngle::of_axis};
}

std::string short_html(double si, double error_si, double per_si) {
  const double error = std::isfinite(error_si) ? error_si : 0;
  return fmt::format("<data value=\"{}\">{}</data>", si, with_powers(short_number(si * per_si, error * per_si)));
}

/// "235.2 arcseconds".
std::string angle_in_words(double rad, double error_rad, const ReadableUnit& unit) {
  return short_html(rad, error_rad, unit.per_si) + " " + std::string(unit.name);
}

std::string short_length(double m, double error_m) {
  const ReadableUnit unit = length_unit(m);
  return short_html(m, error_m, unit.per_si) + escaped(unit.symbol);
}

/// A length that the scenario gives, without digits that it does not have: "30 mm".
std::string given_length(double m) {
  const ReadableUnit unit = length_unit(m);
  return fmt::format("<data value=\"{}\">{:.4g}</data>{}", m, m * unit.per_si, escaped(unit.symbol));
}

/// The thing that drifts, in a word that fits the scenario.
const char* name_of_top(const Run& run) {
  if (run.number("/motion/swing/plane_rate_rad_s")) return "pendulum";
  if (!run.scene) return "top";
  const Scenario& scenario = run.scene->scenario();
  if (scenario.gimbals || scenario.rotor) return "gyroscope";
  const TopFigures top = run.scene->top();
  const Vec3<double> centre(top.center_of_mass_m[0], top.center_of_mass_m[1], top.center_of_mass_m[2]);
  const auto& moments = top.moments_about_center_kg_m2;
  if (run.has_contact) return centre.norm() == 0 && moments[0] == moments[1] && moments[1] == moments[2] ? "ball" : "top";
  if (run.scene->symmetry_axis() != 2) return "body";
  return centre.norm() == 0 ? "gyroscope" : "top";
}

/// "an eighth of the width of the Sun's disc"; nothing for an angle too small to be told in such parts.
std::string beside_the_sun(double rad) {
  constexpr double kSun_rad = 1919.26 / 3600 * std::numbers::pi / 180;  // mean angular diameter
  constexpr double kMostParts = 1e9;
  constexpr const char* kParts[] = {"a third",   "a quarter", "a fifth", "a sixth",
                                    "a seventh", "an eighth", "a ninth", "a tenth"};
  const double share = std::abs(rad) / kSun_rad, parts = 1 / share;
  if (!(parts < kMostParts)) return "";
  const std::string disc = " the width of the Sun's disc";
  if (share >= 9.5) return fmt::format("{:.0f} times", share) + disc;
  if (share >= 1.45) return fmt::format("{:.1f} times", share) + disc;
  if (share >= 0.85) return disc.substr(1);
  if (share >= 0.58) return "two thirds of" + disc;
  if (parts < 2.5) return "half" + disc;
  if (parts < 10.5) return std::string(kParts[static_cast<std::size_t>(std::floor(parts + 0.5)) - 3]) + " of" + disc;
  std::string digits = fmt::format("{:.0f}", std::atof(fmt::format("{:.1e}", parts).c_str()));
  for (std::size_t end = digits.size(); end > 3; end -= 3) digits.insert(end - 3, ",");
  return "1/" + digits + " of" + disc;
}

/// The length that an angle of the axis makes: at the centre of mass where that lies on the axis, else a metre from the pivot. The tip of a
/// top on a table moves by itself.
std::string length_words(const Run& run, const LastDrift& drift) {
  if (run.has_contact) {
    for (const compare::Row& row : run.listed.rows) {
      if (row.t_s != drift.at_s) continue;
      const double far = value(row, column("drift_tip_m")), error = value(row, column("drift_tip_bound_m"));
      if (std::isfinite(far))
        return "Its tip stands " + short_length(far, error) + " from where it would be " + std::string(run.compared().if_not);
    }
  }
  const double chord = 2 * real::sin(std::abs(drift.axis_rad) / 2),
               error = std::isfinite(drift.bound_rad) ? drift.bound_rad : 0;
  if (run.scene && !run.has_contact) {
    const auto& centre = run.scene->top().center_of_mass_m;
    const double far = std::abs(centre[2]);
    if (far > 0 && std::abs(centre[0]) + std::abs(centre[1]) <= 1e-9 * far)
      return fmt::format("Its centre of mass, {} from the pivot, stands {} from where it would be {}", given_length(far),
                         short_length(far * chord, far * error), run.compared().if_not);
  }
  return fmt::format("A metre from the pivot, its axis stands {} from where it would be {}", short_length(chord, error),
                     run.compared().if_not);
}

/// When the drift cannot be trusted, and why; from results that have no intervals, only from when on.
std::string untrusted_times(const Run& run) {
  std::string text;
  for (std::size_t i = 0; const auto from = run.number(fmt::format("/drift/verdict_intervals/{}/from_s", i)); ++i) {
    const std::string at = fmt::format("/drift/verdict_intervals/{}/", i);
    const auto until = run.number(at + "until_s");
    constexpr int kFewest = 4, kMost = 7;  // digits, as many as tell both ends apart
    const auto same = [&](int digits) {
      return until && fmt::format("{:.{}g}", *from, digits) == fmt::format("{:.{}g}", *until, digits);
    };
    int digits = kFewest;
    while (digits < kMost && same(digits)) ++digits;
    const std::string begin = number_html(*from, "s", digits), end = until ? number_html(*until, "s", digits) : "";
    const bool is_moment = same(kMost);
    text += fmt::format(" {} {}{}, the drift cannot be trusted: {}.", is_moment ? "At" : "From", begin,
                        is_moment ? ""
                        : until   ? " to " + end
                                  : " on",
                        escaped(run.word(at + "text")));
  }
  if (const auto from = run.number("/drift/verdict_from_s"); from && text.empty())
    text = fmt::format(" From {} on, the drift cannot be trusted.", number_html(*from, "s"));
  return text;
}

/// The number with all the digits that its bound leaves.
std::string all_digits(const Run& run, const LastDrift& drift) {
  std::string tip;
  if (run.has_contact && !run.listed.rows.empty() && drift.at_s == run.listed.rows.back().t_s) {
    const double far = value(run.listed.rows.back(), column("drift_tip_m")),
                 error = value(run.listed.rows.back(), column("drift_tip_bound_m"));
    if (std::isfinite(far)) tip = ", and the tip " + known_html(far, error, length_unit(far)) + " from there";
  }
  constexpr double kFar = 10;
  std::string share;
  if (drift.bound_rad > 0 && drift.axis_rad >= kFar * drift.bound_rad)
    share = fmt::format(" The error is at most a fraction of {}.",
                        error_html(0, drift.bound_rad / drift.axis_rad, ReadableUnit{"", "", 1}));
  return fmt::format(
      "<p>After {} the axis stands {} from where the {} puts it{}. Both predictions: {}.{} In radians the "
      "angle "
      "is {}.</p>\n",
      number_html(drift.at_s, "s"), known_angle_html(drift.axis_rad, drift.bound_rad, true), run.compared().reference, tip,
      escaped(run.word("/matching_rule/statement")), share, known_html(drift.axis_rad, drift.bound_rad, "rad"));
}

}  // namespace

std::string_view group_of(const Run& run) {
  const std::string name = name_of_top(run);
  if (run.has_contact) return kOnTable;
  if (name == "pendulum") return kPendulums;
  if (name == "gyroscope") return kGyroscopes;
  return name == "body" ? kTumbling : kOnPoint;
}

std::string finding_html(const Run& run) {
  const LastDrift drift = last_drift(run);
  const std::string name = name_of_top(run), verdict = run.word("/drift/verdict");
  const std::string_view agent = run.compared().agent;
  const bool is_noise = verdict == "noise_floor" && std::isfinite(drift.axis_rad) && std::isfinite(drift.bound_rad);
  if (is_noise)
    return fmt::format(
        "In {} {} turns this {}'s axis by less than {}", duration_html(drift.at_s), agent, name,
        angle_in_words(drift.axis_rad + drift.bound_rad, drift.bound_rad, angle_unit(drift.axis_rad + drift.bound_rad)));
  if (!drift.is_known) return fmt::format("How far {} turns this {}'s axis is not known", agent, name);
  const ToldAngle told = told_angle(run, drift);
  const std::string angle = angle_in_words(told.rad, told.bound_rad, told.unit), time = duration_html(drift.at_s);
  if (told.which == ToldAngle::of_plane)
    return fmt::format("In {} {} turns this {}'s plane of swing by {}", time, agent, name, angle);
  std::string beyond;
  if (verdict != "reliable") {
    if (drift.at_s < run.number("/outcome/reached_s").value_or(drift.at_s))
      beyond = "; what comes later is not known";
    else
      beyond = verdict == "marginal" ? ", at the limit of its stability" : ", as would any other disturbance";
  }
  if (told.which == ToldAngle::about_axis)
    return fmt::format("In {} {} turns this {} {} about its axis", time, agent, name, angle) + beyond;
  if (told.rad == 0)
    return fmt::format("In {} nothing turns this {}'s axis off course", time, name) + (beyond.starts_with(';') ? beyond : "");
  return fmt::format("In {} {} turns this {}'s axis {} off course", time, agent, name, angle) + beyond;
}

std::string measure_html(const Run& run) {
  const LastDrift drift = last_drift(run);
  if (!drift.is_known) return "No row of this run can be trusted.";
  const ToldAngle told = told_angle(run, drift);
  if (told.which == ToldAngle::about_axis)
    return "Its axis stays in its place: " + short_length(2 * real::sin(told.rad / 2), told.bound_rad) +
           " at a metre from the axis.";
  if (drift.axis_rad == 0) return "Both predictions end in the same place.";
  const std::string sun = beside_the_sun(drift.axis_rad);
  std::string angle;
  if (told.which == ToldAngle::of_plane) {
    const ReadableUnit unit = angle_unit(drift.axis_rad);
    angle = " At the end its axis is " + short_html(drift.axis_rad, drift.bound_rad, unit.per_si) + escaped(unit.symbol) +
            " off course" + (sun.empty() ? "." : ", about " + sun + ".");
    return length_words(run, drift) + "." + angle;
  }
  return length_words(run, drift) + (sun.empty() ? "." : "; the angle is about " + sun + ".");
}

std::string trust_html(const Run& run) {
  const LastDrift drift = last_drift(run);
  const std::string verdict = run.word("/drift/verdict"), reason = escaped(run.word("/drift/verdict_reason")) + ".";
  const std::string stopped = run.word("/outcome/status") == "completed"
                                  ? ""
                                  : fmt::format(" The run stopped: {}, at {}.", escaped(run.word("/outcome/status")),
                                                number_html(run.number("/outcome/reached_s").value_or(0), "s"));
  std::string sure;
  if (drift.is_known && std::isfinite(drift.bound_rad)) {
    const ToldAngle told = told_angle(run, drift);
    sure = "<span class=\"sure\">± " + error_html(told.rad, told.bound_rad, told.unit) + "</span>";
  }
  const std::string times = untrusted_times(run), digits = drift.is_known ? all_digits(run, drift) : "";
  if (verdict == "reliable")
    return fmt::format(
               "<details><summary>This number can be trusted: {}</summary>\n<p><strong>reliable</strong>: {}</p>\n{}</details>",
               sure, reason, digits) +
           (times.empty() && stopped.empty() ? "" : "<p>" + times + stopped + "</p>\n");
  std::string html = fmt::format("<p><strong>{}</strong>: {}{}{}</p>\n", escaped(verdict), reason, times, stopped);
  if (!sure.empty()) html += fmt::format("<details><summary>The number is known to {}</summary>\n{}</details>", sure, digits);
  return html;
}

}  // namespace earthtop::report
