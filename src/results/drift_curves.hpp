// SPDX-License-Identifier: GPL-3.0-or-later
/// The chart of the drift over time, made of numbers, so that a run and the page of its results draw the same one.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "earthtop/plot/plot.hpp"
#include "results/compared_words.hpp"

namespace earthtop {

/// The numbers of the chart; each list has one number for each time.
struct DriftCurves {
  std::string title, matching_rule;
  ComparedWords compared;
  std::vector<double> t_s, axis_rad, tilt_rad;
  std::vector<double> azimuth_rad;  ///< NaN where it is not known
  std::array<std::vector<double>, 3> axis_L, ref_axis_L;
  std::vector<bool> is_reliable;
  bool is_all_reliable = true;               ///< at these times and at the output rows
  std::size_t a_window = 0;                  ///< as RunResult::looks_a_window
  bool is_resolved = false;                  ///< whether the times resolve the fastest motion of the axes
  std::optional<double> azimuth_rate_rad_s;  ///< of the secular line; none where it is the mean of the run and no more
  /// The last drift that can be trusted.
  struct End {
    double t_s, axis_rad, bound_rad;
  };
  std::optional<End> end;
};

/// The angle between the axes with its part in tilt and the mark of its end; below it what is left of the azimuth beside its secular line,
/// or, without one, the azimuth where it tells how the axes stand to each other.
/// @param shown  what the lines go through   @param drawn  what the choice of panels, units and line rests on
Figure drift_figure(const DriftCurves& shown, const DriftCurves& drawn);

}  // namespace earthtop
