/// How to integrate: the observer, the method and its tolerances.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace earthtop {

/// In whose axes the state lives: the rotating laboratory ([F]'s torques), the body (Euler), or inertial space.
enum class Observer { laboratory, body, inertial };

/// automatic picks one of the others; dopri5, rkf78, bulirsch_stoer (odeint's) and extrapolation control their step,
/// abm8 has a fixed one. rkf78 and extrapolation exist in every precision, bulirsch_stoer in double and long double, the others
/// in double.
enum class Method { automatic, dopri5, rkf78, bulirsch_stoer, extrapolation, abm8 };

/// In which variables: `general` is every body's attitude and rates, `reduced` a symmetric top's axis and angular momentum,
/// without the spin; automatic is reduced where the observer is the laboratory and the model allows it.
enum class ModelForm { automatic, general, reduced };

std::string_view to_string(Observer observer);
std::string_view to_string(Method method);
std::string_view to_string(ModelForm form);

struct IntegrationOptions {
  Observer observer = Observer::laboratory;
  ModelForm form = ModelForm::automatic;
  Method method = Method::automatic;
  double relative_tolerance = 1e-12;  ///< local error per step, against the size of each component group
  std::optional<double> step_s;       ///< fixed-step methods; the step taken divides the output step
  std::int64_t step_limit = 2'000'000'000;
};

/// What an integration cost.
struct StepCounters {
  std::int64_t accepted = 0;
  std::int64_t rejected = 0;
  std::int64_t evaluations = 0;  ///< of the right-hand side
};

}  // namespace earthtop
