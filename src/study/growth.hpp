// SPDX-License-Identifier: GPL-3.0-or-later
/// The points that a study's design shares with an older store: what a study that has grown need not compute again.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "earthtop/study/run_study.hpp"
#include "earthtop/watch.hpp"
#include "study/store.hpp"

namespace earthtop::study {

/// Says in which key two studies differ, and how; empty where they have one identity.
std::string difference(const Study& there, const Study& here);

/// The grid with the values of two grids that differ in the listed values of one axis; none for other designs.
std::optional<Study> united(const Study& one, const Study& other);

/// The points of an older store that a design has, too.
struct SharedPoints {
  StudyGrowth growth;
  bool of_quantities =
      false;  ///< nothing can be copied because of the quantities collected, though the points are the design's
  std::vector<std::pair<std::uint64_t, std::uint64_t>> pairs;  ///< number in the design, ascending, and in the store
  std::vector<std::size_t> columns;                            ///< for each quantity, its place in the store
};

/// @param build  of the store that would receive the points   @throws Interrupted
SharedPoints shared_points(Store& older, const Study& study, const StudyShard& shard, const std::string& build,
                           const Watch& watch);

/// Copies the shared points that a store lacks. @returns their number
std::uint64_t copy_shared(const SharedPoints& shared, Store& older, const Study& study, Store& store);

}  // namespace earthtop::study
