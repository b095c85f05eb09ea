// SPDX-License-Identifier: GPL-3.0-or-later
#include "drift/long_horizon/long_horizon_work.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "integrate/long_horizon.hpp"

namespace earthtop {
namespace {

/// The drift of a fast top, in rough terms (rad). At first the laboratory turns away below the axis. Later the axis precesses,
/// and only the part of the Earth's rate along the vertical goes on to move it. With the same rates relative to the laboratory
/// at release, the spin follows the Earth's rate along the axis.
double expected_drift_rad(const DriftProblem<double>& problem, const TiltedTop<double>& top, double duration) {
  const Vec3<double> W = problem.model.W_IL_L, n = rotation_matrix(problem.release.q_LB.normalized()).col(2);
  const bool inertial = problem.release.X == RatesRelativeTo::inertial;
  const double before_it_precesses = std::min(duration, 2 / top.precession_rate());
  const double along = std::abs(W[2]) * (inertial ? 1 : real::hypot(n[0], n[1]));
  // An axis that is released along the Earth's comes away from it as it precesses.
  const double precessed = top.precession_rate() * before_it_precesses / 2 * real::hypot(n[0], n[1]);
  const double at_first = inertial ? norm(W) : real::hypot(norm(Vec3<double>(W.cross(n))), norm(W) * std::min(1.0, precessed));
  return at_first * before_it_precesses + along * (duration - before_it_precesses);
}

/// Whether the axis stays near the angular momentum of the release: the nutation that the method averages over is small, as that of a top
/// let go slowly is.
bool nutates_little(const DriftProblem<double>& problem) {
  const Vec3<double> momentum = problem.model.I_BP_B * problem.natural_release().w_XB_B;
  return real::hypot(momentum[0], momentum[1]) < std::abs(momentum[2]);
}

/// The error of one walk at its end, in rough terms (rad).
double expected_error_rad(const TiltedTop<double>& top, double duration, double tolerance, Averaging averaging) {
  constexpr double kDifference = 1e-12, kRoundOff = 2.5e-17;  // rad; rad per rad of nutation, as measured
  if (averaging == Averaging::none) return std::max({tolerance, kDifference, kRoundOff * top.fast_rate() * duration});
  const double left = averaging_error(top, duration, averaging);
  return tolerance + left + std::max(long_horizon::kUnseenError, long_horizon::kUnseenShare * left);
}

}  // namespace

namespace long_horizon {

double largest_node(const TiltedTop<double>& top, double duration, Averaging averaging) {
  constexpr double kDifferenceError = 1e-12;  // of a difference of attitudes (rad)
  const double error = averaging_error(top, duration, averaging);
  return error > 0 ? real::sqrt(kDifferenceError / error) : std::numeric_limits<double>::infinity();
}

}  // namespace long_horizon

LongHorizonDriftWork long_horizon_drift_work(const DriftProblem<double>& problem, const IntegrationOptions& options,
                                             double looks) {
  const Model<double>& model = problem.model;
  LongHorizonDriftWork total;
  if (problem.times_s.size() < 2 || norm(model.W_IL_L_scaled) == 0) return total;
  const double duration = problem.units.time_from_s(problem.times_s.back());
  looks += static_cast<double>(problem.times_s.size() - 1);

  const ReducedTop<double> symmetric = reduced_top(model);
  const NaturalRelease<double> release = problem.natural_release();
  const auto top_at = [&](double epsilon) {
    return TiltedTop<double>(model, symmetric, release, Vec3<double>(epsilon * model.W_IL_L_scaled));
  };
  const bool is_second = options.observer != Observer::laboratory;
  Averaging averaging = Averaging::none;
  const auto add = [&](const TiltedTop<double>& top, double tolerance, int walks) {
    LongHorizonWork work;
    if (options.step_s) {
      const double step = problem.units.time_from_s(*options.step_s);
      work = walking_work(top, make_plan(top, kick_schedules::gauss(4), step, may_average(top, duration, step, tolerance)),
                          duration, looks);
    } else if (options.kick_steps) {
      work = walking_work(top, plan_from(top, *options.kick_steps, problem.units), duration, looks);
    } else {
      work = expected_work(top, duration, tolerance, looks, is_second ? long_horizon::kGoldenPart : 1);
    }
    const bool searches = !options.step_s && !options.kick_steps && !is_second;
    total.work.steps += walks * work.steps + (searches ? work.search_steps : 0);
    total.work.evaluations += walks * work.evaluations + (searches ? work.search_evaluations : 0);
    averaging = work.averaging;
  };
  const TiltedTop<double> top = top_at(model.epsilon);
  add(top, options.relative_tolerance, 1);
  total.averages = averaging != Averaging::none;
  total.drift_rad = expected_drift_rad(problem, top, duration);
  total.error_rad = expected_error_rad(top, duration, options.relative_tolerance, averaging);
  // A drift too small for a plain difference takes walks at four larger rates, unless averaging errs more there.
  double largest_node = std::numeric_limits<double>::infinity();
  if (total.averages) largest_node = long_horizon::largest_node(top, duration, averaging);
  if (largest_node >= 2 && total.drift_rad < long_horizon::kSmall) {
    const double node = std::min(largest_node * model.epsilon, long_horizon::kNodeDrift / duration / norm(model.W_IL_L_scaled));
    const double tolerance = long_horizon::node_tolerance(options.relative_tolerance);
    add(top_at(node), tolerance, 4);
    total.error_rad = expected_error_rad(top_at(node), duration, tolerance, averaging) * model.epsilon / node;
  }
  const double rate = top.frame_rate() + top_at(0).frame_rate() + norm(model.W_IL_L);
  if (!nutates_little(problem)) total.error_rad = std::numeric_limits<double>::infinity();
  total.precession_turns = duration * top.precession_rate() / (2 * real::pi<double>());
  total.looks = duration * rate / long_horizon::look_angle(total.averages);
  return total;
}

}  // namespace earthtop
