// SPDX-License-Identifier: GPL-3.0-or-later
// Why the axis of a top drifts whose spin friction or a given torque changes.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "earthtop/closed_form/special_cases.hpp"
#include "earthtop/elementary.hpp"
#include "earthtop/model/applied_torques.hpp"
#include "earthtop/model/body.hpp"
#include "earthtop/model/release.hpp"
#include "run/slow_precession.hpp"
#include "run/why_told.hpp"

namespace earthtop::why {
namespace {

/// Whether nothing acts besides gravity but friction and a torque along the axis, and neither motion comes to rest.
bool only_spin_changes(const Told& told) {
  const AppliedTorquesSpec& applied = told.scene.scenario().effects.applied;
  const GivenTorque<double>& given = told.scene.model<double>().applied.given;
  return (applied.friction() || given.acts) && (!given.acts || given.is_along(2)) && !applied.gravity_gradient &&
         !applied.gimbal && !applied.unequal_support && told.scene.is_reducible_when_driven() && told.result.stops.empty() &&
         told.result.motion;
}

void tell_spin(Told& told, double first, double last, const std::string& and_so) {
  const GivenTorque<double>& given = told.scene.model<double>().applied.given;
  if (!given.acts) return tell_spin_changes(told, "friction_slows", "Friction slows", first, last, and_so);
  const std::string_view with = told.scene.scenario().effects.applied.friction() ? ", with friction," : "";
  tell_spin_changes(told, "given_torque",
                    fmt::format("The given torque along the axis, {}{:.4g} N m{} takes", given.oscillates ? "up to " : "",
                                std::abs(given.z), with.empty() ? "," : with),
                    first, last, and_so);
}

/// A balanced gyroscope: a torque along the axis does not turn it. Left out is the small circle of a release at rest in the laboratory, and
/// that friction resists the slow turn of the axis, too.
void tell_balanced(Told& told) {
  const Release<double>& release = told.scene.release<double>();
  const double spin = release.w_XB_B[2], Omega = told.scene.rotation_rate_rad_s();
  if (release.w_XB_B[0] != 0 || release.w_XB_B[1] != 0 || spin == 0) return;
  const double last = spin_left(told, told.scene.model<double>().applied, spin);
  if (!(last * spin > 0) || !spin_agrees(told, spin, last)) return;
  const Vec3<double> n_L = vector(told.result.looks.front().ref_axis_L);
  const double away = real::atan2(norm(Vec3<double>(n_L.cross(told.W_L))), n_L.dot(told.W_L) * (Omega > 0 ? 1 : -1));
  const double predicted = balanced_gyroscope_drift(real::sin(away), Omega, told.reached_s());
  const double computed = told.result.drift.axis_final_rad, bound = told.result.drift.axis_bound_rad;
  constexpr double kCircle = 3, kMostLeftOut = 0.1;
  const double left_out =
      kCircle * told.Omega() * real::sin(away) * (1 + told.I1 / told.I3) / std::min(std::abs(spin), std::abs(last));
  if (!(left_out <= kMostLeftOut * predicted) || std::abs(computed - predicted) > left_out + bound) return;
  tell_earth_turns(told);
  tell_spin(told, spin, last, ".");
  told.add("no_torque_across",
           fmt::format("No torque acts across the axis, which therefore keeps its direction among the stars while the spin {}. "
                       "Seen from the laboratory it turns about the celestial axis, from which it is {:.5g}° away.",
                       std::abs(last) < std::abs(spin) ? "falls" : "rises", away * 180 / std::numbers::pi),
           {{"angle_from_celestial_pole_rad", away}});
  told.add("what_is_left",
           fmt::format("The drift of the axis is {} in theory and {} in this run.", angle_with_error(predicted, left_out),
                       angle_with_error(computed, bound)),
           {{"predicted_rad", predicted}, {"predicted_error_rad", left_out}, {"computed_rad", computed}});
}

void tell_precessing(Told& told) {
  const Release<double>& release = told.scene.release<double>();
  const SlowTop top = slow_top(told, told.I1, told.scene.model<double>().applied);
  const std::optional<SlowPrecession> slow = slow_precession(top, told.reached_s());
  if (!slow || !spin_agrees(told, release.w_XB_B[2], slow->last_spin_rad_s)) return;
  // An alternating torque leaves no change that lasts.
  const bool lasts = !top.applied.given.acts || !top.applied.given.oscillates;
  const std::string and_so =
      !lasts ? "."
             : fmt::format(
                   "; the precession, {:.4g} rad/s at first, therefore {} to {:.4g} rad/s.", std::abs(slow->first_rad_s),
                   std::abs(slow->last_rad_s) > std::abs(slow->first_rad_s) ? "quickens" : "slows", std::abs(slow->last_rad_s));
  tell_slow_drift(told, top, *slow, [&] { tell_spin(told, release.w_XB_B[2], slow->last_spin_rad_s, and_so); });
}

}  // namespace

SlowTop slow_top(const Told& told, double I1, const AppliedTorques<double>& applied) {
  const DriftRow& first = told.result.looks.front();
  const Release<double>& release = told.scene.release<double>();
  return {I1,
          told.I3,
          told.mgl,
          told.I1,
          applied,
          told.W_L,
          first.ref_axis_L[2],
          real::atan2(first.ref_axis_L[1], first.ref_axis_L[0]),
          times(rotation_matrix(release.q_LB), release.w_XB_B),
          release.X == RatesRelativeTo::laboratory};
}

std::optional<AveragedDrift> averaged_drift(const RunResult& result, double period_s) {
  constexpr double kPeriods = 3;
  constexpr std::size_t kFewest = 12;
  const std::vector<DriftRow>& looks = result.looks;
  const double end = looks.back().t_s;
  const std::size_t count = std::min(result.looks_a_window > 0 ? result.looks_a_window : looks.size(), looks.size());
  const double from = std::max(end - kPeriods * period_s, looks[looks.size() - count].t_s), width = end - from;
  double weights = 0, t = 0, azimuth = 0, bound = 0;
  std::size_t used = 0;
  for (std::size_t i = looks.size() - count; i < looks.size(); ++i) {
    const DriftRow& look = looks[i];
    if (look.t_s < from) continue;
    if (!look.drift_azimuth_rad) return std::nullopt;
    const double phase = real::sin(std::numbers::pi * (look.t_s - from) / width), weight = phase * phase;
    weights += weight, t += weight * look.t_s, azimuth -= weight * *look.drift_azimuth_rad, ++used;
    bound = std::max(bound, look.drift_axis_bound_rad / horizontal(look));
  }
  if (used < kFewest) return std::nullopt;
  return AveragedDrift{t / weights, azimuth / weights, bound};
}

double spin_left(const Told& told, const AppliedTorques<double>& applied, double spin) {
  constexpr double kFewest = 256, kMost = 100'000, kACycle = 40;
  const GivenTorque<double>& given = applied.given;
  const double cycles = given.acts && given.oscillates ? given.frequency * told.reached_s() : 0;
  const int steps = static_cast<int>(std::clamp(kACycle * cycles, kFewest, kMost));
  const auto slope = [&](double t, double w3) {
    return (friction_torque(applied, Vec3<double>(0, 0, w3))[2] + (given.acts ? given.at(t)[2] : 0)) / told.I3;
  };
  const double h = told.reached_s() / steps;
  for (int i = 0; i < steps; ++i) {  // Runge and Kutta's
    const double t = i * h, k1 = slope(t, spin), k2 = slope(t + h / 2, spin + h / 2 * k1),
                 k3 = slope(t + h / 2, spin + h / 2 * k2), k4 = slope(t + h, spin + h * k3);
    spin += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return spin;
}

bool spin_agrees(const Told& told, double first, double last) {
  constexpr double kOfChange = 0.01, kRounding = 1e-7;
  const double seen = told.result.motion->spin_end_rad_s.reference.value;
  return std::abs(last - seen) <= kOfChange * std::abs(first - seen) + kRounding * std::abs(first);
}

void tell_spin_changes(Told& told, std::string_view name, const std::string& cause, double first, double last,
                       const std::string& and_so) {
  const double seen = told.result.motion->spin_end_rad_s.reference.value;
  told.add(name,
           fmt::format("{} the spin from {:.6g} rad/s to {:.5g} rad/s in theory, and to {:.5g} rad/s in this run{} It acts in "
                       "both predictions alike, and by itself makes no drift.",
                       cause, first, last, seen, and_so),
           {{"spin_first_rad_s", first}, {"predicted_spin_last_rad_s", last}, {"computed_spin_last_rad_s", seen}});
}

void tell_rubbed(Told& told) {
  if (!only_spin_changes(told)) return;
  if (told.mgl == 0)
    tell_balanced(told);
  else
    tell_precessing(told);
}

}  // namespace earthtop::why
