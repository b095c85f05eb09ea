// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "earthtop/integrate/motion_integration.hpp"

namespace earthtop {

/// The output times in natural units.
template <class T>
std::vector<T> natural_times(const MotionProblem<T>& problem) {
  std::vector<T> times;
  times.reserve(problem.times_s.size());
  for (const double t : problem.times_s) times.push_back(problem.units.time_from_s(T(t)));
  return times;
}

}  // namespace earthtop
