// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrate/closed_form_motion.hpp"

#include "closed_form/followed_motion.hpp"
#include "closed_form/wider.hpp"
#include "earthtop/closed_form/special_cases.hpp"
#include "integrate/natural_times.hpp"

namespace earthtop {

template <class T>
MotionTrajectory<T> closed_form_motion(const MotionProblem<T>& problem, const IntegrationOptions& options, const Watch& watch) {
  const ExactBody<T> body = exact_body(problem.model);
  const Vec3<T> w0_B = problem.natural_release().inertial_rate_B(problem.model.W_IL_L);
  const ExactMotion<T> motion(body, problem.release.q_LB, w0_B);
  FollowedMotion followed(body.template as<double>(), converted<double>(problem.release.q_LB), converted<double>(w0_B));

  const std::vector<T> times = natural_times(problem);
  const std::vector<double> seen(times.begin(), times.end());
  MotionTrajectory<T> trajectory;
  trajectory.samples.reserve(times.size());
  trajectory.status = visit_times(seen, 1 / followed.turn_rate(), options.step_limit, watch, [&](double t, std::int64_t row) {
    followed.advance(t);
    ++trajectory.counters.accepted;
    ++trajectory.counters.evaluations;
    if (row < 0) return;
    const auto i = static_cast<std::size_t>(row);
    ClosedFormState<T> state = motion.at(times[i]);
    state.q_NB = with_sign_of(followed.attitude(), state.q_NB);
    const LaboratoryState<T> seen_L = seen_from_laboratory(state, problem.model.W_IL_L, times[i]);
    MotionSample<T> sample{T(problem.times_s[i]), seen_L.q_LB, seen_L.w_LB_B};
    for (int j = 0; j < 3; ++j) sample.w_LB_B[j] = problem.units.rate_to_rad_s(sample.w_LB_B[j]);
    trajectory.samples.push_back(sample);
  });
  return trajectory;
}

template MotionTrajectory<double> closed_form_motion(const MotionProblem<double>&, const IntegrationOptions&, const Watch&);
template MotionTrajectory<float80> closed_form_motion(const MotionProblem<float80>&, const IntegrationOptions&, const Watch&);
template MotionTrajectory<float128> closed_form_motion(const MotionProblem<float128>&, const IntegrationOptions&, const Watch&);

}  // namespace earthtop
