// SPDX-License-Identifier: GPL-3.0-or-later
/// A few points together: what a worker is given, and what it gives back.
#pragma once

#include <vector>

#include "study/collect.hpp"
#include "study/design.hpp"

namespace earthtop::study {

using Chunk = std::vector<PlannedPoint>;

/// Runs the points of a chunk. Points whose run was interrupted are left out.
std::vector<PointResult> compute(const Study& study, const Collector& collector, const Chunk& chunk, const Watch& watch);

}  // namespace earthtop::study
