// SPDX-License-Identifier: GPL-3.0-or-later
/// Random scenes in strata: every regime of tops and free bodies, latitudes with poles and equator, both matching rules, Earth
/// rates from tiny to as fast as a top precesses, spins from 1 to 1e5 rad/s.
#pragma once

#include <span>
#include <string_view>

#include "support/scenes.hpp"

namespace earthtop::testing {

struct Stratum {
  std::string_view name;
  Scenario (*make)(Random&);
  bool own_effects = false;  ///< torques other than gravity and the Earth's are its subject
};
std::span<const Stratum> strata();

/// Scene `index` of a stratum, the same on every platform. It has a dozen rows, over a duration in which the fastest rate turns
/// through `least_phase` to `largest_phase` rad, distributed log-uniformly.
Scenario random_scene_of(const Stratum& stratum, std::uint64_t index, double least_phase, double largest_phase);

/// The same scene cut at a random length, with 2 to 60 rows, some in long double, some with a tolerance from 1e-8 to near the least.
Scenario random_survey_scene(const Stratum& stratum, std::uint64_t index, double least_phase, double largest_phase);

/// The same scene in double or long double, with random numerics of those that a user may name for it: any method that takes
/// it, a fixed step or any tolerance from 1e-6 to a little above the least one, any observer, either form.
Scenario random_scene_by_hand(const Stratum& stratum, std::uint64_t index, double least_phase, double largest_phase);

}  // namespace earthtop::testing
