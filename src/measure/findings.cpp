// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/findings.hpp"

#include <gsl/gsl_cdf.h>

#include <Eigen/Core>
#include <algorithm>

#include "error/gsl_errors.hpp"
#include "measure/fit_hints.hpp"
#include "measure/known_rate.hpp"
#include "measure/measured_motion.hpp"
#include "measure/prediction_problem.hpp"
#include "measure/scaled_problem.hpp"
#include "measure/seen_directions.hpp"

namespace earthtop::measure {
namespace {

/// The derivatives of the normalised residuals, those of the priors below them, at the fitted numbers.
class DerivativesAtFit {
 public:
  DerivativesAtFit(MeasurementReport& report, const Measurement& measurement, const Whitening& whitening, const Watch& watch)
      : report_(report),
        measurement_(measurement),
        whitening_(whitening),
        watch_(watch),
        times_s_(measured_times(measurement)) {}

  /// By the inputs from `begin` on; the first of them are the fitted ones.   @throws ScaledProblem::Stopped
  Eigen::MatrixXd by(const EstimatedInputs& inputs, std::size_t begin) {
    const std::vector<EstimatedInput>& list = inputs.list();
    const std::size_t fitted = report_.estimates.size();
    Trials trials{report_.predictions, 1 / expected_derivatives(list.size()), 0, {}};
    FitProblem problem = prediction_problem(inputs, measurement_, report_.residuals, times_s_, watch_, trials);
    problem.whitening = whitening_;
    std::vector<double> at = problem.start;
    for (std::size_t j = 0; j < fitted; ++j) {
      at[j] = *report_.estimates[j].estimate;
      for (const Prior& prior : report_.priors)
        if (prior.input == list[j].name) problem.priors.push_back({j, prior.standard_error});
    }
    ScaledProblem scaled(problem);
    const std::vector<double> u = scaled.scaled(at);
    Eigen::MatrixXd J(scaled.residuals(), list.size() - begin);
    Eigen::VectorXd column;
    for (std::size_t j = begin; j < list.size(); ++j) {
      scaled.derivative(u, j, j < fitted ? ScaledProblem::Step::fine : ScaledProblem::Step::rough, column);
      J.col(static_cast<Eigen::Index>(j - begin)) = column;
    }
    if (problem.priors.empty() || begin > 0) return J;
    auto of_fitted = J.topLeftCorner(static_cast<Eigen::Index>(report_.residuals.size()), static_cast<Eigen::Index>(fitted));
    of_fitted = seen_directions(of_fitted).seen_part(of_fitted);
    return J;
  }

 private:
  MeasurementReport& report_;
  const Measurement& measurement_;
  const Whitening& whitening_;
  const Watch& watch_;
  std::vector<double> times_s_;
};

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
                  const ExactInputs::InputsOf& inputs_of, const Whitening& whitening, const Watch& watch) {
  DerivativesAtFit derivatives(report, measurement, whitening, watch);
  Eigen::MatrixXd J;
  try {
    J = derivatives.by(exact.all(), 0);
    if (report.scatters_more()) {
      const EstimatedInputs of_instrument = with_instrument(scene, exact, inputs_of);
      report.hints = hints_of(report, J, exact, of_instrument, derivatives.by(of_instrument, exact.fitted()));
    }
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
