// SPDX-License-Identifier: GPL-3.0-or-later
/// The drift that a budget is about.
#pragma once

#include <utility>

#include "earthtop/scene/scene.hpp"

namespace earthtop {

/// Returns the scene whose drift is computed for a budget: in double precision, without sensitivities and ledger.
inline Scene drift_scene(const Scene& scene) {
  Scenario scenario = scene.scenario();
  scenario.sensitivities = false;
  scenario.ledger.reset();
  if (scenario.precision != Precision::bits53) {
    scenario.precision = Precision::bits53;
    scenario.numerics.relative_tolerance = default_tolerance(scenario.precision);
  }
  return resolve(std::move(scenario));
}

constexpr double kAffordableDrift_s = 60;  ///< of computing

}  // namespace earthtop
