// SPDX-License-Identifier: GPL-3.0-or-later
// Simulated measurements: the same bytes for one seed on every machine, in the format that compare reads, with the errors that
// were asked for.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "earthtop/plan/plan.hpp"
#include "plan/plans.hpp"
#include "support/temporary_directory.hpp"

namespace earthtop {
namespace {

using testing::plan_for, testing::shipped;

std::vector<MeasurementResidual> residuals_of(const MeasurementPlan& plan, std::uint64_t seed, const Overrides& set = {}) {
  const testing::TemporaryDirectory directory;
  const std::string file = (directory.path() / "simulated.csv").string();
  std::ofstream(file, std::ios::binary) << *simulated_measurement(shipped("free-gyro"), set, plan, seed);
  return compare_with_measurement(shipped("free-gyro"), set, read_measurement(file), {}).residuals;
}

/// A top on a table is planned by the same motions that a fit computes: the standard errors are those of the fit.
TEST(PlanData, OfATopOnATableIsFittedAsPlanned) {
  MeasurementPlan plan = plan_for("axis_deg", 1e-5, 0.25, 2);
  plan.estimates = {"/contact/friction_coefficient", "tilt_deg"};
  const auto source = shipped("toy-top-on-table");
  const PlanReport planned = plan_measurement(source, {}, plan);
  const testing::TemporaryDirectory directory;
  const std::string file = (directory.path() / "simulated.csv").string();
  std::ofstream(file, std::ios::binary) << *simulated_measurement(source, {}, plan, 3);
  const MeasurementReport fit = compare_with_measurement(source, {}, read_measurement(file), {plan.estimates});
  ASSERT_EQ(fit.fit, FitOutcome::converged) << fit.fit_reason;
  for (std::size_t j = 0; j < 2; ++j) {
    // The derivatives at the estimate differ from those at the truth by some of its error.
    EXPECT_NEAR(*fit.estimates[j].standard_error / *planned.estimates[j].standard_error, 1, 1e-3);
    EXPECT_LT(std::abs(*fit.estimates[j].estimate - planned.estimates[j].value), 4 * *planned.estimates[j].standard_error);
  }
}

TEST(PlanData, OneSeedGivesTheSameBytesEverywhere) {
  const MeasurementPlan plan = plan_for({{"azimuth_deg", 0.01}, {"axis_arcsec", 20}}, 20, 60);
  const std::string csv = *simulated_measurement(shipped("free-gyro"), {}, plan, 7);
  EXPECT_EQ(csv,
            "# simulated by earthtop plan: free-gyro, seed 7, correlation time 0 s\n"
            "t_s,azimuth_deg,azimuth_se_deg,axis_L_x,axis_L_y,axis_L_z,axis_se_arcsec\n"
            "0,90.00713029833888,0.01,0.999999987546487,-0.00015616394641024484,2.2800166648880993e-05,20\n"
            "20,90.04608613573028,0.01,0.9999990370748661,-0.0010963472927935478,0.000850806649118924,20\n"
            "40,90.12308810930892,0.01,0.9999957401877927,-0.0020305119023461366,0.002096813697870482,20\n"
            "60,90.16111451278903,0.01,0.999990368732209,-0.0030525363189223497,0.0031534845556101866,20\n");
  EXPECT_NE(csv, *simulated_measurement(shipped("free-gyro"), {}, plan, 8));
}

TEST(PlanData, ErrorsAreNormalAndAsLargeAsStated) {
  const auto residuals = residuals_of(plan_for({{"azimuth_deg", 0.01}, {"tilt_rad", 1e-4}, {"axis_arcsec", 20}}, 0.1, 200), 3);
  ASSERT_EQ(residuals.size(), 4 * 2001u);
  for (const std::string_view name : {"azimuth", "tilt", "axis_tilt", "axis_azimuth"}) {
    double n = 0, sum = 0, squares = 0, within = 0;
    for (const MeasurementResidual& residual : residuals) {
      if (residual.quantity != name) continue;
      ++n;
      sum += residual.normalised();
      squares += residual.normalised() * residual.normalised();
      within += std::abs(residual.normalised()) < 1 ? 1 : 0;
    }
    EXPECT_EQ(n, 2001) << name;
    EXPECT_NEAR(sum / n, 0, 4 / std::sqrt(n)) << name;
    EXPECT_NEAR(squares / n, 1, 4 * std::sqrt(2 / n)) << name;
    EXPECT_NEAR(within / n, std::erf(1 / std::sqrt(2)), 4 * std::sqrt(0.2166 / n)) << name;  // p (1 - p) = 0.2166
  }
}

TEST(PlanData, CorrelatedErrorsHaveTheirTime) {
  MeasurementPlan plan = plan_for({{"azimuth_deg", 0.01}, {"tilt_rad", 1e-4}}, 0.5, 2000);
  plan.correlation_time_s = 1;
  const auto residuals = residuals_of(plan, 5);
  for (const std::size_t first : {0u, 1u}) {
    double n = 0, square = 0, next = 0, after = 0, other = 0;
    for (std::size_t i = first; i + 4 < residuals.size(); i += 2) {
      const double e = residuals[i].normalised();
      ++n;
      square += e * e;
      next += e * residuals[i + 2].normalised();
      after += e * residuals[i + 4].normalised();
      other += e * residuals[first == 0 ? i + 1 : i - 1].normalised();
    }
    // 4,000 rows are worth 4,000 tanh(1/4) independent ones, and each mean of products scatters by at most sqrt(2) of these.
    const double slack = 4 * std::sqrt(2 / (n * std::tanh(0.25)));
    EXPECT_NEAR(square / n, 1, slack);
    EXPECT_NEAR(next / n, std::exp(-0.5), slack);
    EXPECT_NEAR(after / n, std::exp(-1.0), slack);
    EXPECT_NEAR(other / n, 0, slack);
  }
}

TEST(PlanData, AzimuthsAreWithinATurnAndTiltsAtMostHalfATurn) {
  const Overrides set = {{"/release/azimuth_deg", "0"}, {"/release/tilt_deg", "179.999"}};
  for (const MeasurementResidual& residual : residuals_of(plan_for({{"azimuth_deg", 1}, {"tilt_deg", 0.1}}, 1, 100), 1, set)) {
    EXPECT_GE(residual.measured, 0);
    EXPECT_LE(residual.measured, residual.quantity == "azimuth" ? 6.2832 : 3.1416);
  }
}

}  // namespace
}  // namespace earthtop
