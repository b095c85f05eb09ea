// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/estimation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "error/gsl_errors.hpp"
#include "measure/fit_search.hpp"
#include "measure/measured_motion.hpp"
#include "measure/measured_start.hpp"
#include "measure/prediction_problem.hpp"
#include "measure/weighted_fit.hpp"

namespace earthtop::measure {

namespace {

std::size_t number_of_values(const std::vector<MeasurementReport>& releases) {
  std::size_t values = 0;
  for (const MeasurementReport& release : releases) values += release.residuals.size();
  return values;
}

double sum_of_squares(const std::vector<MeasurementResidual>& residuals) {
  double sum = 0;
  for (const MeasurementResidual& residual : residuals) sum += residual.independent() * residual.independent();
  return sum;
}

/// @param of_values  sum of squares of the residuals   @param values  their number
ChiSquared chi_squared_from(double of_values, std::size_t values, const std::vector<Prior>& priors, std::size_t fitted) {
  const ReturnedGslErrors returned;
  ChiSquared chi_squared;
  for (const Prior& prior : priors) chi_squared.of_priors += *prior.pull * *prior.pull;
  chi_squared.value = of_values + chi_squared.of_priors;
  chi_squared.degrees_of_freedom = static_cast<std::int64_t>(values + priors.size()) - static_cast<std::int64_t>(fitted);
  if (chi_squared.degrees_of_freedom > 0)
    chi_squared.p_value = gsl_cdf_chisq_Q(chi_squared.value, static_cast<double>(chi_squared.degrees_of_freedom));
  return chi_squared;
}

}  // namespace

ChiSquared chi_squared_of(const std::vector<MeasurementResidual>& residuals, const std::vector<Prior>& priors,
                          std::size_t fitted) {
  return chi_squared_from(sum_of_squares(residuals), residuals.size(), priors, fitted);
}

ChiSquared chi_squared_of(const std::vector<MeasurementReport>& releases, const std::vector<Prior>& priors,
                          std::size_t fitted) {
  double sum = 0;
  for (const MeasurementReport& release : releases) sum += sum_of_squares(release.residuals);
  return chi_squared_from(sum, number_of_values(releases), priors, fitted);
}

void whiten(std::vector<MeasurementResidual>& residuals, const Whitening& whitening) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(residuals.size()));
  for (std::size_t i = 0; i < residuals.size(); ++i) values[static_cast<Eigen::Index>(i)] = residuals[i].normalised();
  whitening.whiten(values);
  for (std::size_t i = 0; i < residuals.size(); ++i) residuals[i].whitened = values[static_cast<Eigen::Index>(i)];
}

Whitening whitening_of(const MeasurementReport& release, double correlation_time_s) {
  return correlation_time_s > 0 ? Whitening(release.residuals, correlation_time_s, release.file) : Whitening();
}

Whitening whitening_of(const ReleasesReport& report) {
  Whitening whitening;
  for (const MeasurementReport& release : report.releases) whitening.append(whitening_of(release, report.correlation_time_s));
  return whitening;
}

namespace {

void fill_estimates(FitReport& report, const Fit& fit) {
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
std::string at_the_end_of_a_range(const std::vector<ComparedRelease>& releases, const JointInputs& inputs,
                                  const std::vector<double>& values) {
  constexpr double kNear = 1e-3;  // in scales
  std::vector<std::string> names;
  const auto exists = [&](const std::vector<double>& moved) {
    for (std::size_t r = 0; r < releases.size(); ++r)
      if (!releases[r].inputs().scene(inputs.values_of(r, moved))) return false;
    return true;
  };
  for (std::size_t j = 0; j < values.size(); ++j)
    for (const double step : {kNear, -kNear}) {
      std::vector<double> moved = values;
      moved[j] += step * inputs.list()[j].scale;
      if (!exists(moved)) names.push_back(name_in_release(inputs.list()[j].name, inputs.list()[j].release));
    }
  if (names.empty()) return "";
  return fmt::format("; {} {} at the end of {} range", fmt::join(names, ", "), names.size() == 1 ? "is" : "are",
                     names.size() == 1 ? "its" : "their");
}

/// Whether the motions part: a residual of an angle is above a quarter turn, and no error of measurement.
bool is_false_minimum(const std::vector<MeasurementReport>& releases, double chi_squared) {
  constexpr double kErrors = 10;  // standard errors
  const auto parts = [](const MeasurementResidual& residual) {
    return period_of(residual) > 0 && std::abs(residual.residual) > std::numbers::pi / 2 &&
           std::abs(residual.normalised()) > kErrors;
  };
  return chi_squared > FitSearch::kDoubted * static_cast<double>(number_of_values(releases)) &&
         std::ranges::any_of(releases, [&](const MeasurementReport& one) { return std::ranges::any_of(one.residuals, parts); });
}

std::string why_not_determined(const JointInputs& inputs, const std::vector<std::size_t>& undetermined) {
  std::vector<std::string> names;
  names.reserve(undetermined.size());
  for (const std::size_t j : undetermined) names.push_back(name_in_release(inputs.list()[j].name, inputs.list()[j].release));
  return names.size() == 1 ? fmt::format("these data do not determine {}", names.front())
                           : fmt::format("these data do not tell apart {}", fmt::join(names, ", "));
}

/// Requires as many data as numbers. @throws ScenarioError
void require_enough(const ReleasesReport& report, const JointInputs& inputs, std::size_t priors) {
  const std::size_t values = number_of_values(report.releases);
  if (values + priors >= inputs.list().size()) return;
  throw ScenarioError("--estimate", fmt::format("{} numbers cannot be estimated from {} measured ones{}", inputs.list().size(),
                                                values, priors == 0 ? "" : fmt::format(" and {} priors", priors)));
}

/// Replaces the residuals of the scenarios' own motions by those of the fit. @returns whether they could be computed
bool take_residuals(ReleasesReport& report, const std::vector<VariedRelease>& varied, const JointInputs& inputs,
                    const std::vector<double>& values, const Watch& watch, Trials& trials) {
  std::vector<std::vector<MeasurementResidual>> fitted;
  for (std::size_t r = 0; r < varied.size(); ++r) {
    const VariedRelease by_its_own_method{varied[r].inputs, varied[r].measurement};  // as a comparison with these values has it
    auto residuals = varied_residuals(by_its_own_method, inputs.values_of(r, values), watch, trials);
    if (!residuals) return false;
    fitted.push_back(std::move(*residuals));
  }
  for (std::size_t r = 0; r < fitted.size(); ++r) report.releases[r].residuals = std::move(fitted[r]);
  return true;
}

}  // namespace

double expected_predictions(std::size_t parameters) { return 1 + 10 * static_cast<double>(parameters); }

Eigen::MatrixXd fit_estimates(ReleasesReport& report, const std::vector<ComparedRelease>& releases, const JointInputs& inputs,
                              FoundPriors priors, const Watch& watch) {
  require_enough(report, inputs, priors.used.size());
  std::vector<VariedRelease> varied;
  for (std::size_t r = 0; r < releases.size(); ++r)
    varied.push_back(varied_release(releases[r].inputs(), releases[r].measurement(), report.releases[r].residuals));
  Trials trials{report.predictions, 1 / expected_predictions(inputs.list().size())};
  FitProblem problem = prediction_problem(inputs, varied, watch, trials);
  problem.whitening = whitening_of(report);
  problem.priors = std::move(priors.of_fit);
  for (const JointInput& input : inputs.list()) {
    report.estimates.push_back({input.name, input.unit, input.start, {}, {}, {}});
    report.estimates.back().release = input.release;
  }
  PartialProblems problems(problem, inputs, varied, report.correlation_time_s, watch, trials);
  const auto [fit, search] = search_fit(problems, report.as_given.value, start_by_precession(inputs, varied));
  report.fit = fit.outcome;
  report.search = search;
  report.iterations = fit.iterations;
  report.fit_reason = fit.reason;
  if (fit.outcome == FitOutcome::not_determined) report.fit_reason = why_not_determined(inputs, fit.undetermined);
  if (fit.outcome == FitOutcome::not_converged) report.fit_reason += at_the_end_of_a_range(releases, inputs, fit.parameters);
  if (fit.outcome != FitOutcome::converged) return {};
  if (!take_residuals(report, varied, inputs, fit.parameters, watch, trials)) {
    // The fit has computed this prediction, so that only a request to stop can have ended it.
    report.fit = watch.asks_to_stop() ? FitOutcome::interrupted : FitOutcome::prediction_failed;
    return {};
  }
  if (is_false_minimum(report.releases, fit.chi_squared)) {
    for (std::size_t r = 0; r < varied.size(); ++r) report.releases[r].residuals = varied[r].residuals;
    report.fit = FitOutcome::false_minimum;
    report.fit_reason = fmt::format(
        "the least sum of squares that was found, {:.6g}, leaves angles off by more than a quarter turn: it is no answer, "
        "and says nothing of errors",
        fit.chi_squared);
    return {};
  }
  if (report.correlation_time_s > 0)
    for (MeasurementReport& release : report.releases)
      whiten(release.residuals, whitening_of(release, report.correlation_time_s));
  for (std::size_t k = 0; k < priors.used.size(); ++k) {
    Prior& prior = priors.used[k];
    prior.pull = (fit.parameters[problem.priors[k].parameter] - prior.mean) / prior.standard_error;
  }
  report.priors = std::move(priors.used);
  report.fitted = chi_squared_of(report.releases, report.priors, inputs.list().size());
  fill_estimates(report, fit);
  return fit.jacobian;
}

}  // namespace earthtop::measure
