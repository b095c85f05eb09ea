// SPDX-License-Identifier: GPL-3.0-or-later
#include "explain_text.hpp"

#include <fmt/core.h>

#include "contact_text.hpp"
#include "earthtop/model/release.hpp"
#include "earthtop/results/results.hpp"
#include "earthtop/scenario/support.hpp"
#include "text/number_words.hpp"
#include "wrapped.hpp"

namespace earthtop::tool {
namespace {

std::string sentence(std::string_view text, std::size_t width) { return wrapped(text, width, 2) + '\n'; }

std::string forces_text(const ContactExplanation& explained, std::size_t width) {
  std::string text = fmt::format("{:<18}{:>11}{:>11}   {:>11}{:>11}\n", "Force", "at release", "largest", "torque", "largest");
  text += fmt::format("{:<18}{:>11}{:>11}   {:>11}{:>11}\n", "", "N", "N", "N m", "N m");
  bool left_out = false;
  for (const ContactForceSize& size : explained.forces) {
    text +=
        fmt::format("{:<18}{:>11.3e}{:>11.3e}   {:>11.3e}{:>11.3e}{}\n", spoken(size.name), size.force_release_N,
                    size.force_largest_N, size.torque_release_N_m, size.torque_largest_N_m, size.modelled ? "" : "   left out");
    left_out = left_out || !size.modelled;
  }
  text += sentence("torque: about the centre of mass, at release and at its largest; on the rotating Earth", width);
  if (left_out) text += sentence("left out: switched off; its size is that along the motion without it", width);
  return text;
}

std::string friction_text(const ContactExplanation& explained, const ContactSpec& contact, std::size_t width) {
  std::string text;
  if (explained.largest_friction_ratio)
    text +=
        sentence(fmt::format("Friction at its largest is {:.3g} times the normal force{}", *explained.largest_friction_ratio,
                             contact.law == ContactLaw::rolling ? "; with less friction the tip would slip" : ""),
                 width);
  if (explained.slip_relaxation_1_s)
    text += sentence(fmt::format("A small slip dies out at {:.3g} per second at the release, which every step has to follow",
                                 *explained.slip_relaxation_1_s),
                     width);
  return text;
}

std::string need_text(const std::optional<double>& steps, std::string_view step, const char* of) {
  if (!steps) return fmt::format("does not move the {}", of);
  const bool percent = step.ends_with("%");
  return fmt::format("{:.2g} {} ({})", *steps, percent ? "%" : "arcsec", of);
}

std::string inputs_text(const ContactExplanation& explained, std::size_t width) {
  if (explained.inputs.empty()) return "How well the inputs must be known: not known\n";
  std::string text = sentence(fmt::format("How well the inputs must be known: the error of each that moves the prediction at "
                                          "{} as far as the Earth does",
                                          time_text(explained.inputs_at_s)),
                              width);
  bool of_friction = false;
  for (const ContactInputNeed& need : explained.inputs) {
    of_friction = of_friction || need.step.ends_with("%");
    text += fmt::format("  {:<22}{}; {}\n", spoken(need.input), need_text(need.hides_axis, need.step, "axis"),
                        need_text(need.hides_tip, need.step, "tip"));
  }
  return text +
         wrapped(of_friction ? "  (nobody knows a coefficient of friction to 1 %, and few tables are level to an arcsecond)"
                             : "  (few tables are level to an arcsecond)",
                 width, 3) +
         '\n';
}

}  // namespace

std::string contact_explanation_text(const ContactExplanation& explained, const Scene& scene, std::size_t width) {
  const Scenario& scenario = scene.scenario();
  std::string text =
      scenario.name + '\n' +
      sentence(fmt::format("Drift by the Earth's rotation after {:.6g} s: axis {:.3e} rad, tip {:.3e} m; {}",
                           explained.followed_s, explained.drift_axis_rad, explained.drift_tip_m, matching_rule(scenario)),
               width);
  if (explained.ended_at_s)
    text += sentence(fmt::format("At t = {:.6g} s {}", *explained.ended_at_s, explained.ended_by), width);
  else if (explained.followed_s < scenario.duration_s * (1 - 1e-9))
    text += sentence(
        fmt::format("The motion was followed only until then; to {} it would take longer", time_text(scenario.duration_s)),
        width);
  return text + '\n' + forces_text(explained, width) + friction_text(explained, *scenario.contact, width) + '\n' +
         inputs_text(explained, width);
}

std::string rotor_equations_text(const Scene& scene, std::size_t width) {
  const Scenario& scenario = scene.scenario();
  if (masses_move(scenario))
    return sentence(
        "Equations: dL/dt = L x w + torque in body axes, w = I^-1 (L - h c - l); L: momentum of all parts; I and l: inertia "
        "and momentum "
        "in the body with the masses where they are; h c: momentum of a rotor",
        width);
  if (!scenario.rotor) return "";
  if (!scene.support().has_rotor)
    return sentence(
        fmt::format("Rotor: in a symmetric cage; computed is the rigid top that moves as its axis does, with the moments of "
                    "both and the spin {:.6g} rad/s, and the rows get the turn of cage and rotor",
                    scene.release<double>().w_XB_B[2]),
        width);
  if (scenario.rotor->drive != RotorDrive::none)
    return sentence(
        "Equations: dL/dt = L x w + torque in body axes, w = I^-1 (L - C s c); L: momentum of body and rotor; I: inertia of "
        "both; s: rate "
        "that the motor gives the rotor about its axis c, with the moment C",
        width);
  return sentence(
      fmt::format("Equations: dL/dt = L x w + torque in body axes, w = I^-1 (L - h c); L: momentum of body and rotor; I: "
                  "inertia of both without the rotor's about its axis c; h: momentum of the rotor about c, {}",
                  scenario.rotor->has_friction() ? "which only the bearing's friction changes" : "which is constant"),
      width);
}

}  // namespace earthtop::tool
