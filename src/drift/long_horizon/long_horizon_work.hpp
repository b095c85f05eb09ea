// SPDX-License-Identifier: GPL-3.0-or-later
/// The work of the drift by the long-horizon method (long_horizon_drift.hpp), predicted from the rules by which it chooses its
/// steps and its walks.
#pragma once

#include <algorithm>

#include "earthtop/drift/drift_integration.hpp"
#include "integrate/tilted_top.hpp"

namespace earthtop {

struct LongHorizonDriftWork {
  Work work;              ///< evaluations are set-ups of the closed form
  double looks = 0;       ///< how often the motion is evaluated between the rows, to count turns of its angles
  bool averages = false;  ///< whether the steps average over the nutation
  double precession_turns = 0;
  double drift_rad = 0;  ///< of the axis at the end, in rough terms
  /// Of that drift, by the tolerance of the steps, their round-off and what averaging leaves; infinite where the release flings the top
  /// round, whose nutation is not small, so that these do not tell it.
  double error_rad = 0;
};

/// @param problem  of a top symmetric about body axis 3
/// @param options  with an observer other than the laboratory for the second integration, which takes over the steps of the
/// first one   @param looks  the number of times, beside the problem's, at which the motions are looked at
LongHorizonDriftWork long_horizon_drift_work(const DriftProblem<double>& problem, const IntegrationOptions& options,
                                             double looks);

namespace long_horizon {

constexpr double kSmall = 1e-3;      ///< smallest drift taken as a difference, which has nine digits of it (rad)
constexpr double kNodeDrift = 4e-3;  ///< drift sought at the largest of the four rates of the cubic (rad)
/// The steps of the second integration, in those of the first: incommensurable with them.
constexpr double kGoldenPart = 0.6180339887498949;
/// The tolerance of the walks at amplified rates.
inline double node_tolerance(double tolerance) { return kNodeDrift * std::max(tolerance, 1e-11); }
constexpr double kUnseenError = 5e-12;  ///< error of averaging that comparisons may not show, at the end (rad)
constexpr double kUnseenShare = 10;     ///< the same, as a multiple of the error that averaging is said to leave
/// The largest angle by which both frames together may turn between two looks (rad). The limit to a frame's rate is at least
/// twice the rate of a fast top's precession, which is what steps over many nutations follow.
constexpr double look_angle(bool averages) { return averages ? 3 : 1.5; }
/// The largest rate, in those of the Earth, at which a top that is averaged over its nutation may be integrated to find a small
/// drift. The averaging error is proportional to the square of the rate; there it must not exceed the error of a difference.
double largest_node(const TiltedTop<double>& top, double duration, Averaging averaging);

}  // namespace long_horizon
}  // namespace earthtop
