// SPDX-License-Identifier: GPL-3.0-or-later
/// The definition of fourier_motion, for each scalar.
#pragma once

#include <stdexcept>

#include "integrate/fourier/fourier_motion.hpp"
#include "integrate/fourier/fourier_top.hpp"
#include "integrate/natural_times.hpp"

namespace earthtop {

template <class T>
MotionTrajectory<T> fourier_motion(const MotionProblem<T>& problem, const Watch& watch) {
  if (reduced_top(problem.model).axis != 2) throw std::logic_error("fourier: the top is not symmetric about body axis 3");
  const NaturalRelease<T> release = problem.natural_release();
  const FourierTop<T> top(problem.model, release);
  const std::vector<T> times = natural_times(problem);
  MotionTrajectory<T> trajectory;
  if (!top.refusal().empty()) {
    trajectory.status = RunStatus::not_converged;
    return trajectory;
  }
  trajectory.samples.reserve(times.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (watch.asks_to_stop()) {
      trajectory.status = RunStatus::interrupted;
      break;
    }
    ++trajectory.counters.accepted, ++trajectory.counters.evaluations;
    const SpinlessPair<T> pair = top.at(times[i]);
    const Quaternion<T> e = Quaternion<T>{pair.e_w, Vec3<T>(problem.model.epsilon * pair.y)}.normalized();
    trajectory.samples.push_back(sample_with_spin(problem, i, Quaternion<T>(pair.ref_q_LF * e), pair.across, release.w_XB_B[2],
                                                  pair.spin_excess, times[i]));
  }
  return trajectory;
}

}  // namespace earthtop
