// SPDX-License-Identifier: GPL-3.0-or-later
/// The effect budget: what every effect does to a scene, to first order, whether the scene models it or not; and how well the
/// inputs must be known for the Earth's effect to be seen.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "earthtop/scene/scene.hpp"
#include "earthtop/watch.hpp"

namespace earthtop {

/// One effect. The difference of the two predictions is what a run reports as drift: an effect that acts in both enters it only
/// through the Earth's, as a small part of the drift.
struct EffectEntry {
  std::string name;           ///< as the scenario's key names it
  bool modelled = false;      ///< whether the scene has it
  bool assumed = false;       ///< whether its size is a usual one, for want of the scene's
  bool in_difference = true;  ///< whether it enters the difference of the two predictions to first order, or cancels
  /// Size of its torque at release and at its largest (N m); none where no parameter says how large the effect is.
  std::optional<double> torque_release_N_m, torque_largest_N_m;
  /// The largest angle by which the effect moves the axis in each prediction (rad); none where it acts in one prediction only,
  /// or where the motion could not be followed.
  std::optional<double> displacement_rad;
  std::optional<double> drift_rad;        ///< by how much it changes the axis drift, at most; none as above
  std::optional<double> drift_final_rad;  ///< the same at the end
  std::string reason;                     ///< why it is modelled or left out, or what is not known of it
};

/// How the predicted axis moves with an input, against the Earth's effect.
struct InputNeed {
  std::string name;  ///< one of kInputNames
  double value = 0;
  double displacement_per_unit_rad = 0;  ///< of the predicted axis, at most, for one unit of the input
  double drift_per_unit_rad = 0;         ///< of the drift at the end
  /// The error of the input that moves the predicted axis by as much as the Earth does (of the latitude and the Earth's rate:
  /// changes the drift by all of itself); none where no error does.
  std::optional<double> hides_earth;
};

struct Budget {
  double followed_s = 0;       ///< how far the motion was followed; what is later is scaled with time and drift
  double earth_drift_rad = 0;  ///< of the axis at the end, from the deviation equations
  std::vector<EffectEntry> effects;
  std::vector<InputNeed> inputs;
  std::string inputs_unavailable;  ///< why there are no inputs
  std::vector<std::string> warnings;
};

/// Follows both predictions with the first variations by every effect's strength (variational equations of the reference motion
/// and of the deviation). @param watch  may end it early
Budget effect_budget(const Scene& scene, const Watch& watch = {});
/// The seconds that the budget takes on one core, roughly.
double budget_seconds(const Scene& scene);

/// The effects that the setting "auto" has switched on, and those that it has left out.
struct Selection {
  double accuracy_rad = 0;
  std::vector<std::string> switched_on, left_out;
  double left_out_drift_rad = 0;  ///< estimate of what is left out, altogether
  double seconds = 0;             ///< what the choice cost
};
/// Switches the effects on that a scene's accuracy needs, of those that have no parameter of their own: gravity gradient, and
/// where a date is given tide and polar motion. They are sized by first variations of both motions.
/// @param scene  with effects.automatic and an accuracy; becomes the scene with the effects chosen
Selection select_effects(Scene& scene, const Watch& watch = {});
/// The seconds that the choice takes on one core, roughly.
double selection_seconds(const Scene& scene);

}  // namespace earthtop
