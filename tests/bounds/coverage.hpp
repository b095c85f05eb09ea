/// A run's bounds held against 113 bits.
#pragma once

#include "earthtop/run.hpp"

namespace earthtop::testing {

struct Coverage {
  Method method = Method::automatic;
  VerdictReport verdict;
  double error = 0, bound = 0;  ///< of the axis drift, largest up to the verdict's time (rad)
  double attitude_error = 0, attitude_bound = 0;
  double used = 0;     ///< largest share of its bound that an error takes, of axis and attitude
  bool tight = false;  ///< the larger of both shares is over 0.01, or the errors are below 1e-13 rad
  double drift = 0;
};

/// The run and the truth: the same scene by extrapolation of the general model in body axes in float128, or, where that would
/// take minutes, by Taylor series in long double.
/// @throws std::runtime_error where either does not complete
Coverage bound_coverage(const Scenario& scenario);

}  // namespace earthtop::testing
