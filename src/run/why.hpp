// SPDX-License-Identifier: GPL-3.0-or-later
/// Why a drift is what it is, in sentences with the run's own numbers.
#pragma once

#include <vector>

#include "earthtop/run.hpp"
#include "earthtop/vectors.hpp"

namespace earthtop {

/// The sentences on a run whose rows, drift, verdict and theory are known; tools/README.md lists the laws that they tell. There are none
/// where a law does not apply, or does not agree with the run, and none at all where the verdict does not trust the whole run: but that
/// a free body turns over is told of an unstable run, too.
std::vector<WhySentence> why_sentences(const RunResult& result);

/// The lean of the cone on which a top precesses, because the laboratory turns about North, too.
struct ConeLean {
  double south_rad = 0;     ///< towards the South; negative towards the North
  double left_out_rad = 0;  ///< size of the terms that the theory leaves out
};

/// To first order in the Earth's rate, for a top whose tilt hardly changes: with p the rate of precession, u = cos(tilt) and
/// m = I3 w3 / I1 - p u, the tilt of the axis above North is less than its mean by
///   (Omega_north / p) (m^2 - p m u - 2 p^2) / (m^2 - 2 p m u)
/// and above South more by as much: the response of Lagrange's equations to -W.L at the frequency p. For a fast top it is
/// Omega cos(latitude) / p.
/// @param p  rate of precession (rad/s)   @param axial  I3 w3 / I1 (rad/s)   @param swing  half range of the tilt (rad)
ConeLean cone_lean(double p, double axial, double cos_tilt, double sin_tilt, double swing, const Vec3<double>& W_L);

}  // namespace earthtop
