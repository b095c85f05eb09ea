// SPDX-License-Identifier: GPL-3.0-or-later
// Why tops that precess, slide or turn over on a table drift, and what the table's friction does besides.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "earthtop/drift/contact_event.hpp"
#include "earthtop/elementary.hpp"
#include "earthtop/model/body.hpp"
#include "earthtop/model/release.hpp"
#include "run/slow_precession.hpp"
#include "run/why_told.hpp"

namespace earthtop::why {
namespace {

/// The azimuth by which the axis of the non-rotating prediction has gone round (rad, counterclockwise). Empty where the looks do not follow
/// it, or it comes next to the vertical.
std::optional<double> reference_turned(const Told& told) {
  constexpr double kNearVertical = 1e-3;
  double turned = 0, before = 0;
  if (told.result.looks_a_window > 0) return std::nullopt;
  for (const DriftRow& look : told.result.looks) {
    if (!(real::hypot(look.ref_axis_L[0], look.ref_axis_L[1]) > kNearVertical)) return std::nullopt;
    const double azimuth = real::atan2(look.ref_axis_L[1], look.ref_axis_L[0]);
    if (&look != &told.result.looks.front()) turned += std::remainder(azimuth - before, 2 * std::numbers::pi);
    before = azimuth;
  }
  return turned;
}

/// Without friction and on a level table no level force acts but the Coriolis force, which hardly matters: the top precesses about its centre
/// of mass.
void tell_frictionless(Told& told) {
  const Body<double>& body = told.scene.body<double>();
  const double length = body.p_PBcm_B[2];
  const SlowTop top = slow_top(told, told.I1 - body.mass * length * length, {});
  const std::optional<SlowPrecession> slow = slow_precession(top, told.reached_s());
  const std::optional<double> turned = reference_turned(told);
  constexpr double kAgree = 0.02;
  if (!slow || !turned || std::abs(*turned - slow->turned_rad) > kAgree * std::abs(slow->turned_rad) + slow->smallness) return;
  tell_slow_drift(told, top, *slow, [&] {
    told.add(
        "no_friction_holds",
        fmt::format("No friction holds the tip, which circles below a centre of mass that nothing pushes sideways. So the "
                    "moments about that centre count: with them the axis precesses by {:.5g} rad in theory, and by {:.5g} rad "
                    "in this run.",
                    std::abs(slow->turned_rad), std::abs(*turned)),
        {{"predicted_turned_rad", slow->turned_rad}, {"computed_turned_rad", *turned}});
  });
}

/// With friction the laboratory's turn is the larger part of the drift of a top that precesses fast enough; the rest is told, too.
void tell_on_rubbing_table(Told& told) {
  const DriftRow& last = told.result.rows.back();
  const std::optional<double> turned = reference_turned(told);
  const double up = told.W_L[2], of_laboratory = -up * told.reached_s();
  constexpr double kTurns = 2, kMostRest = 0.3;
  if (!turned || !last.drift_azimuth_rad || std::abs(*turned) < kTurns * 2 * std::numbers::pi) return;
  const double computed = -*last.drift_azimuth_rad, rest = computed - of_laboratory;
  if (!(std::abs(rest) <= kMostRest * std::abs(of_laboratory)) || std::abs(up) <= kNone * told.Omega()) return;
  if (told.sentences.empty()) tell_earth_turns(told);
  told.add(
      "laboratory_turns",
      fmt::format(
          "While the axis goes round by {:.3g} turns, the laboratory turns about its vertical at {}, {:.5g} rad/s {} seen from "
          "above: seen from it, this alone turns the azimuth {} by {}. In this run the azimuth has drifted {} by {}; the "
          "rest, {:.2g} of it, is how the cone leans and what the table's force makes of it.",
          std::abs(*turned) / (2 * std::numbers::pi), told.vertical_rate(), std::abs(up), sense(up), sense(of_laboratory),
          angle_text(std::abs(of_laboratory)), sense(computed), angle_text(std::abs(computed)), std::abs(rest / computed)),
      {{"laboratory_rate_rad_s", up}, {"turned_rad", of_laboratory}, {"computed_rad", computed}, {"rest", rest / computed}});
}

/// A value of two looks at a time between them.
template <class Value>
double between(const DriftRow& before, const DriftRow& after, double t_s, const Value& value) {
  const double part = (t_s - before.t_s) / (after.t_s - before.t_s);
  return value(before) + part * (value(after) - value(before));
}

/// A top that turns over does so a little earlier or later than its twin: its tilt drifts by as much as it turns in that time.
void tell_inverted(Told& told) {
  const std::vector<DriftRow>& looks = told.result.looks;
  const auto event =
      std::find_if(told.result.contact->events.begin(), told.result.contact->events.end(), [](const ContactEvent& e) {
        return e.kind == ContactEventKind::inverted && e.prediction == Prediction::reference && e.time_difference_s;
      });
  if (event == told.result.contact->events.end()) return;
  const auto after = std::find_if(looks.begin(), looks.end(), [&](const DriftRow& look) { return look.t_s >= event->t_s; });
  if (told.result.looks_a_window > 0 || after == looks.begin() || after == looks.end()) return;
  const DriftRow &before = *(after - 1), &next = *after;
  const auto tilt = [](const DriftRow& look) {
    return real::atan2(real::hypot(look.ref_axis_L[0], look.ref_axis_L[1]), look.ref_axis_L[2]);
  };
  const double rate = (tilt(next) - tilt(before)) / (next.t_s - before.t_s), later = *event->time_difference_s;
  const double predicted = -rate * later;
  const double computed = between(before, next, event->t_s, [](const DriftRow& look) { return look.drift_tilt_rad; });
  constexpr double kAgree = 0.1;
  if (later == 0 || !(std::abs(computed - predicted) <= kAgree * std::abs(predicted))) return;
  if (told.sentences.empty()) tell_earth_turns(told);
  told.add(
      "stands_up",
      fmt::format("The axis passes the level after {:.5g} s, and the Earth's rate makes it pass {:.3g} s {}. There it turns by "
                  "{}/s, which makes a drift of its tilt of {} in theory and of {} in this run.",
                  event->t_s, std::abs(later), later > 0 ? "later" : "earlier", angle_text(std::abs(rate), 4),
                  angle_text(std::abs(predicted), 3), angle_text(std::abs(computed), 3)),
      {{"passes_s", event->t_s}, {"later_s", later}, {"predicted_tilt_rad", predicted}, {"computed_tilt_rad", computed}});
}

/// How much more friction, or what tilt of the table, would move the prediction as far as the Earth moves it.
void tell_table_weighs(Told& told) {
  const ContactReport& contact = *told.result.contact;
  const auto row =
      std::find_if(told.result.rows.begin(), told.result.rows.end(), [&](const DriftRow& r) { return r.t_s == contact.at_s; });
  if (row == told.result.rows.end() || contact.changes.empty()) return;
  const PredictionChange &friction = contact.changes.front(), &tilt = contact.changes.back();
  const bool has_friction = contact.changes.size() > 1;
  const double axis = row->drift_axis_rad;
  if (!(friction.axis_rad > 0) || !(tilt.axis_rad > 0) || !(axis > row->drift_axis_bound_rad)) return;
  constexpr double kArcsecond = std::numbers::pi / 648'000;
  const double percent = axis / friction.axis_rad, tilted = axis / tilt.axis_rad * kArcsecond;
  if (told.sentences.empty()) tell_earth_turns(told);
  const std::string by = fmt::format("{} at {:.5g} s", angle_text(axis), row->t_s);
  if (has_friction)
    told.add("friction_weighs",
             fmt::format(
                 "Both predictions have the same friction. To first order, {:.2g} % more of it, or a table that leans by {}, "
                 "would move the axis as far as the Earth moves it, by {}.",
                 percent, angle_text(tilted, 2), by),
             {{"friction_percent", percent}, {"table_tilt_rad", tilted}, {"axis_rad", axis}});
  else
    told.add(
        "tilt_weighs",
        fmt::format("Both predictions have the same table. To first order, one that leans by {} would move the axis as far as "
                    "the Earth moves it, by {}.",
                    angle_text(tilted, 2), by),
        {{"table_tilt_rad", tilted}, {"axis_rad", axis}});
}

/// The air takes spin, as its torque along the axis does, and speed.
void tell_in_air(Told& told) {
  const AppliedTorquesSpec& air = told.scene.scenario().effects.applied;
  const ContactSpec& spec = *told.scene.scenario().contact;
  const Release<double>& release = told.scene.release<double>();
  const double spin = release.w_XB_B[2];
  if (!air.friction() || air.gravity_gradient || told.scene.symmetry_axis() != 2 || spec.table_tilt_deg != 0 || spin == 0 ||
      !told.result.motion)
    return;
  const double last = spin_left(told, make_applied_torques<double>(air, told.scene.site(), spin, 0, 0), spin);
  constexpr double kChanged = 1e-6;  // by a torque, not only by what rolling exchanges
  if (!(last * spin > 0) || !(std::abs(last - spin) > kChanged * std::abs(spin)) || !spin_agrees(told, spin, last)) return;
  tell_earth_turns(told);
  tell_spin_changes(told, "air_slows", "The air slows", spin, last, ".");
  if (spec.law != ContactLaw::frictionless) tell_on_rubbing_table(told);
}

}  // namespace

void tell_sliding(Told& told) {
  const ContactSpec& spec = *told.scene.scenario().contact;
  if (!told.result.contact) return;
  if (told.scene.scenario().effects.applied.any()) return tell_in_air(told);
  if (told.scene.symmetry_axis() == 2 && spec.table_tilt_deg == 0) {
    if (spec.law == ContactLaw::frictionless)
      tell_frictionless(told);
    else
      tell_on_rubbing_table(told);
  }
  tell_inverted(told);
  tell_table_weighs(told);
}

}  // namespace earthtop::why
