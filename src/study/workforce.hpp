// SPDX-License-Identifier: GPL-3.0-or-later
/// Workers that compute chunks: threads of this process, or other processes.
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

  /// Whether a worker would start soon on a chunk given at this moment.
  virtual bool wants_work() = 0;
  virtual void give(Chunk chunk) = 0;
  /// Number of chunks given whose results have not come back.
  virtual std::size_t under_way() const = 0;
  /// Number of points that the chunks under way have computed so far, parts of points included; 0 if it is not known.
  virtual double points_begun() const { return 0; }
  /// The results that came since the last call; if there are none, waits for some, but no longer than `patience`.
  virtual std::vector<PointResult> collect(std::chrono::milliseconds patience) = 0;
};

/// @param jobs number of threads, at least 1 @param watch may stop the runs
std::unique_ptr<Workforce> make_threads(const Study& study, unsigned jobs, const Watch& watch);

}  // namespace earthtop::study
