// SPDX-License-Identifier: GPL-3.0-or-later
/// A scenario of which nothing but the motion is wanted.
#pragma once

#include "earthtop/scenario/scenario.hpp"

namespace earthtop {

/// Changes a scenario so that it runs to `end_s` in double precision, and asks for nothing but the motion.
inline void ask_for_motion_alone(Scenario& scenario, double end_s) {
  if (end_s > 0) scenario.duration_s = end_s;
  scenario.output_step_s = scenario.duration_s;
  scenario.threshold_rad.reset();
  scenario.accuracy_rad.reset();
  scenario.uncertainty.reset();
  scenario.ledger.reset();
  scenario.sensitivities = false;
  scenario.precision = Precision::bits53;
  scenario.numerics.relative_tolerance = default_tolerance(Precision::bits53);
}

}  // namespace earthtop
