// SPDX-License-Identifier: GPL-3.0-or-later
#include "explain_text.hpp"

#include <fmt/core.h>

#include "contact_text.hpp"
#include "earthtop/results/results.hpp"

namespace earthtop::tool {
namespace {

std::string forces_text(const ContactExplanation& explained) {
  std::string text = fmt::format("{:<18}{:>11}{:>11}   {:>11}{:>11}\n", "Force", "at release", "largest", "torque", "largest");
  text += fmt::format("{:<18}{:>11}{:>11}   {:>11}{:>11}\n", "", "N", "N", "N m", "N m");
  bool left_out = false;
  for (const ContactForceSize& size : explained.forces) {
    text +=
        fmt::format("{:<18}{:>11.3e}{:>11.3e}   {:>11.3e}{:>11.3e}{}\n", spoken(size.name), size.force_release_N,
                    size.force_largest_N, size.torque_release_N_m, size.torque_largest_N_m, size.modelled ? "" : "   left out");
    left_out = left_out || !size.modelled;
  }
  text += "torque: about the centre of mass, at release and at its largest; on the rotating Earth\n";
  if (left_out) text += "left out: switched off; its size along the motion without it\n";
  return text;
}

std::string friction_text(const ContactExplanation& explained, const ContactSpec& contact) {
  std::string text;
  if (explained.largest_friction_ratio) {
    text += fmt::format("Friction is {:.3g} of the normal force at most", *explained.largest_friction_ratio);
    if (contact.law == ContactLaw::rolling) text += ": less friction would let the tip slip";
    text += "\n";
  }
  if (explained.slip_relaxation_1_s)
    text += fmt::format("A small slip dies out at {:.3g} per second at the release, which every step has to follow\n",
                        *explained.slip_relaxation_1_s);
  return text;
}

std::string need_text(const std::optional<double>& steps, std::string_view step, const char* of) {
  if (!steps) return fmt::format("does not move the {}", of);
  const bool percent = step.ends_with("%");
  return fmt::format("{:.2g} {} ({})", *steps, percent ? "%" : "arcsec", of);
}

std::string inputs_text(const ContactExplanation& explained) {
  if (explained.inputs.empty()) return "How well the inputs must be known: not known\n";
  std::string text =
      fmt::format("How well the inputs must be known: an error that moves the prediction by {} s as far as the Earth does\n",
                  explained.inputs_at_s);
  bool of_friction = false;
  for (const ContactInputNeed& need : explained.inputs) {
    of_friction = of_friction || need.step.ends_with("%");
    text += fmt::format("  {:<22}{}; {}\n", spoken(need.input), need_text(need.hides_axis, need.step, "axis"),
                        need_text(need.hides_tip, need.step, "tip"));
  }
  text += of_friction ? "  (nobody knows a coefficient of friction to 1 %, and few tables are level to an arcsecond)\n"
                      : "  (few tables are level to an arcsecond)\n";
  return text;
}

}  // namespace

std::string contact_explanation_text(const ContactExplanation& explained, const Scene& scene) {
  const Scenario& scenario = scene.scenario();
  std::string text =
      fmt::format("{}\nDrift by the Earth's rotation after {:.6g} s: axis {:.3e} rad, tip {:.3e} m; {}\n", scenario.name,
                  explained.followed_s, explained.drift_axis_rad, explained.drift_tip_m, matching_rule(scenario));
  if (!explained.ended_by.empty())
    text += fmt::format("Then the run ends: {}\n", explained.ended_by);
  else if (explained.followed_s < scenario.duration_s * (1 - 1e-9))
    text += fmt::format("The motion was followed so far, and not to {} s, which would take longer\n", scenario.duration_s);
  text += '\n' + forces_text(explained) + friction_text(explained, *scenario.contact) + '\n' + inputs_text(explained);
  return text;
}

}  // namespace earthtop::tool
