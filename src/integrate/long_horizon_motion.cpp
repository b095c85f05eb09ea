// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrate/long_horizon_motion.hpp"

#include <algorithm>
#include <stdexcept>

#include "integrate/drive_problem.hpp"
#include "integrate/long_horizon.hpp"
#include "integrate/spinless_pair.hpp"

namespace earthtop {

MotionTrajectory<double> long_horizon_motion(const MotionProblem<double>& problem, const IntegrationOptions& options,
                                             const Watch& watch) {
  using Top = TiltedTop<double>;
  const ReducedTop<double> symmetric = reduced_top(problem.model);
  if (symmetric.axis != 2) throw std::logic_error("long_horizon: the top is not symmetric about body axis 3");
  const NaturalRelease<double> release = problem.natural_release();
  const std::vector<double> times = natural_times(problem);
  const Top top(problem.model, symmetric, release, problem.model.W_IL_L);
  MotionTrajectory<double> trajectory;
  trajectory.samples.reserve(times.size());
  const double tolerance = options.relative_tolerance;
  LongHorizonPlan<double> plan;
  if (options.step_s) {
    const double step = problem.units.time_from_s(*options.step_s);
    plan = make_plan(top, kick_schedules::gauss(4), step, may_average(top, times.back(), step, tolerance));
  } else if (times.back() > 0) {
    plan = find_plan(top, times.back(), tolerance, trajectory.counters, watch);
  }
  // Each attitude has two quaternions, q and -q. Looking this often keeps the frame's quaternion continuous.
  const double longest_time_between_looks = top.frame_rate() > 0 ? 1.5 / top.frame_rate() : 0;
  Quaternion<double> last = problem.release.q_LB;
  const auto follow = [&](Quaternion<double> q) {
    if (q.w * last.w + q.v.dot(last.v) < 0) q = {-q.w, -q.v};
    last = q;
  };
  LongHorizonPath<double> path(top, plan, times.back(), trajectory.counters, watch);
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (trajectory.counters.accepted > options.step_limit) trajectory.status = RunStatus::step_limit;
    if (trajectory.status != RunStatus::completed) break;
    watch.reach(static_cast<double>(i) / static_cast<double>(times.size()));
    TiltedTopState<double> x = top.start();
    if (i > 0)
      x = path.at(
          times[i], longest_time_between_looks,
          [&](double t, const TiltedTopState<double>& between) { follow(top.seen(between, t).q_LF); }, [] {});
    if (watch.asks_to_stop()) {
      trajectory.status = RunStatus::interrupted;
      break;
    }
    const Top::Seen seen = top.seen(x, times[i]);
    follow(seen.q_LF);
    if (!real::isfinite(seen.across.re + seen.across.im + last.w + last.v.sum())) {
      trajectory.status = RunStatus::not_finite;
      break;
    }
    trajectory.samples.push_back(
        sample_with_spin(problem, i, last, seen.across, release.w_XB_B[2], seen.spin_excess, times[i]));
  }
  return trajectory;
}

}  // namespace earthtop
