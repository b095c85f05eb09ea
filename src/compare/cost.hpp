/// What both results cost to compute.
#pragma once

#include <vector>

#include "compare/comparand.hpp"
#include "earthtop/compare/compare.hpp"

namespace earthtop::compare {

/// Steps, evaluations and seconds of solution and certificate together, as far as both state them.
std::vector<CostRatio> compare_cost(const Comparand& reference, const Comparand& candidate, const Tolerances& tolerances);

}  // namespace earthtop::compare
