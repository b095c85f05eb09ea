// SPDX-License-Identifier: GPL-3.0-or-later
/// The effects that a budget sizes, each as an input of the variational equations.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "earthtop/budget/budget.hpp"
#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/drift/sensitivity.hpp"

namespace earthtop {

inline constexpr std::string_view kAxisPrecession = "axis_precession";

struct Candidate {
  std::string name;
  bool modelled = false;
  bool assumed = false;  ///< its size is a usual one, not this scene's
  bool in_difference = true;
  std::string reason;
  ProblemDerivative input;  ///< scaled so that responses are of order 1
  double size = 1;          ///< of the effect in units of the input
  /// Size of its torque on the rotating motion for one unit of the input (natural units).
  std::function<double(const FollowedStep&)> torque;
};

/// Everything whose size is known, from the scene or in nature.
/// @param scene  must outlive the candidates
std::vector<Candidate> effect_candidates(const Scene& scene);

/// Those of them that need no parameter of their own and are not in the scene yet: gravity gradient, and where a date is given
/// tide and polar motion.
std::vector<Candidate> selectable_effects(const Scene& scene);

/// Effects that the scene gives no coefficient for, and the platform, which both predictions ride on.
std::vector<EffectEntry> effects_of_unknown_size(const Scene& scene);

}  // namespace earthtop
