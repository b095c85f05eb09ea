// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/findings.hpp"

#include <gsl/gsl_cdf.h>

#include <Eigen/Core>
#include <algorithm>

#include "error/gsl_errors.hpp"
#include "measure/estimation.hpp"
#include "measure/exact_inputs.hpp"
#include "measure/fit_hints.hpp"
#include "measure/known_rate.hpp"
#include "measure/prediction_problem.hpp"
#include "measure/scaled_problem.hpp"

namespace earthtop::measure {
namespace {

/// The derivatives of the normalised residuals, those of the priors, 0, below them, at the fitted numbers.
class DerivativesAtFit {
 public:
  DerivativesAtFit(ReleasesReport& report, const std::vector<ComparedRelease>& releases, const Watch& watch)
      : report_(report), releases_(releases), whitening_(whitening_of(report)), watch_(watch) {}

  /// By the inputs behind the fitted ones.   @throws ScaledProblem::Stopped
  Eigen::MatrixXd by_others(const JointInputs& inputs, const std::vector<const EstimatedInputs*>& of_releases) {
    const std::vector<JointInput>& list = inputs.list();
    const std::size_t fitted = inputs.fitted(), others = list.size() - fitted;
    std::vector<VariedRelease> varied;
    for (std::size_t r = 0; r < releases_.size(); ++r)
      varied.push_back(varied_release(*of_releases[r], releases_[r].measurement(), report_.releases[r].residuals));
    Trials trials{report_.predictions, 1 / expected_derivatives(others)};
    FitProblem problem = prediction_problem(inputs, varied, watch_, trials);
    problem.whitening = whitening_;
    std::vector<double> at = problem.start;
    for (std::size_t j = 0; j < fitted; ++j) at[j] = *report_.estimates[j].estimate;
    ScaledProblem scaled(problem);
    const std::vector<double> u = scaled.scaled(at);
    const auto values = static_cast<Eigen::Index>(problem.standard_error.size());
    Eigen::MatrixXd J =
        Eigen::MatrixXd::Zero(values + static_cast<Eigen::Index>(report_.priors.size()), static_cast<Eigen::Index>(others));
    Eigen::VectorXd column;
    for (std::size_t k = 0; k < others; ++k) {
      scaled.derivative(u, fitted + k, ScaledProblem::Step::rough, column);
      J.col(static_cast<Eigen::Index>(k)).head(values) = column;
    }
    return J;
  }

 private:
  ReleasesReport& report_;
  const std::vector<ComparedRelease>& releases_;
  Whitening whitening_;
  const Watch& watch_;
};

/// Hints from numbers of the instruments and from the exact inputs.
std::vector<FitHint> found_hints(const ReleasesReport& report, const std::vector<ComparedRelease>& releases,
                                 const std::vector<ExactInputs>& exact_of, const JointExactInputs& exact,
                                 const std::vector<std::string>& shared, const Eigen::MatrixXd& J,
                                 DerivativesAtFit& derivatives) {
  std::vector<EstimatedInputs> of_releases;
  std::vector<const EstimatedInputs*> pointers;
  std::vector<std::size_t> fitted;
  of_releases.reserve(releases.size());
  for (std::size_t r = 0; r < releases.size(); ++r) {
    of_releases.push_back(with_instrument(releases[r].measurement(), exact_of[r], [&](const std::vector<std::string>& names) {
      return releases[r].inputs_of(names, ExactInputs::kMost);
    }));
    pointers.push_back(&of_releases.back());
    fitted.push_back(exact_of[r].fitted());
  }
  const JointInputs of_instrument(pointers, fitted, shared);
  return hints_of(report, J, exact, of_instrument, derivatives.by_others(of_instrument, pointers));
}

/// The scene that says how well an input is known besides: that of its release, for a shared one the first.
const Scene& scene_of(const JointInput& input, const std::vector<ComparedRelease>& releases) {
  return releases[input.release > 0 ? input.release - 1 : 0].scene();
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

void add_findings(ReleasesReport& report, const std::vector<ComparedRelease>& releases, const std::vector<std::string>& shared,
                  const Eigen::MatrixXd& by_fitted, const Watch& watch) {
  std::vector<ExactInputs> exact_of;
  exact_of.reserve(releases.size());
  for (const ComparedRelease& release : releases)
    exact_of.emplace_back(release.scene(), release.names(),
                          [&](const std::vector<std::string>& names) { return release.inputs_of(names, ExactInputs::kMost); });
  const JointExactInputs exact(exact_of, shared);
  DerivativesAtFit derivatives(report, releases, watch);
  Eigen::MatrixXd J(by_fitted.rows(), by_fitted.cols() + static_cast<Eigen::Index>(exact.exact()));
  try {
    J << by_fitted, derivatives.by_others(exact.all(), exact.of_releases());
    if (report.scatters_more()) report.hints = found_hints(report, releases, exact_of, exact, shared, J, derivatives);
  } catch (const ScaledProblem::Stopped&) {
    report.fit = FitOutcome::interrupted;
    report.fitted.reset();
    return;
  }
  for (std::size_t j = 0; j < report.estimates.size(); ++j) {
    ParameterEstimate& estimate = report.estimates[j];
    const JointInput& input = exact.all().list()[j];
    estimate.exact = exact.shifting(J, j);
    const auto known = known_rate(scene_of(input, releases), input);
    const double error = *estimate.said_error(report.scatters_more());
    if (!known || !(error > 0)) continue;
    std::optional<double> prior;
    for (const Prior& used : report.priors)
      if (used.input == estimate.name && used.release == estimate.release)
        prior = used.standard_error * (error / *estimate.standard_error);
    estimate.finding = rate_finding(*estimate.estimate, error, *known, prior);
    if (estimate.finding->outcome() == RateOutcome::contradicts)
      estimate.finding->culprits =
          errors_that_shift(estimate.exact, *estimate.estimate - known->value, most_of_a_misfit(*report.fitted));
  }
}

}  // namespace earthtop::measure
