// SPDX-License-Identifier: GPL-3.0-or-later
/// The motion of a run as data of the pictures that move.
#pragma once

#include <vector>

#include "earthtop/vectors.hpp"
#include "report/html.hpp"
#include "report/run_data.hpp"

namespace earthtop::report {

/// Least and greatest of numbers, of those that are finite; NaN where none is.
struct Reach {
  double low = kNoNumber, high = kNoNumber;
};
Reach reach_of(const std::vector<double>& list);

/// The larger side of the smallest rectangle along the axes around all finite points.
double extent(const std::vector<double>& x, const std::vector<double>& y);

/// Adds the motion that is played, the top that moves, and the Earth's rate; without torques.
void add_motion(const Run& run, Json& data);

/// The Earth's rate in the laboratory's axes at a time, which change on a journey (rad/s).
Vec3<double> earth_rate_L(const Scene& scene, double t_s);

}  // namespace earthtop::report
