// SPDX-License-Identifier: GPL-3.0-or-later
// What the bearing or the motor of a rotor does to the body's axis, and what it does not do.
#include <cmath>
#include <string>
#include <utility>

#include "earthtop/model/release.hpp"
#include "earthtop/scenario/support.hpp"
#include "run/why_told.hpp"

namespace earthtop::why {
namespace {

bool changes_rate(const RotorSpec& rotor) {
  return rotor.drive == RotorDrive::ramp || rotor.drive == RotorDrive::harmonic ||
         (rotor.drive == RotorDrive::none && rotor.has_friction());
}
const char* cause(const RotorSpec& rotor) { return rotor.drive == RotorDrive::none ? "The bearing's friction" : "The motor"; }

/// The inertial momentum of the rotor about its axis (kg m^2/s).
double momentum_of(const Told& told, const Rotor<double>& rotor, const DriftRow& look) {
  const double carried = rotor.axis_B.dot(vector(look.w_LB_B)) + vector(look.rotor->axis_L).dot(told.W_L);
  return rotor.axial * (look.rotor->rate_rad_s + carried);
}

void tell_of_symmetric_cage(Told& told, const RotorSpec& rotor) {
  const DriftRow &first = told.result.looks.front(), &last = told.result.looks.back();
  const double rate = told.scene.release<double>().w_XB_B[2], momentum = told.I3 * rate;
  const std::string moves =
      fmt::format("the axis moves as that of a rigid top of the same moments that spins at {:.6g} rad/s", rate);
  std::string text;
  if (changes_rate(rotor))
    text = fmt::format(
        "{} changes the rotor's rate in its cage from {:.6g} to {:.6g} rad/s, and the cage's own about the axis from "
        "{:.6g} to {:.6g} rad/s. As it acts along the axis of a symmetric cage, it leaves the momentum along the "
        "axis, {:.3g} kg m²/s, as it is: {}, and the drift does not depend on it.",
        cause(rotor), first.rotor->rate_rad_s, last.rotor->rate_rad_s, first.w_LB_B[2], last.w_LB_B[2], momentum, moves);
  else
    text = fmt::format(
        "The rotor turns at {:.6g} rad/s in its symmetric cage, and the momentum along the axis is {:.3g} kg m²/s: {}.",
        first.rotor->rate_rad_s, momentum, moves);
  told.add("bearing", std::move(text),
           {{"rotor_rate_first_rad_s", first.rotor->rate_rad_s},
            {"rotor_rate_last_rad_s", last.rotor->rate_rad_s},
            {"cage_rate_first_rad_s", first.w_LB_B[2]},
            {"cage_rate_last_rad_s", last.w_LB_B[2]},
            {"momentum_kg_m2_s", momentum}});
}

/// What a torque between rotor and body does to the axis.
std::string effect_on_axis(const Scenario& scenario) {
  if (!has_symmetric_cage(scenario))
    return "in a body that is not symmetric about the rotor's axis the body then turns otherwise, and so its axis moves "
           "otherwise, too";
  if (scenario.effects.applied.friction())
    return "along the axis of a symmetric cage it does not move the axis, but it turns the cage, which the pivot's friction "
           "brakes";
  return "along the axis of a symmetric cage it does not move the axis";
}

void tell_of_any_body(Told& told, const RotorSpec& spec, const Rotor<double>& rotor) {
  const DriftRow &first = told.result.looks.front(), &last = told.result.looks.back();
  const double before = momentum_of(told, rotor, first), after = momentum_of(told, rotor, last);
  const double rate = first.rotor->rate_rad_s, last_rate = last.rotor->rate_rad_s;
  const std::string changes = fmt::format("from {:.6g} rad/s at the release to {:.6g} rad/s at the end", rate, last_rate);
  std::string text;
  if (spec.drive == RotorDrive::none && !spec.has_friction())
    text = fmt::format(
        "Nothing acts on the rotor about its axis: in space, its momentum about it stays {:.6g} kg m²/s. Its rate in the body "
        "changes "
        "as the body turns, {}.",
        before, changes);
  else
    text = fmt::format(
        "{} {}, and takes its momentum about its axis in space from {:.6g} to {:.6g} kg m²/s. What one of rotor and body gains "
        "the other "
        "loses: {}.",
        cause(spec),
        changes_rate(spec) ? "changes the rotor's rate in the body " + changes
                           : fmt::format("keeps the rotor's rate in the body at {:.6g} rad/s", rate),
        before, after, effect_on_axis(told.scene.scenario()));
  told.add("bearing", std::move(text),
           {{"rotor_rate_first_rad_s", first.rotor->rate_rad_s},
            {"rotor_rate_last_rad_s", last.rotor->rate_rad_s},
            {"rotor_momentum_first_kg_m2_s", before},
            {"rotor_momentum_last_kg_m2_s", after}});
}

void tell_coriolis_torques(Told& told) {
  const double all = largest_length(told.result, [&](const DriftRow& look) { return coriolis_torque_L(told, look); });
  const double inside =
      largest_length(told.result, [&](const DriftRow& look) { return coriolis_torque_on_rotor_L(told, look); });
  told.add("coriolis_torque",
           fmt::format(
               "To an observer in the laboratory, a Coriolis torque acts on body and rotor, {:.3g} N m at most; on the rotor's "
               "turn in the body alone it is {:.3g} N m at most.",
               all, inside),
           {{"coriolis_torque_N_m", all}, {"on_rotor_N_m", inside}});
}

}  // namespace

void tell_caged(Told& told) {
  if (const auto& rotor = told.scene.scenario().rotor) tell_of_symmetric_cage(told, *rotor);
}

void tell_with_masses(Told& told) {
  const ModelInTime<double> in_time(told.scene.model<double>());
  const auto of_masses = [&](const DriftRow& look) {
    return coriolis_torque_L(told, look, in_time.masses_at(look.t_s)->velocity_moment);
  };
  const double all = largest_length(told.result, [&](const DriftRow& look) { return coriolis_torque_L(told, look); });
  const double moving = largest_length(told.result, of_masses);
  tell_earth_turns(told);
  told.add("coriolis_torque",
           fmt::format(
               "To an observer in the laboratory, a Coriolis torque acts on all parts, {:.3g} N m at most; on what the masses "
               "move in the body alone it is {:.3g} N m at most, which would turn a body that rests, too.",
               all, moving),
           {{"coriolis_torque_N_m", all}, {"on_masses_N_m", moving}});
  tell_turns_with_the_stars(told);
}

void tell_with_rotor(Told& told) {
  const RotorSpec& spec = *told.scene.scenario().rotor;
  tell_earth_turns(told);
  tell_coriolis_torques(told);
  tell_of_any_body(told, spec, make_rotor<double>(spec));
  tell_turns_with_the_stars(told);
}

}  // namespace earthtop::why
