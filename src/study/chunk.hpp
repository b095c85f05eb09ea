// SPDX-License-Identifier: GPL-3.0-or-later
/// A chunk is a small group of points: the unit of work that a worker receives and whose results it returns.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "study/collect.hpp"
#include "study/design.hpp"

namespace earthtop::study {

using Chunk = std::vector<PlannedPoint>;

/// The number of points in a chunk: about a third of a second of work, by the speed measured so far; fewer near the end, so
/// that the workers finish together. Eight points side by side take about as long as one, so that quick points come in eights.
class ChunkSize {
 public:
  explicit ChunkSize(double seconds_a_point, unsigned workers) : seconds_a_point_(seconds_a_point), workers_(workers) {}
  void learn(std::uint64_t points, double seconds) {
    if (points > 0) seconds_a_point_ = seconds * workers_ / static_cast<double>(points);
  }
  std::size_t points(std::uint64_t left) const {
    constexpr double kSeconds = 0.3, kSlow = 0.25, kLanes = 8, kMost = 512, kShares = 4;
    const double in_time = kSeconds / std::max(seconds_a_point_, 1e-9);
    const double points = std::min(in_time, static_cast<double>(left) / (kShares * workers_));
    if (seconds_a_point_ > kSlow) return static_cast<std::size_t>(std::max(points, 1.0));
    return static_cast<std::size_t>(std::clamp(std::floor(points / kLanes) * kLanes, kLanes, kMost));
  }

 private:
  double seconds_a_point_;
  unsigned workers_;
};

/// Runs the points of a chunk. Interrupted points are left out of the results.
std::vector<PointResult> compute(const Study& study, const Collector& collector, const Chunk& chunk, const Watch& watch);

}  // namespace earthtop::study
