// SPDX-License-Identifier: GPL-3.0-or-later
/// The table of integration methods, one row each. All code that names, offers, refuses, times or draws a method reads this
/// table. Apart from its row, a method consists only of its stepper (src/integrate/odeint_driver.hpp) or its own integrator.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <string_view>

namespace earthtop {

/// The method of integration. `automatic` is replaced by one of the others, chosen for the scene; the rows describe the others.
enum class Method {
  automatic,
  dopri5,
  rkf78,
  bulirsch_stoer,
  extrapolation,
  abm8,
  taylor,
  dop853,
  gauss,
  splitting,
  long_horizon,
  closed_form,
  fourier
};
inline constexpr std::size_t kMethodCount = static_cast<std::size_t>(Method::fourier) + 1;

/// The scalar type of a run, by the bits of its mantissa: double, long double or float128.
enum class Precision { bits53, bits64, bits113 };

/// Whether a key must, may or must not appear together with another.
enum class Need { required, optional, none };

/// The class of scenes that a method can integrate; scene/method_fit.cpp defines each class and refuses other scenes.
enum class MethodFit { any, smooth, symmetric_top, fast_symmetric_top, closed_form, nutating_top };

/// The equations that `bench` uses to compare a method: the method's own variables, or these forms of the equations of motion.
enum class MethodEquations { own, reduced, body, reduced_and_body, reduced_body_and_laboratory };

/// The work of a method's steps, as measured on a fast top (pace.hpp). One step advances the phase of the fastest motion by
/// `radians` (tolerance / at)^`order_inverse` (rad) and takes
/// (`evaluations` + `evaluations_per_log` ln tolerance) (tolerance / 1e-12)^`evaluations_power` right-hand sides, including
/// those of rejected steps.
struct MethodCost {
  double radians = 0.04, at = 1e-12, order_inverse = 0;
  double most_radians = std::numeric_limits<double>::infinity();
  double evaluations = 13, evaluations_per_log = 0, evaluations_power = 0;
  /// Steps that only stability limits, as measured on an overdamped pendulum: damping rate times step length (1), and
  /// right-hand sides per step.
  double stable_phase = 1, stable_evaluations = 13;
  /// Near the round-off of 113 bits: the powers of (tolerance / 1e-30) by which steps get shorter and cheaper.
  double near_round_off = 0, evaluations_near_round_off = 0;
  /// Right-hand sides of an output row: those of a step aside, or 1 where it comes from dense output or the series.
  double evaluations_a_row = 13;
  bool is_watched = false;      ///< steps are so long that they must be cut to count full turns
  bool tries_its_step = false;  ///< the fixed step is found by trial at the start and is kept
};

struct MethodRow {
  Method method;
  std::string_view word;
  Precision most_digits = Precision::bits53;  ///< highest precision the method is built for
  Need step_s = Need::none, relative_tolerance = Need::optional;
  MethodFit fit = MethodFit::any;
  bool finds_stops = false;  ///< finds the time within a step when dry friction stops the motion
  bool composes = false;     ///< lets the user choose the composition of exact flows
  MethodEquations equations = MethodEquations::reduced_and_body;
  std::array<double, 6> bench_tolerances = {1e-5, 1e-8, 1e-11, 1e-14};  ///< tolerances in double; a 0 ends the list
  int place_in_menus = 0, place_in_bench = 0;                           ///< order in menus and in `bench`
  std::string_view look = "";                                           ///< colour and marker in plots
  MethodCost cost = {};
  std::string_view worth = "";  ///< what a user would lose without the method
};

inline constexpr std::array<MethodRow, kMethodCount> kMethodRows = {{
    {.method = Method::automatic,
     .word = "auto",
     .most_digits = Precision::bits113,
     .finds_stops = true,
     .place_in_menus = 0,
     .place_in_bench = 0,
     .cost = {.stable_phase = 3},
     .worth = "the choice of the method that takes the least work"},
    {.method = Method::dopri5,
     .word = "dopri5",
     .bench_tolerances = {1e-5, 1e-8, 1e-10},
     .place_in_menus = 2,
     .place_in_bench = 11,
     .look = "orange diamond",
     .cost = {.radians = 0.25,
              .at = 1e-8,
              .order_inverse = 1.0 / 5,
              .evaluations = 6,
              .stable_phase = 2.5,
              .stable_evaluations = 8},
     .worth =
         "the default method of MATLAB's ode45 and SciPy's RK45: their results can be reproduced, and their cost compared"},
    {.method = Method::rkf78,
     .word = "rkf78",
     .most_digits = Precision::bits113,
     .finds_stops = true,
     .equations = MethodEquations::reduced_body_and_laboratory,
     .place_in_menus = 3,
     .place_in_bench = 7,
     .look = "orange square",
     .cost = {.radians = 0.22, .at = 1e-14, .order_inverse = 1.0 / 8, .stable_phase = 3},
     .worth = "short steps, which find where dry friction stops a motion, and the second method, from which the bounds of "
              "extrapolation come"},
    {.method = Method::bulirsch_stoer,
     .word = "bulirsch_stoer",
     .most_digits = Precision::bits64,
     .place_in_menus = 4,
     .place_in_bench = 10,
     .look = "purple triangle",
     .cost = {.radians = 2, .order_inverse = 1.0 / 16, .evaluations = 53, .stable_phase = 3, .stable_evaluations = 15},
     .worth = "Boost.Odeint's own extrapolation: an independent implementation of the same idea, against which extrapolation "
              "can be checked"},
    {.method = Method::extrapolation,
     .word = "extrapolation",
     .most_digits = Precision::bits113,
     .finds_stops = true,
     .place_in_menus = 5,
     .place_in_bench = 9,
     .look = "vermillion triangle",
     .cost = {.radians = 4,
              .order_inverse = 1.0 / 35,
              .evaluations = 80,
              .evaluations_power = -1.0 / 35,
              .stable_phase = 2,
              .stable_evaluations = 8,
              .near_round_off = 0.45,
              .evaluations_near_round_off = 0.2,
              .evaluations_a_row = 40,
              .is_watched = true},
     .worth = "an order that follows the tolerance: 34 digits in any scenario, and the second integration behind the bounds of "
              "most other methods"},
    {.method = Method::abm8,
     .word = "abm8",
     .step_s = Need::required,
     .relative_tolerance = Need::none,
     .equations = MethodEquations::body,
     .place_in_menus = 6,
     .place_in_bench = 12,
     .look = "sky diamond",
     .cost = {.evaluations = 2},
     .worth = "the only multistep method: two evaluations of the right-hand side a step, as in older fixed-step simulators"},
    {.method = Method::dop853,
     .word = "dop853",
     .equations = MethodEquations::reduced_body_and_laboratory,
     .place_in_menus = 7,
     .place_in_bench = 6,
     .look = "sky square",
     .cost = {.radians = 0.35,
              .order_inverse = 1.0 / 8,
              .evaluations = 12,
              .stable_phase = 3.5,
              .evaluations_a_row = 1,
              .is_watched = true},
     .worth = "dense output of order 7 where drag brakes a rate to zero, a corner that no series passes: output rows do not "
              "shorten its steps"},
    {.method = Method::gauss,
     .word = "gauss",
     .step_s = Need::optional,
     .place_in_menus = 8,
     .place_in_bench = 8,
     .look = "green triangle",
     .cost = {.radians = 1.0,
              .order_inverse = 1.0 / 13,
              .most_radians = 2,
              .evaluations = 120,
              .stable_phase = 1.2,  // its fixed-point iteration does not converge beyond this
              .stable_evaluations = 50,
              .tries_its_step = true},
     .worth = "the only symmetric method for scenarios without exact flows: with a fixed step, its error in the energy does "
              "not grow with time"},
    {.method = Method::splitting,
     .word = "splitting",
     .step_s = Need::optional,
     .fit = MethodFit::symmetric_top,
     .composes = true,
     .equations = MethodEquations::reduced,
     .place_in_menus = 9,
     .place_in_bench = 5,
     .look = "purple circle",
     .cost = {.radians = 0.8, .order_inverse = 1.0 / 7, .most_radians = 2, .evaluations = 14},
     .worth = "the symplectic method for symmetric tops: with a fixed step, its error in the Jacobi integral does not grow "
              "with time; published compositions can be compared"},
    {.method = Method::taylor,
     .word = "taylor",
     .most_digits = Precision::bits113,
     .fit = MethodFit::smooth,
     .bench_tolerances = {1e-2, 1e-3, 1e-5, 1e-8, 1e-11, 1e-14},
     .place_in_menus = 1,
     .place_in_bench = 4,
     .look = "blue circle",
     .cost = {.radians = 1.8, .evaluations = 8, .evaluations_per_log = -0.7, .stable_phase = 10, .evaluations_a_row = 1},
     .worth = "the fewest operations at every error, down to rounding"},
    {.method = Method::closed_form,
     .word = "closed_form",
     .most_digits = Precision::bits113,
     .relative_tolerance = Need::none,
     .fit = MethodFit::closed_form,
     .equations = MethodEquations::own,
     .place_in_menus = 11,
     .place_in_bench = 1,
     .look = "green circle",
     .worth = "the motion at any time, at the cost of its rows alone, with an error that does not grow"},
    {.method = Method::long_horizon,
     .word = "long_horizon",
     .fit = MethodFit::fast_symmetric_top,
     .equations = MethodEquations::own,
     .bench_tolerances = {1e-6, 1e-8, 1e-10, 1e-12},
     .place_in_menus = 10,
     .place_in_bench = 3,
     .look = "vermillion circle",
     .worth = "days of a fast top in seconds: its steps follow the precession, not the nutation"},
    {.method = Method::fourier,
     .word = "fourier",
     .most_digits = Precision::bits113,
     .relative_tolerance = Need::none,
     .fit = MethodFit::nutating_top,
     .equations = MethodEquations::own,
     .place_in_menus = 12,
     .place_in_bench = 2,
     .look = "sky circle",
     .worth = "any day of a heavy symmetric top for the cost of its rows: both motions as Fourier sums of two phases"},
}};

/// Returns the table row of a method.
constexpr const MethodRow& row_of(Method method) {
  return *std::find_if(kMethodRows.begin(), kMethodRows.end(), [&](const MethodRow& row) { return row.method == method; });
}

constexpr std::string_view to_string(Method method) { return row_of(method).word; }
std::string_view to_string(Precision precision);

/// Returns whether a method is built for a precision.
constexpr bool is_built(Method method, Precision precision) { return precision <= row_of(method).most_digits; }

/// Returns whether a method is exact, as a closed form is; any other method has a step error, set by a tolerance or a step.
constexpr bool is_exact(Method method) {
  return row_of(method).step_s == Need::none && row_of(method).relative_tolerance == Need::none;
}

/// Returns whether a step ends at each output row, so that rows change the rounding of the motion: only fixed steps do, but for those
/// of long_horizon, which takes a step aside to a row.
constexpr bool ends_steps_at_rows(Method method) {
  return row_of(method).step_s != Need::none && method != Method::long_horizon;
}

/// Returns all methods in the order given by `place_in_menus` or `place_in_bench`. @param place  one of these two members
constexpr std::array<Method, kMethodCount> methods_by(int MethodRow::*place) {
  std::array<Method, kMethodCount> methods = {};
  for (const MethodRow& row : kMethodRows) methods[static_cast<std::size_t>(row.*place)] = row.method;
  return methods;
}

namespace method_detail {
constexpr std::size_t words_size() {
  std::size_t size = kMethodCount - 1;
  for (const MethodRow& row : kMethodRows) size += row.word.size();
  return size;
}
inline constexpr std::array<char, words_size()> kWords = [] {
  std::array<char, words_size()> text = {};
  std::size_t at = 0;
  for (const Method method : methods_by(&MethodRow::place_in_menus)) {
    if (at > 0) text[at++] = '|';
    for (const char c : to_string(method)) text[at++] = c;
  }
  return text;
}();
}  // namespace method_detail

/// The words of all methods in the order of menus, separated by '|'.
inline constexpr std::string_view kMethodWords(method_detail::kWords.data(), method_detail::kWords.size());

}  // namespace earthtop
