// SPDX-License-Identifier: GPL-3.0-or-later
// Errors that are correlated in time: whitening against the full covariance matrix, and fits to a thousand seeded sets.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "measure/correlated_sets.hpp"
#include "measure/weighted_fit.hpp"
#include "measure/whitening.hpp"
#include "support/json.hpp"

namespace earthtop {
namespace {

using namespace test;
using measure::Whitening;

/// Residuals of two quantities in turns at uneven times, 0.3 to 3 correlation times apart.
std::vector<MeasurementResidual> two_series(Normal& normal) {
  std::vector<MeasurementResidual> residuals;
  double t_s = 0;
  for (int k = 0; k < 24; ++k) {
    t_s += 0.1 + std::abs(normal());
    const double error = k % 5 == 0 ? 3e-4 : 1e-4;
    const std::uint64_t line = residuals.size() + 2;
    if (k % 3 != 1) residuals.push_back({t_s, line, "azimuth", 0, 0, error * normal(), error});
    if (k % 4 != 2) residuals.push_back({t_s, line, "tilt", 0, 0, error * normal(), error});
  }
  return residuals;
}

Eigen::VectorXd normalised(const std::vector<MeasurementResidual>& residuals) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(residuals.size()));
  for (std::size_t i = 0; i < residuals.size(); ++i) values[static_cast<Eigen::Index>(i)] = residuals[i].normalised();
  return values;
}

// The sum of whitened squares is r^T C^-1 r with the covariance matrix C of all errors, and whitening is linear.
TEST(CorrelatedErrors, WhiteningIsTheInverseOfTheCovariance) {
  Normal normal(3);
  const double tau_s = 1.7;
  const auto residuals = two_series(normal);
  const auto n = static_cast<Eigen::Index>(residuals.size());
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      const auto &a = residuals[static_cast<std::size_t>(i)], &b = residuals[static_cast<std::size_t>(j)];
      if (a.quantity == b.quantity) C(i, j) = std::exp(-std::abs(a.t_s - b.t_s) / tau_s);
    }
  const Eigen::VectorXd r = normalised(residuals);
  const double expected = r.dot(C.ldlt().solve(r));
  const Whitening whitening(residuals, tau_s, "");
  Eigen::VectorXd white = r, derivative = r;
  whitening.whiten(white);
  whitening.whiten_derivative(derivative);
  EXPECT_NEAR(white.squaredNorm(), expected, 1e-11 * expected);  // some 30^2 roundings, times a condition number of some 100
  EXPECT_EQ(white, derivative);
  EXPECT_GT(std::abs(white.squaredNorm() - r.squaredNorm()), 0.05 * expected) << "a test without correlation";
}

TEST(CorrelatedErrors, LongApartTheyAreIndependent) {
  Normal normal(4);
  const auto residuals = two_series(normal);
  Eigen::VectorXd white = normalised(residuals);
  Whitening(residuals, 1e-6, "").whiten(white);
  EXPECT_EQ(white, normalised(residuals));
}

// A whole turn in a measured azimuth, and one that begins between two rows, change nothing.
TEST(CorrelatedErrors, WholeTurnsChangeNothing) {
  Normal normal(5);
  const auto residuals = two_series(normal);
  const Whitening whitening(residuals, 1.7, "");
  Eigen::VectorXd white = normalised(residuals), turned = white;
  whitening.whiten(white);
  for (std::size_t i = residuals.size() / 2; i < residuals.size(); ++i)
    if (residuals[i].quantity == "azimuth")
      turned[static_cast<Eigen::Index>(i)] += (i % 2 == 0 ? 2 : -4) * kPi / residuals[i].standard_error;
  whitening.whiten(turned);
  // A turn is 6e4 standard errors, and 1 / sqrt(1 - rho^2) at most 3.
  EXPECT_LT((white - turned).cwiseAbs().maxCoeff(), 1e5 * 3 * 4 * 2.3e-16);
}

TEST(CorrelatedErrors, TwoValuesAtOneTimeAreRefused) {
  const std::vector<MeasurementResidual> residuals = {
      {1, 2, "tilt", 0, 0, 0, 1e-4}, {1, 3, "azimuth", 0, 0, 0, 1e-4}, {1, 4, "tilt", 0, 0, 0, 1e-4}};
  try {
    const Whitening whitening(residuals, 2, "m.csv");
    ADD_FAILURE();
  } catch (const ScenarioError& error) {
    EXPECT_EQ(error.file(), "m.csv");
    EXPECT_EQ(error.diagnostics().at(0).line, 4);
    EXPECT_NE(std::string(error.what()).find("tilt at 1 s is on line 2 too"), std::string::npos) << error.what();
  }
}

/// The chance of a larger chi-squared with an even number of degrees of freedom.
double chance_of(double chi_squared, int freedom) {
  double term = 1, sum = 1;
  for (int k = 1; k < freedom / 2; ++k) sum += term *= chi_squared / 2 / k;
  return std::exp(-chi_squared / 2) * sum;
}

/// Fits the vertical rate and the azimuth at release to a thousand sets of azimuths of a free gyroscope.
Scores scores_of_fits(bool tau_is_stated) {
  const std::vector<double> times = uneven_times();
  std::vector<double> truth;
  for (const double t : times) truth.push_back(azimuth(free_axis(kEast, kNorthward45, kVertical45, t)));
  measure::FitProblem problem;
  problem.start = {kVertical45, 0};
  problem.scales = {kOmega, 1};
  problem.stopped = [] { return false; };
  std::vector<MeasurementResidual> rows;
  for (std::size_t k = 0; k < times.size(); ++k) {
    rows.push_back({times[k], k + 2, "azimuth", 0, 0, 0, error_of_row(k)});
    problem.standard_error.push_back(error_of_row(k));
    problem.period.push_back(2 * kPi);
  }
  if (tau_is_stated) problem.whitening = Whitening(rows, kTau_s, "");
  std::vector<double> measured;
  problem.residuals_at = [&](const std::vector<double>& x, std::vector<double>& residuals) {
    residuals.clear();
    for (std::size_t k = 0; k < times.size(); ++k)
      residuals.push_back(measured[k] - azimuth(free_axis(kEast, kNorthward45, x[0], times[k])) - x[1]);
    return true;
  };
  Normal normal(kCorrelatedSeed);
  Scores scores;
  for (int set = 0; set < kSets; ++set) {
    measured = correlated_errors(times, normal);
    for (std::size_t k = 0; k < times.size(); ++k) measured[k] += truth[k];
    const measure::Fit fit = fit_weighted(problem);
    if (fit.outcome != FitOutcome::converged) {
      ADD_FAILURE() << fit.reason;
      break;
    }
    scores.pulls.push_back((fit.parameters[0] - kVertical45) / std::sqrt(fit.covariance(0, 0)));
    std::vector<double> residuals;
    problem.residuals_at(fit.parameters, residuals);
    for (std::size_t k = 0; k < times.size(); ++k) rows[k].residual = residuals[k];
    Eigen::VectorXd values = normalised(rows);
    problem.whitening.whiten(values);
    scores.chances.push_back(chance_of(values.squaredNorm(), kCorrelatedRows - 2));
  }
  return scores;
}

TEST(CorrelatedErrors, StatedTheyMakeErrorsOfEstimatesRight) { expect_errors_as_stated(scores_of_fits(true)); }
TEST(CorrelatedErrors, IgnoredTheyMakeErrorsOfEstimatesTooSmall) { expect_errors_too_small(scores_of_fits(false)); }

std::string csv_of(const std::vector<double>& times, const std::vector<double>& errors) {
  std::string csv = "t_s,azimuth_rad,azimuth_se_rad\n";
  for (std::size_t k = 0; k < times.size(); ++k)
    csv += fmt::format("{},{},{}\n", times[k], azimuth(free_axis(kEast, kNorthward45, kVertical45, times[k])) + errors[k],
                       error_of_row(k));
  return csv;
}

class CorrelatedMeasurement : public MeasurementTest {};

TEST_F(CorrelatedMeasurement, TheReportHasBothKindsOfResiduals) {
  Normal normal(11);
  const std::vector<double> times = uneven_times();
  const Measurement measurement = read(csv_of(times, correlated_errors(times, normal)));
  MeasurementOptions options{.estimates = {"omega_sin_latitude_rad_s"}};
  const auto ignored = compare_with_measurement(shipped("free-gyro"), {}, measurement, options);
  options.correlation_time_s = kTau_s;
  const auto stated = compare_with_measurement(shipped("free-gyro"), {}, measurement, options);
  ASSERT_TRUE(stated.fitted);
  double sum = 0;
  for (std::size_t i = 0; i < stated.residuals.size(); ++i) {
    ASSERT_TRUE(stated.residuals[i].whitened);
    EXPECT_FALSE(ignored.residuals[i].whitened);
    sum += *stated.residuals[i].whitened * *stated.residuals[i].whitened;
  }
  EXPECT_NEAR(stated.fitted->value, sum, 1e-12 * sum);
  EXPECT_EQ(stated.fitted->degrees_of_freedom, kCorrelatedRows - 1);
  EXPECT_GT(*stated.estimates[0].standard_error, 1.2 * *ignored.estimates[0].standard_error);
  const auto document = testing::parse_json(measurement_json(stated));
  EXPECT_EQ(document.at("correlation_time_s"), kTau_s);
  EXPECT_EQ(document.at("residuals").at(5).at("whitened"), *stated.residuals[5].whitened);
  EXPECT_TRUE(testing::parse_json(measurement_json(ignored)).at("correlation_time_s").is_null());
}

/// Rows far closer than their errors last: what is not stated is noticed.
TEST_F(CorrelatedMeasurement, CorrelationThatIsNotStatedIsNoted) {
  std::vector<double> times;
  for (int k = 0; k < 100; ++k) times.push_back(0.2 * kTau_s * k);
  Normal normal(12);
  const std::vector<double> errors = correlated_errors(times, normal);
  const auto notes_of = [&](const std::vector<double>& list, double tau_s) {
    MeasurementOptions options;
    options.correlation_time_s = tau_s;
    std::string notes;
    for (const std::string& note : compare_with_measurement(shipped("free-gyro"), {}, read(csv_of(times, list)), options).notes)
      notes += note;
    return notes;
  };
  EXPECT_NE(notes_of(errors, 0).find("neighbouring residuals of azimuth are alike"), std::string::npos);
  EXPECT_EQ(notes_of(errors, kTau_s), "");
  std::vector<double> independent;
  for (std::size_t k = 0; k < times.size(); ++k) independent.push_back(error_of_row(k) * normal());
  EXPECT_EQ(notes_of(independent, 0), "");
}

}  // namespace
}  // namespace earthtop
