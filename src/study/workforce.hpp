// SPDX-License-Identifier: GPL-3.0-or-later
/// Those who compute chunks: threads of this process, or processes elsewhere.
#pragma once

#include <chrono>
#include <memory>
#include <vector>

#include "study/chunk.hpp"

namespace earthtop::study {

class Workforce {
 public:
  Workforce() = default;
  virtual ~Workforce() = default;
  Workforce(const Workforce&) = delete;
  Workforce& operator=(const Workforce&) = delete;

  /// Whether a chunk given now would be begun soon.
  virtual bool wants_work() = 0;
  virtual void give(Chunk chunk) = 0;
  /// Chunks given and not yet given back.
  virtual std::size_t under_way() const = 0;
  /// How many points the chunks under way have done, parts of points included; 0 where nobody knows.
  virtual double points_begun() const { return 0; }
  /// What has been computed since the last call; waits until there is something, but no longer than `patience`.
  virtual std::vector<PointResult> collect(std::chrono::milliseconds patience) = 0;
};

/// @param jobs  threads, at least 1   @param watch  may stop the runs
std::unique_ptr<Workforce> make_threads(const Study& study, unsigned jobs, const Watch& watch);

}  // namespace earthtop::study
