// SPDX-License-Identifier: GPL-3.0-or-later
/// The integration methods: one row each, which everything reads that names, offers, refuses, times or draws a method. Beside
/// its row a method has its stepper (src/integrate/odeint_driver.hpp, or an integration of its own) and nothing else.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <string_view>

namespace earthtop {

/// automatic stands for one of the others, which the scene decides; what the others are, their rows say.
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
  closed_form
};
inline constexpr std::size_t kMethodCount = static_cast<std::size_t>(Method::closed_form) + 1;

/// The scalar of a run: double, long double or float128.
enum class Precision { bits53, bits64, bits113 };

/// Whether a key must stand beside another, may, or may not.
enum class Need { required, optional, none };

/// The scenes that a method is made for (scene/method_fit.cpp says what each means, and refuses the others).
enum class MethodFit { any, plain, symmetric_top, fast_symmetric_top, closed_form };

/// The equations in which `bench` lets a method compete: its own variables, or these forms of the equations of motion.
enum class MethodEquations { own, reduced, body, reduced_and_body, reduced_body_and_laboratory };

/// How much work a method's steps are, as measured on a fast top (pace.hpp): a step covers
/// `radians` (tolerance / at)^`order_inverse` of the fastest motion's phase, and takes
/// (`evaluations` + `evaluations_per_log` ln tolerance) (tolerance / 1e-12)^`evaluations_power` right-hand sides, rejected
/// steps' included.
struct MethodCost {
  double radians = 0.04, at = 1e-12, order_inverse = 0;
  double most_radians = std::numeric_limits<double>::infinity();
  double evaluations = 13, evaluations_per_log = 0, evaluations_power = 0;
  /// Where nothing but stability bounds a step, as measured on an overdamped pendulum: the damping's rate times its length, and
  /// its right-hand sides.
  double stable_phase = 1, stable_evaluations = 13;
  /// Near the round-off of 113 bits steps are shorter by this power of the tolerance over 1e-30, and cheaper by that.
  double near_round_off = 0, evaluations_near_round_off = 0;
  double evaluations_a_row = 13;  ///< of a step that ends at a row
  bool steps_past_rows = false;   ///< the rows come from dense output or the series; with any other method steps end at them
  bool is_watched = false;        ///< its steps are so long that the watcher of angles that go round must cut them
  bool tries_its_step = false;    ///< its fixed step is found at the start, and stays as short as that needs
};

struct MethodRow {
  Method method;
  std::string_view word;
  Precision most_digits = Precision::bits53;  ///< built up to this precision
  Need step_s = Need::none, relative_tolerance = Need::optional;
  MethodFit fit = MethodFit::any;
  bool finds_stops = false;  ///< finds where dry friction brings a motion to rest within a step
  bool composes = false;     ///< takes a composition of exact flows
  MethodEquations equations = MethodEquations::reduced_and_body;
  std::array<double, 6> bench_tolerances = {1e-5, 1e-8, 1e-11, 1e-14};  ///< in double; 0 ends them
  int place_in_menus = 0, place_in_bench = 0;                           ///< where the word stands among all words
  std::string_view look = "";                                           ///< colour and marker in pictures
  MethodCost cost = {};
  std::string_view worth = "";  ///< what a user would lose without it
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
     .place_in_bench = 10,
     .look = "orange diamond",
     .cost = {.radians = 0.25,
              .at = 1e-8,
              .order_inverse = 1.0 / 5,
              .evaluations = 6,
              .stable_phase = 2.5,
              .stable_evaluations = 8},
     .worth = "the method that MATLAB's ode45 and SciPy's RK45 take by default: their results can be made again, and its cost "
              "compared"},
    {.method = Method::rkf78,
     .word = "rkf78",
     .most_digits = Precision::bits113,
     .finds_stops = true,
     .equations = MethodEquations::reduced_body_and_laboratory,
     .place_in_menus = 3,
     .place_in_bench = 6,
     .look = "orange square",
     .cost = {.radians = 0.22, .at = 1e-14, .order_inverse = 1.0 / 8, .stable_phase = 3},
     .worth = "short steps, which find where dry friction stops a motion, and the second method against which extrapolation's "
              "bounds are found"},
    {.method = Method::bulirsch_stoer,
     .word = "bulirsch_stoer",
     .most_digits = Precision::bits64,
     .place_in_menus = 4,
     .place_in_bench = 9,
     .look = "purple triangle",
     .cost = {.radians = 2, .order_inverse = 1.0 / 16, .evaluations = 53, .stable_phase = 3, .stable_evaluations = 15},
     .worth = "Boost.Odeint's own extrapolation: another program's code of the same idea as extrapolation, to hold it against"},
    {.method = Method::extrapolation,
     .word = "extrapolation",
     .most_digits = Precision::bits113,
     .finds_stops = true,
     .place_in_menus = 5,
     .place_in_bench = 8,
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
     .worth =
         "an order that follows the tolerance: 34 digits in any scene, and the second integration that every bound rests on"},
    {.method = Method::abm8,
     .word = "abm8",
     .step_s = Need::required,
     .relative_tolerance = Need::none,
     .equations = MethodEquations::body,
     .place_in_menus = 6,
     .place_in_bench = 11,
     .look = "sky diamond",
     .cost = {.evaluations = 2},
     .worth = "the only multistep method: two right-hand sides a step, as older simulators with fixed steps take them"},
    {.method = Method::dop853,
     .word = "dop853",
     .equations = MethodEquations::reduced_body_and_laboratory,
     .place_in_menus = 7,
     .place_in_bench = 5,
     .look = "sky square",
     .cost = {.radians = 0.35,
              .order_inverse = 1.0 / 8,
              .evaluations = 12,
              .stable_phase = 3.5,
              .evaluations_a_row = 1,
              .steps_past_rows = true,
              .is_watched = true},
     .worth = "dense output of order 7 for every scene that no series is compiled for: rows cut no step"},
    {.method = Method::gauss,
     .word = "gauss",
     .step_s = Need::optional,
     .place_in_menus = 8,
     .place_in_bench = 7,
     .look = "green triangle",
     .cost = {.radians = 1.0,
              .order_inverse = 1.0 / 13,
              .most_radians = 2,
              .evaluations = 120,
              .stable_phase = 1.2,  // beyond which its fixed-point iteration does not converge
              .stable_evaluations = 50,
              .tries_its_step = true},
     .worth = "the only symmetric method for scenes that no exact flow is made for: with a fixed step its error in the energy "
              "does not grow with the time"},
    {.method = Method::splitting,
     .word = "splitting",
     .step_s = Need::optional,
     .fit = MethodFit::symmetric_top,
     .composes = true,
     .equations = MethodEquations::reduced,
     .place_in_menus = 9,
     .place_in_bench = 4,
     .look = "purple circle",
     .cost = {.radians = 0.8, .order_inverse = 1.0 / 7, .most_radians = 2, .evaluations = 14},
     .worth =
         "the symplectic method of a symmetric top: with a fixed step its error in the Jacobi integral does not grow with the "
         "time; published compositions can be compared"},
    {.method = Method::taylor,
     .word = "taylor",
     .most_digits = Precision::bits113,
     .fit = MethodFit::plain,
     .bench_tolerances = {1e-2, 1e-3, 1e-5, 1e-8, 1e-11, 1e-14},
     .place_in_menus = 1,
     .place_in_bench = 3,
     .look = "blue circle",
     .cost = {.radians = 1.8, .evaluations = 8, .evaluations_per_log = -0.7, .evaluations_a_row = 1, .steps_past_rows = true},
     .worth = "the fewest operations at every error, and rounding alone for an error"},
    {.method = Method::closed_form,
     .word = "closed_form",
     .most_digits = Precision::bits113,
     .relative_tolerance = Need::none,
     .fit = MethodFit::closed_form,
     .equations = MethodEquations::own,
     .place_in_menus = 11,
     .place_in_bench = 1,
     .look = "green circle",
     .worth = "the motion at any time for the price of its rows, without an error that grows"},
    {.method = Method::long_horizon,
     .word = "long_horizon",
     .fit = MethodFit::fast_symmetric_top,
     .equations = MethodEquations::own,
     .bench_tolerances = {1e-6, 1e-8, 1e-10, 1e-12},
     .place_in_menus = 10,
     .place_in_bench = 2,
     .look = "vermillion circle",
     .worth = "days of a fast top in seconds: its steps follow the precession, not the nutation"},
}};

/// The row of a method.
constexpr const MethodRow& row_of(Method method) {
  return *std::find_if(kMethodRows.begin(), kMethodRows.end(), [&](const MethodRow& row) { return row.method == method; });
}

constexpr std::string_view to_string(Method method) { return row_of(method).word; }
std::string_view to_string(Precision precision);

/// Whether a method is built for a precision.
constexpr bool is_built(Method method, Precision precision) { return precision <= row_of(method).most_digits; }

/// Whether the error of a method is asked for by a tolerance; with a closed form there is none to ask for.
constexpr bool is_exact(Method method) {
  return row_of(method).step_s == Need::none && row_of(method).relative_tolerance == Need::none;
}

/// All methods, in the order of a place: `place_in_menus` or `place_in_bench`.
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

/// All words in the order of menus, with bars between them.
inline constexpr std::string_view kMethodWords(method_detail::kWords.data(), method_detail::kWords.size());

}  // namespace earthtop
