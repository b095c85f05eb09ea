// SPDX-License-Identifier: GPL-3.0-or-later
/// How to integrate: the observer, the method and its tolerances.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "earthtop/integrate/method.hpp"

namespace earthtop {

/// In whose axes the state lives: the rotating laboratory ([F]'s torques), the body (Euler), or inertial space.
enum class Observer { laboratory, body, inertial };

/// In which variables: `general` is every body's attitude and rates, `reduced` a symmetric top's axis and angular momentum,
/// without the spin; automatic is reduced where the observer is the laboratory and the model allows it.
enum class ModelForm { automatic, general, reduced };

/// Which composition of exact flows `splitting` takes, by the names of src/integrate/compositions.hpp; automatic is rkn6, which
/// takes the least work at every error below 1e-6 rad on the shipped tops.
enum class Composition { automatic, aba82, aba84, aba864, aba1064, rkn6, kahan_li8 };

std::string_view to_string(Observer observer);
std::string_view to_string(ModelForm form);
std::string_view to_string(Composition composition);

/// The least relative tolerance: some 45 eps, the rounding of one step's sums. Less no controlled step can meet.
double least_tolerance(Precision precision);
/// The tolerance of those who name none: 1e-12 in double, 1e-16 in long double, 1e-28 in float128; who asks for more bits
/// wants their digits.
double default_tolerance(Precision precision);

/// The steps of long_horizon, as one run found them and another may take them over.
struct KickSteps {
  double step_s = 0;      ///< the longest
  int kicks = 0;          ///< in a step, at Gauss's nodes; 0: those of ABA(8, 6, 4)
  bool averages = false;  ///< over the nutation
};

struct IntegrationOptions {
  Observer observer = Observer::laboratory;
  ModelForm form = ModelForm::automatic;
  Method method = Method::automatic;
  double relative_tolerance = 1e-12;                 ///< local error per step, against the size of each component group
  std::optional<double> step_s;                      ///< fixed-step methods; the step taken divides the output step
  Composition composition = Composition::automatic;  ///< of `splitting`
  std::int64_t step_limit = 2'000'000'000;
  bool stops_beyond_estimate = true;    ///< at ten times the work estimated, where the problem's pace is known
  std::optional<KickSteps> kick_steps;  ///< long_horizon looks for none of its own then
};

/// Whether an integration with these options takes the reduced form of a model that has one. Exact flows are composed in no
/// other, and in inertial axes too.
inline bool takes_reduced_form(bool reducible, const IntegrationOptions& options) {
  if (is_exact(options.method)) return false;
  if (options.form != ModelForm::automatic) return options.form == ModelForm::reduced;
  const bool splits = row_of(options.method).composes && options.observer == Observer::inertial;
  return (options.observer == Observer::laboratory || splits) && reducible;
}

/// What an integration cost.
struct StepCounters {
  std::int64_t accepted = 0;
  std::int64_t rejected = 0;
  std::int64_t evaluations = 0;  ///< of the right-hand side; of a Taylor series, its orders
};

}  // namespace earthtop
