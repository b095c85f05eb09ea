// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/findings.hpp"

#include <gsl/gsl_cdf.h>

#include <Eigen/Core>
#include <algorithm>

#include "error/gsl_errors.hpp"
#include "measure/known_rate.hpp"
#include "measure/measured_motion.hpp"
#include "measure/prediction_problem.hpp"
#include "measure/scaled_problem.hpp"
#include "measure/seen_directions.hpp"

namespace earthtop::measure {
namespace {

/// The derivatives of the normalised residuals, those of the priors below them, by fitted and exact inputs at the fitted numbers.
/// @throws ScaledProblem::Stopped
Eigen::MatrixXd derivatives_by_all(MeasurementReport& report, const Measurement& measurement, const ExactInputs& exact,
                                   const Whitening& whitening, const Watch& watch) {
  const std::vector<EstimatedInput>& inputs = exact.all().list();
  const std::vector<double> times = measured_times(measurement);
  Trials trials{report.predictions, 1 / expected_derivatives(inputs.size()), 0, {}};
  FitProblem problem = prediction_problem(exact.all(), measurement, report.residuals, times, watch, trials);
  problem.whitening = whitening;
  std::vector<double> u(inputs.size(), 1);
  for (std::size_t j = 0; j < exact.fitted(); ++j) {
    u[j] += (*report.estimates[j].estimate - inputs[j].start) / inputs[j].scale;
    for (const Prior& prior : report.priors)
      if (prior.input == inputs[j].name) problem.priors.push_back({j, prior.standard_error});
  }
  ScaledProblem scaled(problem);
  Eigen::MatrixXd J(scaled.residuals(), inputs.size());
  Eigen::VectorXd column;
  for (std::size_t j = 0; j < inputs.size(); ++j) {
    scaled.derivative(u, j, j < exact.fitted() ? ScaledProblem::Step::fine : ScaledProblem::Step::rough, column);
    J.col(static_cast<Eigen::Index>(j)) = column;
  }
  if (problem.priors.empty()) return J;
  auto of_fitted =
      J.topLeftCorner(static_cast<Eigen::Index>(report.residuals.size()), static_cast<Eigen::Index>(exact.fitted()));
  of_fitted = seen_directions(of_fitted).seen_part(of_fitted);
  return J;
}

/// The part of chi-squared that the misfit of a wrong input may have: what it is above the expected value, and by how much it may
/// be above that before the p-value counts as too small.
double most_of_a_misfit(const ChiSquared& fitted) {
  const ReturnedGslErrors returned;
  const auto freedom = static_cast<double>(std::max<std::int64_t>(fitted.degrees_of_freedom, 1));
  constexpr double kLinear = 1.2;  // a misfit that follows from derivatives is this well known, squared
  return kLinear * std::max(fitted.value - freedom, 0.0) + gsl_cdf_chisq_Qinv(MeasurementReport::kLeastPValue, freedom) -
         freedom;
}

}  // namespace

double expected_derivatives(std::size_t inputs) { return 4 * static_cast<double>(inputs); }

void add_findings(MeasurementReport& report, const Measurement& measurement, const Scene& scene, const ExactInputs& exact,
                  const Whitening& whitening, const Watch& watch) {
  Eigen::MatrixXd J;
  try {
    J = derivatives_by_all(report, measurement, exact, whitening, watch);
  } catch (const ScaledProblem::Stopped&) {
    report.fit = FitOutcome::interrupted;
    report.fitted.reset();
    return;
  }
  for (std::size_t j = 0; j < report.estimates.size(); ++j) {
    ParameterEstimate& estimate = report.estimates[j];
    estimate.exact = exact.shifting(J, j);
    const auto known = known_rate(scene, exact.all().list()[j]);
    const double error = *estimate.said_error(report.scatters_more());
    if (!known || !(error > 0)) continue;
    std::optional<double> prior;
    for (const Prior& used : report.priors)
      if (used.input == estimate.name) prior = used.standard_error * (error / *estimate.standard_error);
    estimate.finding = rate_finding(*estimate.estimate, error, *known, prior);
    if (estimate.finding->outcome() == RateOutcome::contradicts)
      estimate.finding->culprits =
          errors_that_shift(estimate.exact, *estimate.estimate - known->value, most_of_a_misfit(*report.fitted));
  }
}

}  // namespace earthtop::measure
