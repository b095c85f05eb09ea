// SPDX-License-Identifier: GPL-3.0-or-later
/// The points of a study as the page's explorer shows them: each by itself, or, where they are many, how densely they lie.
#pragma once

#include "earthtop/watch.hpp"
#include "report/html.hpp"
#include "study/store.hpp"

namespace earthtop::report {

inline constexpr std::uint64_t kMostSinglePoints = 1000;

/// Adds to the page's data the base scenario, the axes, the quantities, and the points: at most kMostSinglePoints by
/// themselves, more of them as cells, each with the number of its points, their mean, and one of them as an example.
/// @param document  of the study, which says how settings and quantities are called
void add_points(study::Store& store, Page& page, const Json& document, const Watch& watch);

}  // namespace earthtop::report
