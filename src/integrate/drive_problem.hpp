/// From a problem and the options asked for to what the driver takes: natural units, first and fixed steps.
#pragma once

#include <vector>

#include "earthtop/integrate/motion_integration.hpp"
#include "integrate/inline_all.hpp"
#include "integrate/odeint_driver.hpp"

namespace earthtop {

template <class T>
std::vector<T> natural_times(const MotionProblem<T>& problem) {
  std::vector<T> times;
  times.reserve(problem.times_s.size());
  for (const double t : problem.times_s) times.push_back(problem.units.time_from_s(T(t)));
  return times;
}

template <class T>
DriveOptions<T> drive_options(const MotionProblem<T>& problem, const IntegrationOptions& options,
                              const std::atomic<bool>* stop) {
  DriveOptions<T> drive;
  drive.method = options.method;
  drive.relative_tolerance = T(options.relative_tolerance);
  drive.first_step = T(0.02) / problem.fastest_rate;
  drive.fixed_step = options.step_s ? problem.units.time_from_s(T(*options.step_s)) : T(0.04) / problem.fastest_rate;
  drive.step_limit = options.step_limit;
  drive.stop = stop;
  return drive;
}

}  // namespace earthtop
