// SPDX-License-Identifier: GPL-3.0-or-later
/// How many points a worker gets at once.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace earthtop::study {

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

}  // namespace earthtop::study
