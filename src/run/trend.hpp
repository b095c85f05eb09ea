// SPDX-License-Identifier: GPL-3.0-or-later
/// The trend of a run's azimuth drift.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/drift/trend.hpp"
#include "earthtop/run.hpp"

namespace earthtop {

/// When to look at the azimuths of a scene for the trend, known before the integration.
struct TrendPlan {
  std::string no_precession;                    ///< why the azimuth of this scene has no secular rate; else empty
  std::string mean_only;                        ///< what acts so that only a mean over the run has a meaning; else empty
  std::optional<TrendFrequencies> frequencies;  ///< of a symmetric top, in closed form
  std::vector<double> times_s;                  ///< in equal steps from the release onward; none where no look is needed
};

/// The looks at a symmetric top are few: their times are such that no multiple of the nutation, with or without the precession, looks
/// like a slow swing. Other bodies are looked at three times in the period of their fastest turn.
TrendPlan plan_trend(const Scene& scene);

/// The trend without its swings, which come from the motion (largest_drift.hpp).
/// @param result  its looks and its verdict are read   @param seen  the azimuths at the plan's times, as far as the run got
/// @returns nothing where fewer than three looks have an azimuth
std::optional<SecularDrift> assess_trend(const RunResult& result, const TrendPlan& plan, std::span<const AzimuthSample> seen);

}  // namespace earthtop
