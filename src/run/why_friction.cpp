// SPDX-License-Identifier: GPL-3.0-or-later
// Why the axis of a top drifts that friction slows down.
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

/// Whether only friction acts besides gravity, and brings neither motion to rest.
bool only_rubs(const Told& told) {
  const AppliedTorquesSpec& applied = told.scene.scenario().effects.applied;
  return applied.friction() && !applied.gravity_gradient && !applied.gimbal && !applied.unequal_support &&
         !applied.given_torque && told.scene.is_reducible_when_driven() && told.result.stops.empty() && told.result.motion;
}

/// The spin (rad/s) to which friction brings a top whose axis is at rest, by Runge-Kutta steps of dw3/dt = torque / I3.
double spin_left(const Told& told, double spin) {
  constexpr int kSteps = 256;
  const AppliedTorques<double>& applied = told.scene.model<double>().applied;
  const auto slope = [&](double w3) { return friction_torque(applied, Vec3<double>(0, 0, w3))[2] / told.I3; };
  const double h = told.reached_s() / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const double k1 = slope(spin), k2 = slope(spin + h / 2 * k1), k3 = slope(spin + h / 2 * k2), k4 = slope(spin + h * k3);
    spin += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return spin;
}

/// Whether the law of the spin agrees with the run.
bool spin_agrees(const Told& told, double first, double last) {
  constexpr double kOfFall = 0.01, kRounding = 1e-7;
  const double seen = told.result.motion->spin_end_rad_s.reference.value;
  return std::abs(last - seen) <= kOfFall * std::abs(first - seen) + kRounding * std::abs(first);
}

void tell_friction_slows(Told& told, double first, double last, const std::string& and_so) {
  const double seen = told.result.motion->spin_end_rad_s.reference.value;
  told.add(
      "friction_slows",
      fmt::format("Friction slows the spin from {:.6g} rad/s to {:.5g} rad/s in theory, and to {:.5g} rad/s in this run{} It "
                  "acts in both predictions alike, and by itself makes no drift.",
                  first, last, seen, and_so),
      {{"spin_first_rad_s", first}, {"predicted_spin_last_rad_s", last}, {"computed_spin_last_rad_s", seen}});
}

/// A balanced gyroscope: friction along the axis does not turn it. Left out is the small circle of a release at rest in the laboratory, and
/// that friction resists the slow turn of the axis, too.
void tell_balanced(Told& told) {
  const Release<double>& release = told.scene.release<double>();
  const double spin = release.w_XB_B[2], Omega = told.scene.rotation_rate_rad_s();
  if (release.w_XB_B[0] != 0 || release.w_XB_B[1] != 0 || spin == 0) return;
  const double last = spin_left(told, spin);
  if (!(last * spin > 0) || !spin_agrees(told, spin, last)) return;
  const Vec3<double> n_L = vector(told.result.looks.front().ref_axis_L);
  const double away = real::atan2(norm(Vec3<double>(n_L.cross(told.W_L))), n_L.dot(told.W_L) * (Omega > 0 ? 1 : -1));
  const double predicted = balanced_gyroscope_drift(real::sin(away), Omega, told.reached_s());
  const double computed = told.result.drift.axis_final_rad, bound = told.result.drift.axis_bound_rad;
  constexpr double kCircle = 3, kMostLeftOut = 0.1;
  const double left_out = kCircle * told.Omega() * real::sin(away) * (1 + told.I1 / told.I3) / std::abs(last);
  if (!(left_out <= kMostLeftOut * predicted) || std::abs(computed - predicted) > left_out + bound) return;
  tell_earth_turns(told);
  tell_friction_slows(told, spin, last, ".");
  told.add(
      "no_torque_across",
      fmt::format("No torque acts across the axis, which therefore keeps its direction among the stars while the spin falls. "
                  "Seen from the laboratory it turns about the celestial axis, from which it is {:.5g}° away.",
                  away * 180 / std::numbers::pi),
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
  const std::string and_so = fmt::format("; the precession, {:.4g} rad/s at first, therefore quickens to {:.4g} rad/s.",
                                         std::abs(slow->first_rad_s), std::abs(slow->last_rad_s));
  tell_slow_drift(told, top, *slow, [&] { tell_friction_slows(told, release.w_XB_B[2], slow->last_spin_rad_s, and_so); });
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

void tell_rubbed(Told& told) {
  if (!only_rubs(told)) return;
  if (told.mgl == 0)
    tell_balanced(told);
  else
    tell_precessing(told);
}

}  // namespace earthtop::why
