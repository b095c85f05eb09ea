// SPDX-License-Identifier: GPL-3.0-or-later
#include "measurement_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "earthtop/error.hpp"
#include "earthtop/measure/measurement.hpp"
#include "exact_inputs_text.hpp"
#include "measure/quantities.hpp"
#include "screen.hpp"
#include "wrapped.hpp"

namespace earthtop::tool {
namespace {

std::string strong(std::string_view text, std::string_view code, bool color) {
  return color ? fmt::format("\x1b[{}m{}\x1b[0m", code, text) : std::string(text);
}

std::string chi_squared_text(const ChiSquared& chi_squared) {
  std::string text = fmt::format("chi-squared {:.6g} of {} degree{} of freedom", chi_squared.value,
                                 chi_squared.degrees_of_freedom, chi_squared.degrees_of_freedom == 1 ? "" : "s");
  if (chi_squared.p_value)
    text += *chi_squared.p_value >= 1e-4 || *chi_squared.p_value == 0 ? fmt::format(", p-value {:.4g}", *chi_squared.p_value)
                                                                      : fmt::format(", p-value {:.1e}", *chi_squared.p_value);
  return text;
}

std::string quantities_text(const MeasurementReport& report) {
  std::string text;
  for (const auto& [quantity, values] : report.quantities)
    text += fmt::format("{}{} of {}", text.empty() ? "" : ", ", values, to_string(quantity));
  return text;
}

std::string agreement_text(const FitReport& report, bool agrees, RunStatus status, bool color) {
  if (agrees) return strong("yes", "32", color);
  std::string reason = fmt::format("the p-value is below {:g}", FitReport::kLeastPValue);
  if (status != RunStatus::completed)
    reason = "the prediction does not reach the last row";
  else if (report.fit != FitOutcome::not_asked && !report.fitted)
    reason = "there is no fit";
  else if (report.contradicts_known_rate())
    reason = "an estimate contradicts the known rate of the Earth";
  return fmt::format("{}: {}", strong("no", "31", color), reason);
}

/// An estimate's name; with its release where there are several and it is not that of all.
std::string label(const ParameterEstimate& estimate) { return printable(name_in_release(estimate.name, estimate.release)); }

/// @param least_correlation  smaller ones are not printed
std::string estimates_text(const FitReport& report, double least_correlation, const Screen& screen) {
  std::string text = "\nEstimates\n";
  const auto add_detail = [&](std::string_view detail) { text += wrapped_entry("", detail, screen.width, 6); };
  for (std::size_t j = 0; j < report.estimates.size(); ++j) {
    const ParameterEstimate& e = report.estimates[j];
    const std::string value = strong(with_standard_error(*e.estimate, *e.standard_error), "1", screen.color);
    text += fmt::format("  {}  {}{}{}\n", label(e), value, e.unit.empty() ? "" : " ", e.unit);
    add_detail(printable(estimate_sentence(e, report.scatters_more())));
    for (const Prior& prior : report.priors)
      if (prior.input == e.name && prior.release == e.release)
        add_detail(fmt::format("known beforehand as {} {}; the estimate differs by {:+.2f} of these standard errors",
                               with_standard_error(prior.mean, prior.standard_error), prior.unit, prior.pull.value_or(0)));
    for (std::size_t k = 0; k < j; ++k)
      if (std::abs(report.correlation[j][k]) >= least_correlation)
        add_detail(fmt::format("correlation with {}  {:+.4f}", label(report.estimates[k]), report.correlation[j][k]));
  }
  return text;
}

/// Tells what the estimates of the Earth's rate rest on; where there is none of these, what the first one does.
std::string exact_text(const FitReport& report, const Screen& screen) {
  std::string text;
  const auto add = [&](const ParameterEstimate& e) {
    text += exact_inputs_text(e.exact, label(e), *e.said_error(report.scatters_more()), screen);
  };
  for (const ParameterEstimate& estimate : report.estimates)
    if (estimate.finding) add(estimate);
  if (text.empty()) add(report.estimates.front());
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
  std::vector<std::string_view> units;
  for (const MeasurementResidual& residual : report.residuals) {
    const std::string_view unit = measure::spoken_unit(measure::row_of(residual.quantity).dimension);
    if (std::ranges::find(units, unit) == units.end()) units.push_back(unit);
  }
  const bool are_angles = units == std::vector<std::string_view>{"rad"};
  std::string text = fmt::format("\nResiduals{}, measured less predicted{}\n  {:>14}  {:<18} {:>13} {:>13} {:>12}\n",
                                 report.fitted ? " after the fit" : "",
                                 report.residuals.size() > kShown ? fmt::format(": the {} largest", kShown) : "", "t_s",
                                 "quantity", are_angles ? "residual_rad" : fmt::format("{}", fmt::join(units, ", ")),
                                 are_angles ? "st_error_rad" : "st. error", "st. errors");
  for (const std::size_t i : order) {
    const MeasurementResidual& r = report.residuals[i];
    text += fmt::format("  {:>14.8g}  {:<18} {:>+13.4e} {:>13.4e} {:>+12.3f}\n", r.t_s, r.quantity, r.residual,
                        r.standard_error, r.normalised());
  }
  return text;
}

/// How the fit was found, after the number of its motions; nothing where it began at the scenario's numbers with all rows.
std::string search_text(const FitSearch& search) {
  std::string text;
  if (search.spans > 1) text += fmt::format("; over {} growing spans of the rows", search.spans);
  if (search.attempts > 1) text += fmt::format("; {} ways were tried", search.attempts);
  if (search.minima > 1) text += fmt::format(", and the lowest of {} minima taken", search.minima);
  return text;
}

using Add = std::function<void(std::string_view label, std::string_view text)>;

/// The lines on a fit and on chi-squared, up to the notes.
void add_fit(const FitReport& report, bool agrees, RunStatus status, bool color, const Add& add) {
  if (report.correlation_time_s > 0)
    add("Errors", fmt::format("correlated over {:.6g} s, as stated; chi-squared counts only the part of each that is new",
                              report.correlation_time_s));
  add("As given", chi_squared_text(report.as_given));
  if (report.fitted)
    add("Fitted", fmt::format("{}; {} iteration{}, {} motions{}", chi_squared_text(*report.fitted), report.iterations,
                              report.iterations == 1 ? "" : "s", report.predictions, search_text(report.search)));
  else if (report.fit != FitOutcome::not_asked)
    add("Fit", strong(fmt::format("{}: {}", to_string(report.fit), printable(report.fit_reason)), "31", color));
  add("Agreement", agreement_text(report, agrees, status, color));
  for (const UnusedPrior& prior : report.unused_priors)
    add("Prior", fmt::format("{} did not enter: {}", prior.name, printable(prior.reason)));
  for (const FitHint& hint : report.hints) add("Hint", printable(hint_sentence(hint)));
  for (const std::string& note : report.notes) add("Note", printable(note));
}

/// The paragraph to quote; empty where there is nothing to quote.
std::string quotation_text(const std::string& quotation, const Screen& screen) {
  return quotation.empty() ? "" : "\nTo quote\n" + wrapped("  " + printable(quotation), screen.width, 2) + '\n';
}

/// A release's own part of a comparison of several.
std::string release_text(const MeasurementReport& release) {
  std::string text = fmt::format("{} against {}: {} rows, {}", printable(release.file), printable(release.scenario_name),
                                 release.rows, quantities_text(release));
  if (release.status != RunStatus::completed)
    return text + fmt::format("; the prediction ended at {:.6g} s: {}", release.reached_s, to_string(release.status));
  const ChiSquared& last = release.fitted ? *release.fitted : release.as_given;
  return text + fmt::format("; chi-squared {:.6g} of {} values", last.value, release.residuals.size());
}

}  // namespace

std::string measurement_text(const MeasurementReport& report, const Screen& screen) {
  const bool color = screen.color;
  std::string text =
      wrapped(fmt::format("{} against {}", printable(report.file), printable(report.scenario_name)), screen.width, 2) + '\n';
  const auto add = [&](std::string_view label, std::string_view what) { text += wrapped_entry(label, what, screen.width, 12); };
  add("Measured", fmt::format("{} rows: {}", report.rows, quantities_text(report)));
  if (report.status != RunStatus::completed)
    add("Prediction", strong(fmt::format("ended at {:.6g} s: {}", report.reached_s, to_string(report.status)), "31", color));
  add_fit(report, report.agrees(), report.status, color, add);
  if (report.fitted) text += estimates_text(report, 0, screen) + exact_text(report, screen);
  text += quotation_text(quotation(report), screen);
  return report.residuals.empty() ? text : text + residuals_text(report);
}

std::string releases_text(const ReleasesReport& report, const Screen& screen) {
  std::string text = fmt::format("{} releases, one fit\n", report.releases.size());
  const auto add = [&](std::string_view label, std::string_view what) { text += wrapped_entry(label, what, screen.width, 12); };
  for (std::size_t r = 0; r < report.releases.size(); ++r)
    add(fmt::format("Release {}", r + 1), release_text(report.releases[r]));
  add_fit(report, report.agrees(), report.status(), screen.color, add);
  for (std::size_t r = 0; r < report.releases.size(); ++r)
    for (const std::string& note : report.releases[r].notes) add("Note", fmt::format("release {}: {}", r + 1, printable(note)));
  constexpr double kLeastCorrelation = 0.1;  // there are many of them; the document has all
  if (report.fitted) text += estimates_text(report, kLeastCorrelation, screen) + exact_text(report, screen);
  return text + quotation_text(quotation(report), screen);
}

}  // namespace earthtop::tool
