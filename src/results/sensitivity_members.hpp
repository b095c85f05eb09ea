// SPDX-License-Identifier: GPL-3.0-or-later
/// The members of summary.json about the inputs: the drift's derivatives by them, and its error from theirs.
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <string>

#include "results/member_entries.hpp"

namespace earthtop::figure_table {

inline bool have_sensitivities(R r) { return r.sensitivities->unavailable.empty(); }
inline Json why_unavailable(R r) { return have_sensitivities(r) ? kLeftOut : Json(r.sensitivities->unavailable); }
inline const InputSensitivity& sensitivity(R r, I i) { return r.sensitivities->inputs[i]; }
/// A derivative by an input; left out where there is none.
template <class Value>
inline Json derivative(R r, I i, Value InputSensitivity::*member) {
  return sensitivity(r, i).unavailable.empty() ? json_from(sensitivity(r, i).*member) : kLeftOut;
}
/// Whether the errors of all inputs have been propagated.
inline bool have_input_errors(R r) { return have_sensitivities(r) && r.sensitivities->without_derivative.empty(); }
inline Json why_no_input_errors(R r) {
  if (have_input_errors(r)) return kLeftOut;
  if (!have_sensitivities(r)) return Json(r.sensitivities->unavailable);
  return Json(fmt::format("there is no derivative with respect to {}", r.sensitivities->without_derivative));
}

/// The name of the input whose error contributes most to the drift's error; null where no input has an error.
inline Json largest_error_from(R r) {
  const auto& inputs = r.sensitivities->inputs;
  const auto most = std::max_element(inputs.begin(), inputs.end(),
                                     [](const auto& a, const auto& b) { return a.axis_error_rad < b.axis_error_rad; });
  return most->axis_error_rad > 0 ? Json(most->name) : Json();
}

inline constexpr auto kSensitivityMembers = [] {
  using enum FigureKind;
  using enum FigureScope;
  return std::array{
      object_or_nothing("sensitivities", [](R r) { return r.sensitivities.has_value(); }),
      compared("sensitivities.at_s", input, end, kAtEnd, [](R r) { return r.sensitivities->at_s; }),
      compared("sensitivities.unavailable", word, end, kAtEnd, [](R r) { return why_unavailable(r); }),
      told("sensitivities.per", kAtEnd, kLabel,
           [](R r) { return have_sensitivities(r) ? Json("one unit of the input, as its name says") : kLeftOut; }),
      list(
          "sensitivities.inputs",
          [](R r) { return have_sensitivities(r) ? std::optional(r.sensitivities->inputs.size()) : std::nullopt; }, true),
      compared("sensitivities.inputs.*.name", word, end, kAtEnd, [](R r, I i) { return sensitivity(r, i).name; }),
      compared("sensitivities.inputs.*.value", derived, end, kAtEnd, [](R r, I i) { return sensitivity(r, i).value; }),
      compared("sensitivities.inputs.*.d_axis_rad", derived, end, kAtEnd,
               [](R r, I i) { return derivative(r, i, &InputSensitivity::axis_rad); }),
      compared("sensitivities.inputs.*.d_axis_bound_rad", error, end, kAtEnd,
               [](R r, I i) { return derivative(r, i, &InputSensitivity::axis_bound_rad); }),
      compared("sensitivities.inputs.*.d_attitude_rad", derived, end, kAtEnd,
               [](R r, I i) { return derivative(r, i, &InputSensitivity::attitude_rad); }),
      compared("sensitivities.inputs.*.d_tilt_rad", derived, end, kAtEnd,
               [](R r, I i) { return derivative(r, i, &InputSensitivity::tilt_rad); }),
      compared("sensitivities.inputs.*.d_azimuth_rad", derived, end, kAtEnd,
               [](R r, I i) { return derivative(r, i, &InputSensitivity::azimuth_rad); }),
      compared("sensitivities.inputs.*.axis_error_rad", derived, end, kAtEnd,
               [](R r, I i) { return derivative(r, i, &InputSensitivity::axis_error_rad); }),
      compared("sensitivities.inputs.*.unavailable", word, end, kAtEnd,
               [](R r, I i) {
                 const std::string& why = sensitivity(r, i).unavailable;
                 return why.empty() ? kLeftOut : Json(why);
               }),
      // The last reliable drift of the axis, with its errors: from the inputs (a standard error, for independent inputs) and
      // from the numerics (a bound).
      object_or_nothing("uncertainty", [](R r) { return r.sensitivities && r.scene.scenario().uncertainty; }),
      compared("uncertainty.unavailable", word, end, kAtEnd, [](R r) { return why_no_input_errors(r); }),
      compared("uncertainty.axis_rad", derived, end, kAtEnd,
               [](R r) { return have_input_errors(r) ? reliable(r, &DriftRow::drift_axis_rad) : kLeftOut; }),
      compared("uncertainty.from_inputs_rad", derived, end, kAtEnd,
               [](R r) { return have_input_errors(r) ? Json(r.sensitivities->axis_error_rad) : kLeftOut; }),
      compared("uncertainty.from_numerics_rad", error, end, kAtEnd,
               [](R r) { return have_input_errors(r) ? reliable(r, &DriftRow::drift_axis_bound_rad) : kLeftOut; }),
      compared("uncertainty.largest_from", word, end, kAtEnd,
               [](R r) { return have_input_errors(r) ? largest_error_from(r) : kLeftOut; }),
  };
}();

}  // namespace earthtop::figure_table
