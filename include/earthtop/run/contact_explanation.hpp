// SPDX-License-Identifier: GPL-3.0-or-later
/// The forces on a top that stands on a table: the size of every force and of its torque, the drift to be expected, and how well
/// the inputs must be known for the Earth's effect to be seen.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "earthtop/scene/scene.hpp"
#include "earthtop/watch.hpp"

namespace earthtop {

/// A force, and its torque about the centre of mass, on the rotating Earth.
struct ContactForceSize {
  std::string_view name;
  bool modelled = true;  ///< false: switched off; its size is that of the real one along the computed motion
  double force_release_N = 0, force_largest_N = 0;
  double torque_release_N_m = 0, torque_largest_N_m = 0;
};

/// The effect of an input of the contact on the prediction itself, and the error of it that moves the prediction as far as
/// the Earth does.
struct ContactInputNeed {
  std::string_view input;                       ///< as in PredictionChange
  std::string_view step;                        ///< "1 %" or "1 arcsec"
  double axis_rad = 0, tip_m = 0;               ///< change per step
  std::optional<double> hides_axis, hides_tip;  ///< number of steps; empty where the input does not move it
};

struct ContactExplanation {
  double followed_s = 0;  ///< time up to which all sizes are; less than the run's where that would take long, or at an event
  std::string ended_by;   ///< the event that ends the motion, in words; empty without one
  std::optional<double> ended_at_s;            ///< time of that event
  double drift_axis_rad = 0, drift_tip_m = 0;  ///< at that time
  std::vector<ContactForceSize> forces;
  /// Rate (1/s) at which a small slip dies out at the release; none where it does not: without friction, while rolling, and under
  /// the exact Coulomb law, where it ends.
  std::optional<double> slip_relaxation_1_s;
  /// The largest friction over normal force; none without friction.
  std::optional<double> largest_friction_ratio;
  double inputs_at_s = 0;  ///< time of the needs
  std::vector<ContactInputNeed> inputs;
};

/// Follows the motion of a scene with a contact.   @param watch  may end the computation early
ContactExplanation explain_contact(const Scene& scene, const Watch& watch = {});

}  // namespace earthtop
