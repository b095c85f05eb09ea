// SPDX-License-Identifier: GPL-3.0-or-later
/// The motion of a scene as pictures show it, without a run of the scene: for results that were read from files.
#pragma once

#include <cstddef>
#include <vector>

#include "earthtop/run.hpp"

namespace earthtop {

struct SeenMotion {
  std::vector<DriftRow> looks;  ///< as RunResult::looks, without bounds
  std::size_t a_window = 0;     ///< as RunResult::looks_a_window
  /// Where the looks are in windows: looks at the end of the motion, which follow one another in the same steps.
  std::vector<DriftRow> last;
  DriftRow checked;  ///< the motion at the time that was asked for
};

/// Looks at a motion when and how `run` does.
/// @param until_s  the time that the run reached   @param checked_s  another time, not later
SeenMotion look_at_motion(const Scene& scene, double until_s, double checked_s, const Watch& watch = {});

/// Estimates the time (s) that this takes on one core.
double seconds_to_look(const Scene& scene);

}  // namespace earthtop
