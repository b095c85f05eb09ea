// SPDX-License-Identifier: GPL-3.0-or-later
/// How to integrate: the observer, the method and its tolerances.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "earthtop/integrate/method.hpp"

namespace earthtop {

/// The observer in whose axes the equations are integrated: in the rotating laboratory (with [F]'s non-inertial torques), in
/// the body (Euler's equations), or in inertial space.
enum class Observer { laboratory, body, inertial };

/// The variables that are integrated: `general` means attitude and rates, for any body; `reduced` means the axis and the
/// transverse rate of a symmetric top, without its spin. `automatic` is decided by `takes_reduced_form`.
enum class ModelForm { automatic, general, reduced };

/// The composition of exact flows that `splitting` uses; src/integrate/compositions.hpp explains the names. `automatic` is
/// rkn6, which needs the least work for every error below 1e-6 rad on the shipped tops.
enum class Composition { automatic, aba82, aba84, aba864, aba1064, rkn6, kahan_li8 };

std::string_view to_string(Observer observer);
std::string_view to_string(ModelForm form);
std::string_view to_string(Composition composition);

/// The smallest sensible relative tolerance: about 45 times the precision's epsilon, which is the rounding of the sums in one
/// step. No step control can meet a smaller one.
double least_tolerance(Precision precision);
/// The relative tolerance where none is given: 1e-12 in double, 1e-16 in long double, 1e-28 in float128. It falls with the
/// precision, as whoever asks for more bits wants the digits that they allow.
double default_tolerance(Precision precision);

/// Why this library integrates nothing in a precision, and what to do; empty where it does: it can be built for double alone.
std::optional<std::string> precision_refusal(Precision precision);

/// Whether steps of long_horizon average over the nutation: not, with kicks spread over 5 times, or over 17.
enum class Averaging { none, coarse, fine };

/// The steps of the method long_horizon, as one run has found them, for another run to reuse.
struct KickSteps {
  double step_s = 0;  ///< longest step (s)
  int kicks = 0;      ///< number of kicks in a step, at Gauss nodes; 0: the kicks of the composition ABA(8, 6, 4)
  Averaging averaging = Averaging::none;
  bool operator==(const KickSteps&) const = default;
};

/// How a problem is to be integrated.
struct IntegrationOptions {
  Observer observer = Observer::laboratory;
  ModelForm form = ModelForm::automatic;
  Method method = Method::automatic;
  double relative_tolerance = 1e-12;  ///< local error per step, relative to the size of each component group
  std::optional<double> step_s;       ///< longest step of a fixed-step method (s); the one taken divides each row's interval
  Composition composition = Composition::automatic;  ///< for the method `splitting`
  std::int64_t step_limit = 2'000'000'000;           ///< largest number of steps
  bool stops_beyond_estimate = true;    ///< whether to stop at ten times the work estimated, where the pace is known
  std::optional<KickSteps> kick_steps;  ///< for long_horizon: the steps to take, instead of searching for them
  bool operator==(const IntegrationOptions&) const = default;
};

/// Whether an integration with these options takes the reduced form of a model that has one. Exact flows are composed in no
/// other, and in inertial axes too.
inline bool takes_reduced_form(bool reducible, const IntegrationOptions& options) {
  if (is_exact(options.method)) return false;
  if (options.form != ModelForm::automatic) return options.form == ModelForm::reduced;
  const bool splits = row_of(options.method).composes && options.observer == Observer::inertial;
  return (options.observer == Observer::laboratory || splits) && reducible;
}

/// The work that an integration did.
struct StepCounters {
  std::int64_t accepted = 0;
  std::int64_t rejected = 0;
  std::int64_t evaluations = 0;  ///< evaluations of the right-hand side; for a Taylor series: orders computed
};

}  // namespace earthtop
