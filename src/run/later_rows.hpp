// SPDX-License-Identifier: GPL-3.0-or-later
/// Rows of a long table that are made when they are written: they are looks at the motion of a run, as those of its pictures are.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "earthtop/run/each_row.hpp"
#include "run/looks.hpp"

namespace earthtop {

/// The same scene with few rows, each of which is one of the scene's own.
Scene with_few_rows(const Scene& scene);

/// Makes all rows of a run that holds few.
class LaterRows {
 public:
  /// @param few  the scene of the run: with few rows   @param times  of all rows   @param judged  of the run, not empty
  /// @param ahead  whether to make rows on a thread of their own while others are visited
  LaterRows(Scene few, OutputTimes times, IntegrationOptions options, LookMemory memory, std::vector<JudgedLook> judged,
            bool ahead);

  /// The number of rows up to a time.
  std::size_t count_until(double reached_s) const;
  /// Visits them. @throws std::runtime_error
  void visit(const RunResult& result, const std::function<void(const DriftRow&)>& visit, const Watch& watch) const;
  /// Whether the verdict trusts every row.
  bool are_all_trusted(const RunResult& result) const;
  /// Empty before all rows were visited.
  const std::optional<AxisMeans>& means() const { return means_; }

 private:
  /// A part of the rows: numbers and times of those that the result does not hold, and what is made of them.
  struct Part {
    std::size_t begin = 0, end = 0;
    std::vector<DriftRow> made;
  };
  LookMemory memory_for_rows() const;
  Part make(std::size_t begin, std::size_t end, const RunResult& result, const LookMemory& memory, const Watch& watch) const;

  Scene few_;
  OutputTimes times_;
  IntegrationOptions options_;
  LookMemory memory_;
  std::vector<JudgedLook> judged_;
  bool ahead_;
  mutable std::optional<AxisMeans> means_;
};

}  // namespace earthtop
