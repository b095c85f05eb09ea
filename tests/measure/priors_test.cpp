// SPDX-License-Identifier: GPL-3.0-or-later
// Tests what a scenario's uncertainty block adds to a fit.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "earthtop/plan/plan.hpp"
#include "measure/made_up_measurements.hpp"
#include "support/json.hpp"

namespace earthtop {
namespace {

using namespace test;

class Priors : public MeasurementTest {
 protected:
  /// The azimuths of a free gyroscope on an Earth that turns faster by `more`; nothing else is measured.
  Measurement faster_earth(double more) const {
    std::string csv = "t_s,azimuth_rad,azimuth_se_rad\n";
    for (int i = 1; i <= 10; ++i)
      csv += fmt::format("{},{},1e-5\n", 6 * i,
                         azimuth(free_axis(kEast, (1 + more) * kNorthward45, (1 + more) * kVertical45, 6.0 * i)));
    return read(csv);
  }
  static Overrides with(const std::string& uncertainty) { return {{"/uncertainty", uncertainty}}; }
};

// A straight line y = a x is fitted, with the error s and the prior 0 +- p of a: the weights of both add, and chi-squared at the
// best value a0 / (1 + s^2 / p^2 / sum x^2) has the prior's square, too.
TEST_F(Priors, WeighAsDataDo) {
  const Measurement data = faster_earth(0.02);
  const MeasurementOptions alone{.estimates = {"rotation_rate_rad_s"}};
  const auto free = compare_with_measurement(shipped("free-gyro"), {}, data, alone);
  ASSERT_TRUE(free.fitted);
  const double s = *free.estimates[0].standard_error, p = 0.7 * s;
  const auto bound = compare_with_measurement(shipped("free-gyro"), with(fmt::format("{{\"rotation_rate_rad_s\": {}}}", p)),
                                              data, {.estimates = {"rotation_rate_rad_s"}, .priors = true});
  ASSERT_TRUE(bound.fitted);
  const double w = 1 / (s * s), v = 1 / (p * p), moved = *free.estimates[0].estimate - kOmega;
  const double rate = kOmega + moved * w / (w + v);
  // What is not linear is of the square of the turn within the minute, some 0.005, times the change of the rate.
  const double curved = std::pow(0.005, 2) * 0.02;
  EXPECT_NEAR(*bound.estimates[0].estimate, rate, curved * std::abs(moved));
  EXPECT_NEAR(*bound.estimates[0].standard_error, 1 / std::sqrt(w + v), 1e-4 * s);
  ASSERT_EQ(bound.priors.size(), 1u);
  EXPECT_NEAR(*bound.priors[0].pull, (rate - kOmega) / p, curved * std::abs(moved) / p);
  EXPECT_EQ(bound.priors[0].mean, kOmega);
  EXPECT_EQ(bound.fitted->of_priors, *bound.priors[0].pull * *bound.priors[0].pull);
  EXPECT_NEAR(bound.fitted->value, moved * moved / (s * s + p * p), 0.02 * moved * moved / (s * s));
  EXPECT_EQ(bound.fitted->degrees_of_freedom, 10) << "ten values and a prior, less an estimate";
  EXPECT_EQ(free.fitted->degrees_of_freedom, 9);
  EXPECT_EQ(bound.as_given.degrees_of_freedom, 10) << "nothing is fitted, and the prior's residual is 0 by its meaning";
}

TEST_F(Priors, DetermineWhatTheDataDoNot) {
  const Measurement data = faster_earth(0);
  const MeasurementOptions both{.estimates = {"rotation_rate_rad_s", "latitude_deg"}, .priors = true};
  EXPECT_EQ(compare_with_measurement(shipped("free-gyro"), {}, data, {.estimates = both.estimates}).fit,
            FitOutcome::not_determined);
  const auto report = compare_with_measurement(shipped("free-gyro"), with(R"({"latitude_deg": 0.5})"), data, both);
  ASSERT_TRUE(report.fitted) << report.fit_reason;
  EXPECT_NEAR(*report.estimates[1].standard_error, 0.5, 1e-3) << "the prior's alone";
  EXPECT_EQ(report.fitted->degrees_of_freedom, 9);
  // An input without any influence on the data is its prior, exactly. The spin of a balanced gyroscope is one.
  const auto idle = compare_with_measurement(shipped("free-gyro"), with(R"({"tilt_deg": 0.1, "gravity_m_s2": 0.25})"), data,
                                             {.estimates = {"rotation_rate_rad_s", "gravity_m_s2"}, .priors = true});
  ASSERT_TRUE(idle.fitted) << idle.fit_reason;
  EXPECT_NEAR(*idle.estimates[1].standard_error, 0.25, 1e-9);
  ASSERT_EQ(idle.unused_priors.size(), 1u);
  EXPECT_EQ(idle.unused_priors[0].name, "tilt_deg");
  EXPECT_NE(idle.unused_priors[0].reason.find("--estimate tilt_deg"), std::string::npos);
}

TEST_F(Priors, OfMomentsAndCentreAreMapped) {
  const auto source = shipped("toy-top");
  const Measurement data = read("t_s,tilt_deg,tilt_se_deg\n0.5,20,1\n1,20,1\n1.5,20,1\n");
  const Overrides set = with(R"({"inertia_ratio": 0.01, "center_of_mass_m": 1e-4})");
  const auto report =
      compare_with_measurement(source, set, data, {.estimates = {"/body/inertia/principal_kg_m2/2"}, .priors = true});
  ASSERT_EQ(report.fit, FitOutcome::converged) << report.fit_reason;
  ASSERT_EQ(report.priors.size(), 1u);
  EXPECT_EQ(report.priors[0].name, "inertia_ratio");
  EXPECT_NEAR(report.priors[0].standard_error, 0.01 * 1.2e-4, 1e-15);  // I1 is 1.2e-4 kg m^2
  const auto moved = compare_with_measurement(
      source, set, data, {.estimates = {"/body/inertia/principal_kg_m2/2", "/body/center_of_mass_m/2"}, .priors = true});
  for (const Prior& prior : moved.priors) EXPECT_EQ(prior.name, "center_of_mass_m") << "I1 may move with the centre";
}

TEST_F(Priors, AreReported) {
  const auto report = compare_with_measurement(shipped("free-gyro"), with(R"({"rotation_rate_rad_s": 1e-6, "tilt_deg": 1})"),
                                               faster_earth(0.01), {.estimates = {"rotation_rate_rad_s"}, .priors = true});
  const auto document = testing::parse_json(measurement_json(report));
  EXPECT_EQ(document.at("priors").at(0).at("input"), "rotation_rate_rad_s");
  EXPECT_EQ(document.at("priors").at(0).at("pull"), *report.priors[0].pull);
  EXPECT_EQ(document.at("chi_squared").at("fitted").at("of_priors"), report.fitted->of_priors);
  EXPECT_EQ(document.at("unused_priors").at(0).at("name"), "tilt_deg");
}

/// A prior that counts for a ten millionth of the data tells a top's spin from its ratio of moments, of which the data see only the
/// product: in a fit as in a plan.
TEST_F(Priors, DetermineInAFitWhatTheyDetermineInAPlan) {
  MeasurementPlan plan;
  plan.quantities = {planned_quantity("axis_deg", 1e-5)};
  plan.every_s = 0.2;
  plan.until_s = 20;
  plan.nuisances = {"spin_rad_s"};
  const Overrides known = {{"/uncertainty/inertia_ratio", "0.5"}};
  const PlanReport planned = plan_measurement(shipped("toy-top"), known, plan);
  ASSERT_EQ(planned.outcome, PlanOutcome::determined) << planned.reason;
  MeasurementOptions options{.estimates = {}, .priors = true};
  for (const PlannedEstimate& estimate : planned.estimates) options.estimates.push_back(estimate.name);
  const auto data = simulated_measurement(shipped("toy-top"), known, plan, 3);
  ASSERT_TRUE(data);
  const auto report = compare_with_measurement(shipped("toy-top"), known, read(*data), options);
  ASSERT_TRUE(report.fitted) << report.fit_reason;
  ASSERT_EQ(report.estimates.size(), 3u);
  for (std::size_t j = 0; j < 3; ++j)
    EXPECT_NEAR(*report.estimates[j].standard_error, *planned.estimates[j].standard_error,
                1e-5 * *planned.estimates[j].standard_error);  // the fit stops a thousandth of an error from its minimum
  EXPECT_LT(std::abs(*report.estimates[0].estimate - report.estimates[0].start), 5 * *report.estimates[0].standard_error);
  options.priors = false;
  EXPECT_EQ(compare_with_measurement(shipped("toy-top"), known, read(*data), options).fit, FitOutcome::not_determined);
}

TEST_F(Priors, ThatCannotEnterAreRefused) {
  const Measurement data = faster_earth(0);
  EXPECT_THROW(compare_with_measurement(shipped("free-gyro"), {}, data, {.estimates = {"tilt_deg"}, .priors = true}),
               ScenarioError);
  EXPECT_THROW(compare_with_measurement(shipped("free-gyro"), with(R"({"tilt_deg": 1})"), data, {.priors = true}),
               ScenarioError);
}

}  // namespace
}  // namespace earthtop
