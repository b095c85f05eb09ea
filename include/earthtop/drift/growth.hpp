// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds how fast an infinitesimal disturbance of a motion grows, from the variational equations integrated alongside the motion.
#pragma once

#include <optional>
#include <vector>

#include "earthtop/integrate/motion_integration.hpp"
#include "earthtop/watch.hpp"

namespace earthtop {

/// The motion on the rotating Earth, or the non-rotating prediction.
enum class MotionKind { rotating, reference };

/// The first time at which a disturbance had grown so far.
struct GrowthPoint {
  double t_s = 0;
  double log_growth = 0;  ///< natural logarithm of |xi(t)| / |xi(0)|
};

/// The growth of a disturbance xi = (theta, dw / w0), where theta is the turn of the attitude in body axes, dw the change of
/// the inertial rate, and w0 the scene's fastest rate. In a regular motion it grows like the angle w0 t that the motion turns
/// through, since a change of a rate shears phases apart; in an unstable motion it grows exponentially.
struct GrowthReport {
  std::vector<GrowthPoint> rises;       ///< ascending in time and in growth, at least a tenth of an e-folding apart
  std::optional<double> exponential_s;  ///< when the growth first exceeded kRegularGrowth (1 + w0 t) (s)
  double mean_exponent_1_s = 0;         ///< log growth at the end divided by the time (1/s)
  /// The finite-time Lyapunov exponent at late times (1/s): the slope of a line fitted to log growth - log(1 + w0 t) over the
  /// second half of the duration. It is 0 where that slope makes less than two e-foldings in the half, which an oscillation may
  /// make as well, and negative where neighbouring motions converge. None before three quarters of the duration are reached.
  std::optional<double> late_exponent_1_s;
  double end_s = 0;  ///< time reached
  /// How far the motion itself went from its state at release, at most, by `exponential_s` (or the end): the change of
  /// gravity's direction plus that of rate / w0, both seen from the body. For a symmetric body a turn about its axis does not
  /// count. Close to 0 for an equilibrium and for a steady turn.
  double departure = 0;
  /// When friction had braked an upright symmetric top to its critical spin (s); 0 for a top that was released below it.
  std::optional<double> critical_spin_s;
  bool completed = false;  ///< whether the whole duration was integrated
  StepCounters counters;

  /// When the growth first passed exp(log_growth) (s); none if it did not.
  std::optional<double> passes_s(double log_growth) const;
};

/// Growth is called exponential where it is so many times faster than the angle swept, 1 + w0 t.
inline constexpr double kRegularGrowth = 100;
/// The tolerance at which growth is followed first, and the smaller one at which the growth found is confirmed.
inline constexpr double kCoarseGrowthTolerance = 1e-7, kConfirmingGrowthTolerance = 1e-10;
/// Growth is followed for at most this many steps.
inline constexpr std::int64_t kMostGrowthSteps = 50'000'000;

/// The tolerance at which the growth along a problem's motions is to be followed first; none where nothing has to be followed:
/// where disturbances of the motion grow no faster than with time, or where an upright top is at its critical spin, so that
/// no growth says more. Motions with a closed form are followed closely, as they leave a separatrix by the integration's own
/// error.
std::optional<double> growth_tolerance(const MotionProblem<double>& problem, double duration_s);

/// The work of following the growth along one motion, from the problem's pace.
Work growth_work(const MotionProblem<double>& problem, double duration_s, double relative_tolerance);

/// Integrates the variational equations
///   dtheta/dt = theta x w + dw ,  Theta ddw/dt = (Theta dw) x w + (Theta w) x dw + m r x ((R^T f) x theta) ,
/// from the release to `duration_s`, for three disturbances in directions that belong to no symmetry of a body; the largest
/// growth counts. Applied torques add their change. A body held by a gimbal is disturbed only as the gimbal lets it move.
/// @param problem  its output times are not read
/// @param relative_tolerance  of the integration. With the coarse one the growth is right to some percent. The integration's
/// error can look like growth, though, and a motion on a separatrix leaves it because of that error: growth that matters should
/// be confirmed with a smaller tolerance.
/// @param watch  may end the integration early; the report is then not `completed`
GrowthReport disturbance_growth(const MotionProblem<double>& problem, MotionKind kind, double duration_s,
                                double relative_tolerance, const Watch& watch = {});

}  // namespace earthtop
