// SPDX-License-Identifier: GPL-3.0-or-later
/// How fast the smallest disturbance of a motion grows: its variational equations, integrated beside it.
#pragma once

#include <optional>
#include <vector>

#include "earthtop/integrate/motion_integration.hpp"
#include "earthtop/watch.hpp"

namespace earthtop {

/// The motion on the rotating Earth, or the non-rotating prediction.
enum class MotionKind { rotating, reference };

/// By when a disturbance had grown how far for the first time.
struct GrowthPoint {
  double t_s = 0;
  double log_growth = 0;  ///< natural logarithm of |xi(t)| / |xi(0)|
};

/// Growth of a disturbance xi = (theta, dw / w0): theta the turn of the attitude in body axes, dw the change of the inertial
/// rate, w0 the scene's fastest rate. Of a regular motion it grows like the angle w0 t that the motion turns through, as rates
/// shear phases apart; of an unstable one exponentially.
struct GrowthReport {
  std::vector<GrowthPoint> rises;       ///< ascending in both; a tenth of an e-folding apart, or more
  std::optional<double> exponential_s;  ///< when it was a hundred times 1 + w0 t for the first time
  double mean_exponent_1_s = 0;         ///< log growth at the end over the time
  /// Finite-time Lyapunov exponent of late times: the slope of log growth less log(1 + w0 t), a line through the second half of
  /// the time. 0 where that makes less than two e-foldings of the half, as many as an oscillation may make; negative where
  /// neighbouring motions converge. None where the second half was not reached.
  std::optional<double> late_exponent_1_s;
  double end_s = 0;
  /// How far the motion itself went from its state at release by `exponential_s`, as seen from the body, of a symmetric one but
  /// for the turn about its axis: the change of gravity's direction and of rate / w0. Next to 0 for an equilibrium and a steady
  /// turn.
  double departure = 0;
  /// When friction had braked an upright symmetric top to its critical spin; 0 of one that was released below it.
  std::optional<double> critical_spin_s;
  bool completed = false;
  StepCounters counters;

  /// When the growth first passed exp(log_growth).
  std::optional<double> passes_s(double log_growth) const;
};

/// The tolerance at which growth is followed that nothing is known of, and the one at which a growth that it shows is
/// confirmed.
inline constexpr double kCoarseGrowthTolerance = 1e-7, kConfirmingGrowthTolerance = 1e-10;
/// The most steps that growth is followed for.
inline constexpr std::int64_t kMostGrowthSteps = 50'000'000;

/// The tolerance at which the growth along a problem's motions is to be followed first; none where nothing has to be followed:
/// where disturbances of the motion grow no faster than with the time, or where an upright top is at its critical spin, so that
/// no growth says more. Motions with a closed form are followed closely, as they leave a separatrix by the integration's own
/// error.
std::optional<double> growth_tolerance(const MotionProblem<double>& problem);

/// Integrates the variational equations of three disturbances that are no symmetry's of a body,
///   dtheta/dt = theta x w + dw ,  Theta ddw/dt = (Theta dw) x w + (Theta w) x dw + m r x ((R^T f) x theta) ,
/// from the release to `duration_s`. A body held by a gimbal is disturbed only as the gimbal lets it move.
/// @param problem  its times are not read
/// @param relative_tolerance  of the integration. The coarse one gives some percent of the growth, but its error can look like
/// growth that is not there, and a motion on a separatrix leaves it by its own error as soon as that has grown: growth that
/// matters is to be confirmed with a finer one.
/// @param watch  may end it early, not completed
GrowthReport disturbance_growth(const MotionProblem<double>& problem, MotionKind kind, double duration_s,
                                double relative_tolerance, const Watch& watch = {});

}  // namespace earthtop
