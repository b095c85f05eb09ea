// SPDX-License-Identifier: GPL-3.0-or-later
/// The release and duration within given limits that make the first estimate's standard error least.
#pragma once

#include <optional>
#include <vector>

#include "plan/preparation.hpp"

namespace earthtop::plan {

/// Checks the numbers that may be chosen and their limits. @throws ScenarioError
void require_design(const ScenarioSource& source, const Overrides& overrides, const std::vector<DesignInput>& design);

/// The expected number of designs that are tried.
double expected_designs(std::size_t numbers);

/// Searches for the least standard error: first on a grid, then from the grid's best points with Nelder and Mead's simplex (GSL,
/// nmsimplex2), on an angle whose sine is the number's place within its limits. Designs without such a motion are avoided; a
/// design that is better than all before it counts only if its motion can be relied on.
/// @param plan  complete   @returns none if no design has a motion, or if the watch asked to stop
std::optional<PlanOptimum> best_design(const ScenarioSource& source, const Overrides& overrides, const MeasurementPlan& plan,
                                       const Numbers& numbers, const std::vector<DesignInput>& design, const Watch& watch,
                                       std::int64_t& predictions);

}  // namespace earthtop::plan
