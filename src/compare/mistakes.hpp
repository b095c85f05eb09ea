// SPDX-License-Identifier: GPL-3.0-or-later
/// Mistakes in physics that other programs make, each as a change of the scenario, and the numbers that they may have had otherwise.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "earthtop/scene/scene.hpp"

namespace earthtop::compare {

/// A mistake that a program makes as a whole.
struct Mistake {
  std::string_view words;  ///< "without the Coriolis torque": the motion is ...
  /// The scenario as such a program takes it; none where the mistake does not apply to it, or changes nothing.
  std::optional<Scenario> (*of)(const Scene&);
};
std::span<const Mistake> mistakes();

/// A number of the scenario that another program may have had otherwise.
struct Suspect {
  std::string_view name, unit;
  double size;                                   ///< of such a number; 0: that of the value itself
  std::optional<double> (*value)(const Scene&);  ///< none where the scenario has no such number
  void (*put)(Scenario&, double value);
};
std::span<const Suspect> suspects();

/// The scenario with what the Earth is resolved to, so that changes of the site do not change gravity.
Scenario resolved_scenario(const Scene& scene);

}  // namespace earthtop::compare
