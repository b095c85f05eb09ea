// SPDX-License-Identifier: GPL-3.0-or-later
/// The largest drifts of a run and the swings of its azimuth, taken from the motion and not from the rows.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "earthtop/run.hpp"
#include "run/looks.hpp"

namespace earthtop {

/// Gives the motion at some times (s, ascending).
using LookAt = std::function<std::vector<DriftRow>(std::vector<double>)>;

/// The same in the run's own precision.
using ExactLookAt = std::function<std::vector<ExtendedDriftRow>(std::vector<double>)>;

/// The numbers that the search for largest values needs besides the looks of a result.
struct LookSource {
  LookAt look;        ///< in double precision, for a search in smaller windows
  ExactLookAt exact;  ///< by the integration of the rows, for the value itself
  double step_s;      ///< between two looks
  bool all_exact;     ///< whether each value found has to be computed by the integration of the rows
};

/// Finds the largest drifts of axis and tip, with their times and bounds, and the swing of the azimuth about its trend. Of a run that
/// is looked at in windows the largest value lies in the best window or next to it: smaller windows around it follow, until they touch.
/// @param judged  not empty
void assess_largest(const LookSource& source, std::span<const JudgedLook> judged, RunResult& result);

}  // namespace earthtop
