// SPDX-License-Identifier: GPL-3.0-or-later
// The paragraph by which a fit is quoted.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "earthtop/measure/measurement.hpp"
#include "earthtop/results/provenance.hpp"

namespace earthtop {
namespace measure {
namespace {

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) text += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
  return text;
}

/// "1202 values (azimuth and tilt) from 0 to 60 s", of several releases "2404 values (azimuth and tilt) of 2 releases"
std::string data_words(const std::vector<const MeasurementReport*>& releases) {
  std::size_t values = 0;
  double end_s = 0;
  std::vector<std::string> names;
  for (const MeasurementReport* release : releases) {
    values += release->residuals.size();
    end_s = std::max(end_s, release->reached_s);
    for (const auto& [quantity, count] : release->quantities)
      if (std::ranges::find(names, to_string(quantity)) == names.end()) names.emplace_back(to_string(quantity));
  }
  const std::string of = releases.size() > 1 ? fmt::format(" of {} releases", releases.size()) : "";
  return fmt::format("{} values ({}){} up to {:.4g} s after the release", values, listed(names), of, end_s);
}

std::string quoted(const FitReport& fit, bool agrees, const std::vector<const MeasurementReport*>& releases) {
  if (!agrees || !fit.fitted || fit.estimates.empty()) return "";
  std::vector<std::string> values;
  for (const ParameterEstimate& e : fit.estimates)
    values.push_back(fmt::format("{} = {}{}{}", name_in_release(e.name, e.release),
                                 with_standard_error(*e.estimate, *e.standard_error), e.unit.empty() ? "" : " ", e.unit));
  std::string text = fmt::format(
      "A weighted least-squares fit with earthtop {} to {} gave {}; chi-squared was {:.5g} for {} degrees of freedom{}. The "
      "errors are "
      "one standard deviation (k = 1) and follow from the stated errors of the values, {}.",
      build_info().version, data_words(releases), listed(values), fit.fitted->value, fit.fitted->degrees_of_freedom,
      fit.fitted->p_value ? fmt::format(" (p = {:.2g})", *fit.fitted->p_value) : "",
      fit.correlation_time_s > 0 ? fmt::format("which were taken as correlated over {:g} s", fit.correlation_time_s)
                                 : "which were taken as independent");
  if (!fit.priors.empty()) {
    std::vector<std::string> known;
    for (const Prior& prior : fit.priors)
      known.push_back(fmt::format("{} ({:.2g}{}{})", name_in_release(prior.input, prior.release), prior.standard_error,
                                  prior.unit.empty() ? "" : " ", prior.unit));
    text += fmt::format(" Known beforehand, with the standard errors in brackets: {}.", listed(known));
  }
  const ParameterEstimate& first = fit.estimates.front();
  if (first.exact.empty()) return text;
  constexpr std::size_t kNamed = 3;
  std::vector<std::string> exact;
  for (const ExactInput& input : first.exact)
    if (exact.size() < kNamed)
      exact.push_back(fmt::format("{} by {:.2g}{}{}", name_in_release(input.name, input.release),
                                  input.error_of_one_sigma(*first.standard_error), input.unit.empty() ? "" : " ", input.unit));
  return text +
         fmt::format(
             " All other inputs were taken as exact; {} would move by its standard deviation if one of these were wrong: {}.",
             name_in_release(first.name, first.release), listed(exact));
}

}  // namespace
}  // namespace measure

std::string quotation(const MeasurementReport& report) { return measure::quoted(report, report.agrees(), {&report}); }

std::string quotation(const ReleasesReport& report) {
  std::vector<const MeasurementReport*> releases;
  for (const MeasurementReport& release : report.releases) releases.push_back(&release);
  return measure::quoted(report, report.agrees(), releases);
}

}  // namespace earthtop
