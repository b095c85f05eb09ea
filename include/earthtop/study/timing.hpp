// SPDX-License-Identifier: GPL-3.0-or-later
/// How long a study takes, from some of its points that are computed to find out.
#pragma once

#include <cstdint>
#include <string>

#include "earthtop/study/run_study.hpp"

namespace earthtop {

struct StudyTiming {
  double core_seconds = 0;         ///< processor time of the whole study (s)
  double seconds = 0;              ///< until a shard is done with its threads, one a core at most (s)
  std::uint64_t shard_points = 0;  ///< points of the shard
  double points_timed = 0;         ///< points that were computed; parts of points count as such
  double spent_seconds = 0;        ///< processor time that they took (s)
  bool is_timed() const { return points_timed > 0; }
};

/// Computes some points of a study, chosen across its design, in groups as large as those that a study computes, for about half a
/// second of processor time (a second and a half where they are slow), and tells from their times how long the study takes. Points that take
/// longer than `patience_s` are given up, and their time told from the share of them that was done. Where nothing can be timed, the times
/// are those of `estimate`. Nothing is stored.
/// @param jobs  threads of the study, at least 1   @throws ScenarioError if the base cannot be read
StudyTiming time_study(const Study& study, unsigned jobs, const StudyShard& shard = {}, double patience_s = 8);

/// What the times rest on, in words.
std::string timing_basis(const StudyTiming& timing);

}  // namespace earthtop
