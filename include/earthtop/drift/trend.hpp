// SPDX-License-Identifier: GPL-3.0-or-later
/// Separates the secular rate of an azimuth drift from the swings at the frequencies of precession and nutation.
#pragma once

#include <span>

namespace earthtop {

/// One look at the two axes for the trend.
struct AzimuthSample {
  bool defined = true;                 ///< false where an axis is vertical
  double drift_rad = 0;                ///< compass azimuth minus that of the reference, continuous
  double ref_east = 0, ref_north = 0;  ///< horizontal part of the reference axis
  double horizontal = 0;               ///< length of the horizontal part of the rotating axis
};

/// The frequencies of the reference motion: its azimuth turns at `precession` (rad/s, counterclockwise about Up, the mean) and
/// its tilt repeats at `nutation` (rad/s, positive).
struct TrendFrequencies {
  double precession_rad_s = 0;
  double nutation_rad_s = 0;
  bool exact = true;  ///< false for those of a body without symmetry, which are estimates
};

struct TrendEstimate {
  double rate_rad_s = 0;
  double bound_rad_s = 0;  ///< contains the error in about 95 of 100 tops
};

/// Fits a line together with the swings to an azimuth drift sampled in equal steps.
///
/// To first order in the Earth's rate the drift of a symmetric top is a line, swings at the frequencies of nutation and at their
/// sums and differences with that of precession, and, because the Earth changes the frequency of nutation, swings at multiples
/// of the nutation that grow with time. Several selections of these are fitted, each with weights that fall smoothly to zero
/// at both ends, which takes out the swings that are not among them, and each to three windows. The fit whose windows agree best
/// is taken. The scatter of its slopes in further windows tells the error; the factor between the two was found by counting
/// (tests/trend).
/// @param drift_rad  at least 100 values   @param step_s  time between two of them
TrendEstimate estimate_trend(std::span<const double> drift_rad, double step_s, const TrendFrequencies& frequencies);

}  // namespace earthtop
