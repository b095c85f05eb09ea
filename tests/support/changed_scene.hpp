// SPDX-License-Identifier: GPL-3.0-or-later
/// Scenes that differ from others: a scene itself never changes.
#pragma once

#include <utility>
#include <vector>

#include "earthtop/scene/scene.hpp"

namespace earthtop::testing {

/// The scene of a changed scenario. @param change  takes the scenario by reference
template <class Change>
Scene changed(const Scene& scene, const Change& change) {
  Scenario scenario = scene.scenario();
  change(scenario);
  return resolve(std::move(scenario));
}

inline std::vector<Scene> resolved(const std::vector<Scenario>& scenarios) { return {scenarios.begin(), scenarios.end()}; }

}  // namespace earthtop::testing
