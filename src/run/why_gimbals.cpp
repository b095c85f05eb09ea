// SPDX-License-Identifier: GPL-3.0-or-later
// Why the drift of a body in gimbals is what it is.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "earthtop/model/gimbal_ledger.hpp"
#include "run/invariant_follower.hpp"
#include "run/why_told.hpp"
#include "scene/gimbal_rest.hpp"

namespace earthtop::why {
namespace {

/// The largest Coriolis torque that the laboratory sees on all parts, and what of it is gyroscopic.
void tell_coriolis_on_all_parts(Told& told) {
  const Model<double>& model = told.scene.model<double>();
  double all = 0, gyroscopic = 0;
  for (const DriftRow& look : told.result.looks) {
    const LedgerEntry<double> entry =
        ledger_entry_in_gimbals(LedgerObserver::laboratory, model, look.t_s, gimbal_angles(*look.gimbals, true),
                                look.rotor ? look.rotor->rate_rad_s : 0.0);
    all = std::max(all, norm(entry.tau_cor_A)), gyroscopic = std::max(gyroscopic, norm(entry.tau_cor_gyroscopic_A));
  }
  told.add("coriolis_torque",
           fmt::format(
               "To an observer in the laboratory, a Coriolis torque acts on all that moves, {:.3g} N m at most; the gyroscopic "
               "part of it, of the momentum that he sees, is {:.3g} N m at most.",
               all, gyroscopic),
           {{"coriolis_torque_N_m", all}, {"gyroscopic_N_m", gyroscopic}});
}

void tell_kept_direction(Told& told, const TheoryReport& theory) {
  told.add(
      "axis_stays",
      fmt::format(
          "Nothing turns the rotor's axis: it stays in inertial space, and in the laboratory it drifts by {}, by {} in this "
          "run. The gimbals' inertia adds a nutation, and no rate.",
          angle_text(theory.predicted), angle_text(*theory.computed)),
      {{"predicted_rad", theory.predicted}, {"computed_rad", *theory.computed}});
}

void tell_magnus(Told& told, const TheoryReport& theory) {
  const double share = std::abs(theory.predicted / told.scene.rotation_rate_rad_s());
  told.add(
      "magnus_drift",
      fmt::format(
          "Both predictions have a drift that is not the Earth's: the nutation makes the outer gimbal turn at {:.4g} rad/s "
          "on average, {:.4g} in this run, {:.3g} times the Earth's rate. It comes from the gimbals' inertia.",
          theory.predicted, *theory.computed, share),
      {{"predicted_rad_s", theory.predicted}, {"computed_rad_s", *theory.computed}});
}

void tell_period(Told& told, const TheoryReport& theory) {
  told.add(
      theory.name == "compass_period" ? "compass_period" : "slow_period",
      fmt::format(
          "The outer gimbal swings about its place of rest with a period of {:.5g} s, {:.5g} s in this run; the inertia of "
          "the gimbals counts as the rotor's.",
          theory.predicted, *theory.computed),
      {{"predicted_s", theory.predicted}, {"computed_s", *theory.computed}});
}

void tell_middle(Told& told, const TheoryReport& theory) {
  const auto known = [](double angle, double error) { return angle_text(std::abs(angle) <= error ? 0 : angle); };
  constexpr double kRoundOff = 1e-15;  // rad
  told.add("middle_of_swing",
           fmt::format(
               "The swing's middle is at an outer angle of {}, {} in this run, where the torques about the outer axis balance.",
               known(theory.predicted, kRoundOff), known(*theory.computed, theory.computed_error.value_or(0))),
           {{"predicted_rad", theory.predicted}, {"computed_rad", *theory.computed}});
}

void tell_turn_by_masses(Told& told, const TheoryReport& theory) {
  told.add("turn_by_masses",
           fmt::format("Masses that move from or to the outer axis feel the Coriolis force of the Earth's rate about Up, and "
                       "turn the rest by "
                       "{}, {} in this run.",
                       angle_text(theory.predicted), angle_text(*theory.computed)),
           {{"predicted_rad", theory.predicted}, {"computed_rad", *theory.computed}});
}

void tell_settled(Told& told, const TheoryReport& theory) {
  told.add(
      "settled_angle",
      fmt::format(
          "Without the Earth's rotation the damper brings the free gimbal to rest at {}, {} in this run; the difference of the "
          "two predictions is what the Earth's rate moves it.",
          angle_text(theory.predicted), angle_text(*theory.computed)),
      {{"predicted_rad", theory.predicted}, {"computed_rad", *theory.computed}});
}

/// Tells which torque, and which offset of the centre of mass, would imitate the Earth.
void tell_imitations(Told& told) {
  const Scene& scene = told.scene;
  const double h = std::abs(gimbal_rotor_momentum(scene)), torque = h * told.Omega();
  const Gimbals<double>& gimbals = scene.model<double>().gimbals;
  if (h == 0 || gimbals.outer.locked || gimbals.inner.locked) return;
  const double weight = scene.body<double>().mass * scene.site().gravity_m_s2;  // of body and rotor
  told.add(
      "imitated_by",
      weight > 0
          ? fmt::format("A torque of {:.2g} N m across the rotor's axis would turn it as fast as the Earth, and so would a "
                        "centre of mass that is off by {:.2g} m.",
                        torque, torque / weight)
          : fmt::format("A torque of {:.2g} N m across the rotor's axis would turn it as fast as the Earth.", torque),
      {{"torque_N_m", torque}, {"offset_m", weight > 0 ? torque / weight : 0}});
}

}  // namespace

void tell_with_gimbals(Told& told) {
  tell_earth_turns(told);
  tell_coriolis_on_all_parts(told);
  for (const TheoryReport& theory : told.result.theory) {
    if (!holds_in_run(theory)) continue;
    if (theory.name == "free_gyro_axis_drift") tell_kept_direction(told, theory);
    if (theory.name == "magnus_drift") tell_magnus(told, theory);
    if (theory.name.ends_with("_period")) tell_period(told, theory);
    if (theory.name == "middle_of_swing") tell_middle(told, theory);
    if (theory.name == "turn_by_masses") tell_turn_by_masses(told, theory);
    if (theory.name == "settled_angle") tell_settled(told, theory);
  }
  tell_imitations(told);
}

}  // namespace earthtop::why
