// SPDX-License-Identifier: GPL-3.0-or-later
/// The effect budget states, to first order, what every effect does to a scene, whether the scene models it or not, and how
/// well the inputs must be known for the Earth's effect to be visible.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "earthtop/scene/scene.hpp"
#include "earthtop/watch.hpp"

namespace earthtop {

/// One effect of the budget. A run reports the difference of its two predictions as the drift. An effect that acts in both
/// predictions alike largely cancels: it changes the drift only by a small part of it.
struct EffectEntry {
  std::string name;           ///< name of the effect in the catalogue of effects
  bool modelled = false;      ///< whether the scene includes the effect
  bool assumed = false;       ///< whether its size is a typical one, because the scene gives none
  bool in_difference = true;  ///< whether it enters the difference of the two predictions to first order, or cancels
  /// Magnitude of its torque at release and its largest magnitude (N m); empty where no parameter gives the effect's size.
  std::optional<double> torque_release_N_m, torque_largest_N_m;
  /// Largest angle by which it moves the axis in each prediction (rad); empty where it acts in one prediction only, or where
  /// the motion could not be followed.
  std::optional<double> displacement_rad;
  std::optional<double> drift_rad;        ///< largest change of the axis drift (rad); empty if the motion was not followed
  std::optional<double> drift_final_rad;  ///< change of the axis drift at the end of the run (rad)
  std::string reason;                     ///< why it is modelled or left out, or what is unknown about it
};

/// How far an error of one input moves the predicted axis, compared with the Earth's effect.
struct InputNeed {
  std::string name;  ///< one of kInputNames
  double value = 0;
  double displacement_per_unit_rad = 0;  ///< largest displacement of the predicted axis per unit of the input (rad)
  double drift_per_unit_rad = 0;         ///< change of the drift at the end per unit of the input (rad)
  /// The input error that moves the predicted axis by as much as the Earth does; for the latitude and the Earth's rate, the
  /// error that changes the drift by 100 percent. Empty where no error does so.
  std::optional<double> hides_earth;
};

struct Budget {
  double followed_s = 0;       ///< how long the motion was followed (s); later times are extrapolated
  double earth_drift_rad = 0;  ///< axis drift at the end (rad), from the deviation equations
  std::vector<EffectEntry> effects;
  std::vector<InputNeed> inputs;
  std::string inputs_unavailable;  ///< why there are no inputs
  std::vector<std::string> warnings;
};

/// Integrates both predictions together with their first-order response to every effect's strength (variational equations of
/// the reference motion and of the deviation). Of a gyrostat it states torques and the drift of all effects together.
/// @param watch  may end the computation early
Budget effect_budget(const Scene& scene, const Watch& watch = {});
/// Estimates the time (s) that `effect_budget` takes on one core.
double budget_seconds(const Scene& scene);

/// Which effects the choice "auto" switched on and which it left out.
struct Selection {
  double accuracy_rad = 0;
  std::vector<std::string> switched_on, left_out;
  double left_out_drift_rad = 0;  ///< estimated drift (rad) due to all effects left out
  double seconds = 0;             ///< wall time of the choice (s)
};
/// Switches on those effects without a parameter of their own that the requested accuracy needs: the gravity gradient and,
/// where a date is given, tide and polar motion. First variations of both motions give the size of each effect.
/// @param scene  must have effects.automatic and an accuracy; on return it has the chosen effects
Selection select_effects(Scene& scene, const Watch& watch = {});
/// Estimates the time (s) that `select_effects` takes on one core.
double selection_seconds(const Scene& scene);

/// The effect budget of what a run of the scene would model: where the scene leaves the choice of effects open, they are chosen
/// first, and `scene` has them then.
/// @returns nothing if the watch asked to stop
std::optional<Budget> explain_effects(Scene& scene, const Watch& watch = {});

}  // namespace earthtop
