// SPDX-License-Identifier: GPL-3.0-or-later
#include "measurement_text.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "earthtop/error.hpp"
#include "earthtop/measure/measurement.hpp"

namespace earthtop::tool {
namespace {

std::string strong(std::string_view text, std::string_view code, bool color) {
  return color ? fmt::format("\x1b[{}m{}\x1b[0m", code, text) : std::string(text);
}

std::string chi_squared_text(const ChiSquared& chi_squared) {
  std::string text =
      fmt::format("chi-squared {:.6g} of {} degrees of freedom", chi_squared.value, chi_squared.degrees_of_freedom);
  if (chi_squared.p_value)
    text += *chi_squared.p_value >= 1e-4 || *chi_squared.p_value == 0 ? fmt::format(", chance {:.4g}", *chi_squared.p_value)
                                                                      : fmt::format(", chance {:.1e}", *chi_squared.p_value);
  return text;
}

std::string quantities_text(const MeasurementReport& report) {
  std::string text;
  for (const auto& [quantity, values] : report.quantities)
    text += fmt::format("{}{} of {}", text.empty() ? "" : ", ", values, to_string(quantity));
  return text;
}

std::string agreement_text(const MeasurementReport& report, bool color) {
  if (report.agrees()) return strong("yes", "32", color);
  std::string reason = fmt::format("the chance is below {:g}", MeasurementReport::kLeastPValue);
  if (report.status != RunStatus::completed)
    reason = "the prediction does not reach the last row";
  else if (report.fit != FitOutcome::not_asked && !report.fitted)
    reason = "there is no fit";
  return fmt::format("{}: {}", strong("no", "31", color), reason);
}

std::string estimates_text(const MeasurementReport& report, bool color) {
  std::string text = "\nEstimates\n";
  for (std::size_t j = 0; j < report.estimates.size(); ++j) {
    const ParameterEstimate& e = report.estimates[j];
    const std::string value = with_standard_error(*e.estimate, *e.standard_error);
    text += fmt::format("  {}  {}{}{}\n      {}\n", printable(e.name), strong(value, "1", color), e.unit.empty() ? "" : " ",
                        e.unit, printable(estimate_sentence(e, report.scatters_more())));
    for (const Prior& prior : report.priors)
      if (prior.input == e.name)
        text += fmt::format("      known beforehand as {} {}; the estimate is {:+.2f} of these errors off\n",
                            with_standard_error(prior.mean, prior.standard_error), prior.unit, prior.pull.value_or(0));
    for (std::size_t k = 0; k < j; ++k)
      text +=
          fmt::format("      correlation with {}  {:+.4f}\n", printable(report.estimates[k].name), report.correlation[j][k]);
  }
  return text;
}

/// The ten residuals that are largest in units of their standard errors, in the order of time.
std::string residuals_text(const MeasurementReport& report) {
  constexpr std::size_t kShown = 10;
  std::vector<std::size_t> order(report.residuals.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto size = [&](std::size_t i) { return std::abs(report.residuals[i].normalised()); };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return size(a) > size(b); });
  order.resize(std::min(order.size(), kShown));
  std::sort(order.begin(), order.end());
  std::string text = fmt::format("\nResiduals{}, measured less predicted{}\n  {:>14}  {:<14} {:>13} {:>13} {:>12}\n",
                                 report.fitted ? " after the fit" : "",
                                 report.residuals.size() > kShown ? fmt::format(": the {} largest", kShown) : "", "t_s",
                                 "quantity", "residual_rad", "st_error_rad", "st. errors");
  for (const std::size_t i : order) {
    const MeasurementResidual& r = report.residuals[i];
    text += fmt::format("  {:>14.8g}  {:<14} {:>+13.4e} {:>13.4e} {:>+12.3f}\n", r.t_s, r.quantity, r.residual_rad,
                        r.standard_error_rad, r.normalised());
  }
  return text;
}

}  // namespace

std::string measurement_text(const MeasurementReport& report, bool color) {
  std::string text = fmt::format("{} against {}\n", printable(report.file), printable(report.scenario_name));
  text += fmt::format("Measured    {} rows: {}\n", report.rows, quantities_text(report));
  if (report.status != RunStatus::completed)
    text += fmt::format("Prediction  {}\n",
                        strong(fmt::format("ended at {:.6g} s: {}", report.reached_s, to_string(report.status)), "31", color));
  if (report.correlation_time_s > 0)
    text += fmt::format("Errors      correlated over {:.6g} s, as stated; chi-squared is of what is new in each\n",
                        report.correlation_time_s);
  text += fmt::format("As given    {}\n", chi_squared_text(report.as_given));
  if (report.fitted)
    text += fmt::format("Fitted      {}; {} iteration{}, {} motions\n", chi_squared_text(*report.fitted), report.iterations,
                        report.iterations == 1 ? "" : "s", report.predictions);
  else if (report.fit != FitOutcome::not_asked)
    text += fmt::format("Fit         {}\n",
                        strong(fmt::format("{}: {}", to_string(report.fit), printable(report.fit_reason)), "31", color));
  text += fmt::format("Agreement   {}\n", agreement_text(report, color));
  for (const UnusedPrior& prior : report.unused_priors)
    text += fmt::format("Prior       {} did not enter: {}\n", prior.name, printable(prior.reason));
  for (const std::string& note : report.notes) text += fmt::format("Note        {}\n", printable(note));
  if (report.fitted) text += estimates_text(report, color);
  return report.residuals.empty() ? text : text + residuals_text(report);
}

}  // namespace earthtop::tool
