// SPDX-License-Identifier: GPL-3.0-or-later
/// A chunk is a small group of points: the unit of work that a worker receives and whose results it returns.
#pragma once

#include <vector>

#include "study/collect.hpp"
#include "study/design.hpp"

namespace earthtop::study {

using Chunk = std::vector<PlannedPoint>;

/// Runs the points of a chunk. Interrupted points are left out of the results.
std::vector<PointResult> compute(const Study& study, const Collector& collector, const Chunk& chunk, const Watch& watch);

}  // namespace earthtop::study
