// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/estimation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "error/gsl_errors.hpp"
#include "measure/fit_search.hpp"
#include "measure/measured_motion.hpp"
#include "measure/prediction_problem.hpp"
#include "measure/weighted_fit.hpp"

namespace earthtop::measure {

ChiSquared chi_squared_of(const std::vector<MeasurementResidual>& residuals, const std::vector<Prior>& priors,
                          std::size_t fitted) {
  const ReturnedGslErrors returned;
  ChiSquared chi_squared;
  for (const MeasurementResidual& residual : residuals) chi_squared.value += residual.independent() * residual.independent();
  for (const Prior& prior : priors) chi_squared.of_priors += *prior.pull * *prior.pull;
  chi_squared.value += chi_squared.of_priors;
  chi_squared.degrees_of_freedom =
      static_cast<std::int64_t>(residuals.size() + priors.size()) - static_cast<std::int64_t>(fitted);
  if (chi_squared.degrees_of_freedom > 0)
    chi_squared.p_value = gsl_cdf_chisq_Q(chi_squared.value, static_cast<double>(chi_squared.degrees_of_freedom));
  return chi_squared;
}

void whiten(std::vector<MeasurementResidual>& residuals, const Whitening& whitening) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(residuals.size()));
  for (std::size_t i = 0; i < residuals.size(); ++i) values[static_cast<Eigen::Index>(i)] = residuals[i].normalised();
  whitening.whiten(values);
  for (std::size_t i = 0; i < residuals.size(); ++i) residuals[i].whitened = values[static_cast<Eigen::Index>(i)];
}

Whitening whitening_of(const MeasurementReport& report) {
  return report.correlation_time_s > 0 ? Whitening(report.residuals, report.correlation_time_s, report.file) : Whitening();
}

namespace {

void fill_estimates(MeasurementReport& report, const Fit& fit) {
  const double scatter = report.fitted->degrees_of_freedom > 0
                             ? std::sqrt(report.fitted->value / static_cast<double>(report.fitted->degrees_of_freedom))
                             : 1;
  const auto p = static_cast<Eigen::Index>(report.estimates.size());
  for (Eigen::Index j = 0; j < p; ++j) {
    ParameterEstimate& estimate = report.estimates[static_cast<std::size_t>(j)];
    estimate.estimate = fit.parameters[static_cast<std::size_t>(j)];
    estimate.standard_error = std::sqrt(fit.covariance(j, j));
    estimate.standard_error_scaled = *estimate.standard_error * std::max(1.0, scatter);
    std::vector<double>& row = report.correlation.emplace_back();
    for (Eigen::Index k = 0; k < p; ++k)
      row.push_back(j == k ? 1 : fit.covariance(j, k) / std::sqrt(fit.covariance(j, j) * fit.covariance(k, k)));
  }
}

/// The inputs of a search that ended at the end of their ranges, beyond which there is no such scenario: "; latitude_deg is at the end of
/// its range"
std::string at_the_end_of_a_range(const EstimatedInputs& inputs, const std::vector<double>& values) {
  constexpr double kNear = 1e-3;  // in scales
  std::vector<std::string> names;
  for (std::size_t j = 0; j < values.size(); ++j)
    for (const double step : {kNear, -kNear}) {
      std::vector<double> moved = values;
      moved[j] += step * inputs.list()[j].scale;
      if (!inputs.scene(moved)) names.push_back(inputs.list()[j].name);
    }
  if (names.empty()) return "";
  return fmt::format("; {} {} at the end of {} range", fmt::join(names, ", "), names.size() == 1 ? "is" : "are",
                     names.size() == 1 ? "its" : "their");
}

/// Whether the motions part: a residual of an angle is above a quarter turn, and no error of measurement.
bool is_false_minimum(const std::vector<MeasurementResidual>& residuals, double chi_squared) {
  constexpr double kErrors = 10;  // standard errors
  return chi_squared > FitSearch::kDoubted * static_cast<double>(residuals.size()) &&
         std::ranges::any_of(residuals, [](const MeasurementResidual& residual) {
           return period_of(residual) > 0 && std::abs(residual.residual) > std::numbers::pi / 2 &&
                  std::abs(residual.normalised()) > kErrors;
         });
}

}  // namespace

double expected_predictions(std::size_t parameters) { return 1 + 10 * static_cast<double>(parameters); }

void fit_estimates(MeasurementReport& report, const Measurement& measurement, const EstimatedInputs& inputs, FoundPriors priors,
                   const Watch& watch) {
  const std::vector<double> times = measured_times(measurement);
  if (report.residuals.size() + priors.used.size() < inputs.list().size())
    throw ScenarioError(
        "--estimate",
        fmt::format("{} numbers cannot be estimated from {} measured ones{}", inputs.list().size(), report.residuals.size(),
                    priors.used.empty() ? "" : fmt::format(" and {} priors", priors.used.size())));
  Trials trials{report.predictions, 1 / expected_predictions(inputs.list().size()), 0, {}};
  FitProblem problem = prediction_problem(inputs, measurement, report.residuals, times, watch, trials);
  problem.whitening = whitening_of(report);
  problem.priors = std::move(priors.of_fit);
  for (const EstimatedInput& input : inputs.list())
    report.estimates.push_back({input.name, input.unit, input.start, {}, {}, {}});
  PartialProblems problems(problem, inputs, measurement, report.residuals, report.correlation_time_s, watch, trials);
  const auto [fit, search] = search_fit(problems, report.as_given.value);
  report.fit = fit.outcome;
  report.search = search;
  report.iterations = fit.iterations;
  report.fit_reason = fit.reason;
  if (fit.outcome == FitOutcome::not_determined) {
    std::vector<std::string> names;
    for (const std::size_t j : fit.undetermined) names.push_back(inputs.list()[j].name);
    report.fit_reason = names.size() == 1 ? fmt::format("these data do not determine {}", names.front())
                                          : fmt::format("these data do not tell apart {}", fmt::join(names, ", "));
  }
  if (fit.outcome == FitOutcome::not_converged) report.fit_reason += at_the_end_of_a_range(inputs, fit.parameters);
  if (fit.outcome != FitOutcome::converged) return;
  std::vector<double> residuals;
  if (!problem.residuals_at(fit.parameters, residuals)) {
    // The fit has computed this prediction, so that only a request to stop can have ended it.
    report.fit = watch.asks_to_stop() ? FitOutcome::interrupted : FitOutcome::prediction_failed;
    return;
  }
  if (is_false_minimum(trials.latest, fit.chi_squared)) {
    report.fit = FitOutcome::false_minimum;
    report.fit_reason = fmt::format(
        "the least sum of squares that was found, {:.6g}, leaves angles off by more than a quarter turn: it is no answer, "
        "and says nothing of errors",
        fit.chi_squared);
    return;
  }
  report.residuals = std::move(trials.latest);
  if (report.correlation_time_s > 0) whiten(report.residuals, problem.whitening);
  for (std::size_t k = 0; k < priors.used.size(); ++k) {
    Prior& prior = priors.used[k];
    prior.pull = (fit.parameters[problem.priors[k].parameter] - prior.mean) / prior.standard_error;
  }
  report.priors = std::move(priors.used);
  report.fitted = chi_squared_of(report.residuals, report.priors, inputs.list().size());
  fill_estimates(report, fit);
}

}  // namespace earthtop::measure
