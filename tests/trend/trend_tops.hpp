// SPDX-License-Identifier: GPL-3.0-or-later
/// Random conservative tops for counting how often the trend's bound holds, and their rates over a far longer time.
#pragma once

#include <cstdint>
#include <optional>

#include "support/scenes.hpp"

namespace earthtop::testing {

/// Top number `index`, over 1 to 30 turns of precession: standing or hanging, slow or fast, symmetric or not, at any latitude,
/// with any rule of matching and precession at release, on an Earth that turns up to 1000 times as fast as the real one.
/// @returns nothing where the top has no such release, no precession, or nutates more than `most_phase` rad in that time
std::optional<Scenario> random_trend_top(std::uint64_t index, double most_phase);

/// How the trend of a run compares with that of a run `times` as long.
struct TrendJudged {
  SecularDrift trend;
  TheoryReport theory;  ///< without a name where there is none
  double true_rate_rad_s = 0, true_bound_rad_s = 0;
  double error() const { return std::abs(*trend.azimuth_rate_rad_s - true_rate_rad_s); }
};
/// @returns nothing where the run is not reliable or its trend not determined, or where the longer run does not tell more
std::optional<TrendJudged> judge_trend(const Scenario& scenario, double times);

}  // namespace earthtop::testing
