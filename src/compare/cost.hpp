// SPDX-License-Identifier: GPL-3.0-or-later
/// Comparison of the cost of computing two results.
#pragma once

#include <vector>

#include "compare/comparand.hpp"
#include "earthtop/compare/compare.hpp"

namespace earthtop::compare {

/// Compares the steps, evaluations and seconds of solution and certificate together, as far as both results state them. If a
/// limit is set on a number that is not stated, that is a finding.
std::vector<CostRatio> compare_cost(const Comparand& reference, const Comparand& candidate, const Tolerances& tolerances,
                                    std::vector<CompareFinding>& findings);

}  // namespace earthtop::compare
