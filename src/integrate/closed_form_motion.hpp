/// One motion on the rotating Earth by its closed form.
#pragma once

#include "closed_form/followed_motion.hpp"
#include "earthtop/closed_form/special_cases.hpp"
#include "integrate/drive_problem.hpp"

namespace earthtop {

/// The inertial rate at release on the Earth, in body axes and natural units.
template <class T>
Vec3<T> inertial_release_rate(const MotionProblem<T>& problem) {
  const Release<T>& release = problem.release;
  Vec3<T> w_IB_B = problem.units.rate_from_rad_s(release.w_XB_B);
  if (release.X == RatesRelativeTo::laboratory)
    w_IB_B += transposed_times(rotation_matrix(release.q_LB), problem.model.W_IL_L);
  return w_IB_B;
}

inline Quaternion<double> in_double(const Quaternion<float128>& q) {
  return {static_cast<double>(q.w), Vec3<double>(static_cast<double>(q.v[0]), static_cast<double>(q.v[1]), static_cast<double>(q.v[2]))};
}

/// @throws std::logic_error for a scene without a closed form
template <class T>
MotionTrajectory<T> closed_form_motion(const MotionProblem<T>& problem, const IntegrationOptions& options,
                                       const std::atomic<bool>* stop) {
  const ExactBody<T> body = exact_body(problem.model);
  const Vec3<T> w0_B = inertial_release_rate(problem);
  const ExactMotion<T> motion(body, problem.release.q_LB, w0_B);
  FollowedMotion followed(body.template as<double>(), converted<double>(problem.release.q_LB), converted<double>(w0_B));

  const std::vector<T> times = natural_times(problem);
  const std::vector<double> seen(times.begin(), times.end());
  MotionTrajectory<T> trajectory;
  trajectory.samples.reserve(times.size());
  trajectory.status =
      visit_times(seen, 1 / followed.turn_rate(), options.step_limit, stop, [&](double t, std::int64_t row) {
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

}  // namespace earthtop
