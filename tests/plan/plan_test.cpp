// SPDX-License-Identifier: GPL-3.0-or-later
// Plans of measurements whose standard errors are known in closed form: the axis of a balanced gyroscope, released level towards
// East, keeps its direction in inertial space, so that in the laboratory its azimuth grows by Omega sin(latitude) t.
#include "earthtop/plan/plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

#include "earthtop/report/report.hpp"
#include "plan/plans.hpp"
#include "support/json.hpp"
#include "support/temporary_directory.hpp"
#include "support/tolerances.hpp"

namespace earthtop {
namespace {

using testing::plan_for, testing::shipped;

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kOmega = 7.292115e-5;  // rad/s
const double kVertical45 = kOmega * std::sin(45 * kDegree);
/// The closed forms leave out terms of second order in the angle by which the Earth turns in a minute.
constexpr double kSecondOrder = kOmega * 120 * kOmega * 120;
/// The differences that make the derivatives: prediction errors of 1e-11 rad in changes of some 1e-6 rad (see fit_weighted).
constexpr double kDifferences = 1e-5;

const PlanVariation& variation(const PlanReport& report, PlanChange change, double factor) {
  const auto found = std::find_if(report.variations.begin(), report.variations.end(),
                                  [&](const PlanVariation& v) { return v.change == change && v.factor == factor; });
  if (found == report.variations.end()) throw std::runtime_error("no such variation");
  return *found;
}

/// Sum of (k T)^2 over n rows, k from 0.
double sum_of_squares(double every_s, double n) { return every_s * every_s * (n - 1) * n * (2 * n - 1) / 6; }

TEST(Plan, ABalancedGyroscopesVerticalRate) {
  const double sigma = 0.01 * kDegree;
  const PlanReport report = plan_measurement(shipped("free-gyro"), {}, plan_for("azimuth_deg", 0.01, 0.5, 60));
  ASSERT_EQ(report.outcome, PlanOutcome::determined);
  EXPECT_EQ(report.rows, 121u);
  EXPECT_EQ(report.values, 121u);
  ASSERT_EQ(report.estimates.size(), 1u);
  EXPECT_EQ(report.estimates[0].name, "omega_sin_latitude_rad_s");
  const double expected = sigma / std::sqrt(sum_of_squares(0.5, 121));
  const double tolerance = (kSecondOrder + kDifferences) * expected;
  EXPECT_NEAR(*report.estimates[0].standard_error, expected, tolerance);
  EXPECT_NEAR(*report.estimates[0].significance(), kVertical45 / expected,
              (kSecondOrder + kDifferences) * kVertical45 / expected);
  // How it falls: exactly as the sums do.
  EXPECT_NEAR(*variation(report, PlanChange::duration, 0.5).standard_error, sigma / std::sqrt(sum_of_squares(0.5, 61)),
              4 * tolerance);
  EXPECT_NEAR(*variation(report, PlanChange::duration, 2).standard_error, sigma / std::sqrt(sum_of_squares(0.5, 241)),
              tolerance);
  EXPECT_NEAR(*variation(report, PlanChange::rows, 4).standard_error, sigma / std::sqrt(sum_of_squares(0.125, 481)), tolerance);
  EXPECT_NEAR(*variation(report, PlanChange::rows, 0.25).standard_error, sigma / std::sqrt(sum_of_squares(2, 31)),
              3 * tolerance);
  EXPECT_NEAR(*variation(report, PlanChange::sigma, 0.25).standard_error, expected / 4, tolerance);
  EXPECT_EQ(variation(report, PlanChange::duration, 2).rows, 241u);
  EXPECT_EQ(variation(report, PlanChange::rows, 4).rows, 481u);
  // Twice as long means 2^1.5 times smaller an error, more than any other change.
  EXPECT_EQ(report.changes.at(0).change, PlanChange::duration);
  EXPECT_NE(
      report.advice.find("measure 2 times as long, to 120 s: the standard error of omega_sin_latitude_rad_s would be 2.8"),
      std::string::npos)
      << report.advice;
}

/// With the azimuth at the release fitted along, it is the fit of a straight line: a textbook's formulas.
TEST(Plan, AStraightLineWithUnknownOffset) {
  MeasurementPlan plan = plan_for("azimuth_rad", 1e-4, 0.5, 60);
  plan.nuisances = {"/release/azimuth_deg"};
  const PlanReport report = plan_measurement(shipped("free-gyro"), {}, plan);
  ASSERT_EQ(report.outcome, PlanOutcome::determined);
  const double n = 121, slope = 1e-4 / (0.5 * std::sqrt(n * (n * n - 1) / 12));
  const double mean = 30, square = sum_of_squares(0.5, n) / n, offset = 1e-4 * std::sqrt(square / (square - mean * mean) / n);
  const double relative = kSecondOrder + kDifferences;
  EXPECT_NEAR(*report.estimates[0].standard_error, slope, 2 * relative * slope);
  EXPECT_NEAR(*report.estimates[1].standard_error, offset / kDegree, 2 * relative * offset / kDegree);
  EXPECT_TRUE(report.estimates[1].is_nuisance);
  EXPECT_NEAR(report.correlation[0][1], -mean / std::sqrt(square), 2 * relative);
  // This computes what the offset costs, and what a better knowledge of it would be worth: a prior adds its information.
  const double alone = 1e-4 / std::sqrt(n * square);
  EXPECT_NEAR(*report.estimates[0].standard_error_alone, alone, 2 * relative * alone);
  EXPECT_EQ(report.variations.at(0).change, PlanChange::known);
  EXPECT_EQ(report.variations.at(0).input, "/release/azimuth_deg");
  EXPECT_NEAR(*report.variations.at(0).standard_error, alone, 8 * relative * alone);
  const auto prior = std::find_if(report.changes.begin(), report.changes.end(),
                                  [](const PlanVariation& change) { return change.change == PlanChange::prior; });
  ASSERT_NE(prior, report.changes.end());
  const double known = prior->input_error * kDegree;
  EXPECT_NEAR(known, offset / 3, 2 * relative * offset);
  const double information = n / 1e-8 + 1 / (known * known);
  const double better = 1 / std::sqrt(n * square / 1e-8 - std::pow(n * mean / 1e-8, 2) / information);
  EXPECT_NEAR(*prior->standard_error, better, 8 * relative * better);
}

/// A stated uncertainty is a prior on an input that is fitted along.
TEST(Plan, StatedUncertaintiesArePriors) {
  const Overrides set = {{"/uncertainty", R"({"tilt_deg": 0.02, "latitude_deg": 1})"}};
  MeasurementPlan plan = plan_for("tilt_deg", 0.01, 1, 100);
  plan.estimates = {"tilt_deg"};
  const PlanReport report = plan_measurement(shipped("free-gyro"), set, plan);
  ASSERT_EQ(report.outcome, PlanOutcome::determined);
  ASSERT_EQ(report.estimates.size(), 2u);
  EXPECT_EQ(*report.estimates[0].prior, 0.02);
  EXPECT_EQ(report.estimates[1].name, "latitude_deg");
  EXPECT_TRUE(report.estimates[1].is_nuisance);
  EXPECT_EQ(*report.estimates[1].prior, 1);
  // The tilt grows by Omega cos(latitude) t: a column of ones, and one of -Omega sin(latitude) t a radian of latitude.
  const double sigma = 0.01 * kDegree, of_tilt = 0.02 * kDegree, of_latitude = 1 * kDegree;
  double a = 1 / (of_tilt * of_tilt), b = 0, c = 1 / (of_latitude * of_latitude);
  for (int t = 0; t <= 100; ++t) {
    const double slope = -kVertical45 * t;
    a += 1 / (sigma * sigma);
    b += slope / (sigma * sigma);
    c += slope * slope / (sigma * sigma);
  }
  const double expected = std::sqrt(c / (a * c - b * b)) / kDegree;
  EXPECT_NEAR(*report.estimates[0].standard_error, expected, 0.01 * expected);  // and terms of first order in the turn, 0.007
  // The vertical rate stands for the latitude, whose uncertainty says how well that rate is known.
  const PlanReport rate = plan_measurement(shipped("free-gyro"), set, plan_for("azimuth_deg", 0.01, 1, 100));
  ASSERT_EQ(rate.estimates.size(), 2u);
  EXPECT_EQ(rate.estimates[1].name, "tilt_deg");
  ASSERT_EQ(rate.notes.size(), 1u);
  EXPECT_EQ(rate.notes[0],
            "the stated uncertainty of latitude_deg says how well omega_sin_latitude_rad_s is known; it is no datum");
  constexpr double kProduct = 1e-6;  // far above the rounding of a product, and far below an error of the rate's own
  EXPECT_NEAR(rate.estimates[0].finding->known.standard_error, kVertical45 * kDegree, kProduct * kVertical45 * kDegree);
}

/// The spin may be given as a rate about body axis 3; a quaternion has no tilt that could be changed.
TEST(Plan, UncertaintiesOfOtherFormsOfTheRelease) {
  const Overrides set = {
      {"/release", R"({"quaternion_LB": {"w": 0.8, "x": 0.6, "y": 0, "z": 0}, "angular_velocity_body_rad_s": [0, 0, 200]})"},
      {"/uncertainty", R"({"spin_rad_s": 0.5, "tilt_deg": 0.1})"}};
  const PlanReport report = plan_measurement(shipped("toy-top"), set, plan_for("axis_deg", 0.01, 0.1, 5));
  ASSERT_EQ(report.estimates.size(), 2u);
  EXPECT_EQ(report.estimates[1].name, "/release/angular_velocity_body_rad_s/2");
  EXPECT_EQ(*report.estimates[1].prior, 0.5);
  ASSERT_EQ(report.notes.size(), 1u);
  EXPECT_NE(report.notes[0].find("uncertainty of tilt_deg is not used"), std::string::npos);
}

/// Only the product of a top's spin and inertia ratio, its angular momentum, is seen. Where a prior tells them apart, the Earth's
/// rate is seen as well as if the ratio were known exactly.
TEST(Plan, APriorTellsApartWhatTheDataDoNot) {
  MeasurementPlan plan = plan_for("axis_deg", 0.01, 0.1, 20);
  plan.nuisances = {"spin_rad_s"};
  const auto source = shipped("toy-top");
  const PlanReport known = plan_measurement(source, {}, plan);
  const PlanReport report = plan_measurement(source, {{"/uncertainty/inertia_ratio", "0.01"}}, plan);
  ASSERT_EQ(report.outcome, PlanOutcome::determined) << report.reason;
  EXPECT_NEAR(*report.estimates[0].standard_error, *known.estimates[0].standard_error,
              testing::rounding(1e6) * *known.estimates[0].standard_error);
  EXPECT_NEAR(*report.estimates[1].standard_error, 200 * 0.01 * 3, 0.01 * 6);  // 3 % of the ratio are 3 % of the spin
  EXPECT_NEAR(*report.estimates[2].standard_error, 0.01, testing::rounding(4));
  EXPECT_NEAR(report.correlation[1][2], -1, 1e-6);
  // Also where the data count for much more than the prior.
  for (const double factor : {1.0, 0.25})
    EXPECT_NEAR(*variation(report, PlanChange::sigma, factor).standard_error, factor * *known.estimates[0].standard_error,
                testing::rounding(1e6) * *known.estimates[0].standard_error);
  MeasurementPlan fine = plan;
  fine.quantities[0] = planned_quantity("axis_deg", 1e-5);
  const PlanReport finer = plan_measurement(source, {{"/uncertainty/inertia_ratio", "0.5"}}, fine);
  ASSERT_EQ(finer.outcome, PlanOutcome::determined) << finer.reason;
  EXPECT_NEAR(*finer.estimates[0].standard_error, 1e-3 * *known.estimates[0].standard_error,
              testing::rounding(1e3) * *known.estimates[0].standard_error);
  plan.nuisances.emplace_back("inertia_ratio");
  EXPECT_EQ(plan_measurement(source, {}, plan).outcome, PlanOutcome::not_determined);
}

/// Correlated errors: what is new in a value beside the one before it.
TEST(Plan, CorrelatedErrors) {
  MeasurementPlan plan = plan_for("azimuth_rad", 1e-4, 0.5, 60);
  plan.correlation_time_s = 2;
  const PlanReport report = plan_measurement(shipped("free-gyro"), {}, plan);
  const double rho = std::exp(-0.25);
  double information = 0;
  for (int k = 1; k <= 120; ++k) information += std::pow(0.5 * k - rho * 0.5 * (k - 1), 2) / (1 - rho * rho) * 1e8;
  const double expected = 1 / std::sqrt(information);
  EXPECT_NEAR(*report.estimates[0].standard_error, expected, (kSecondOrder + kDifferences) * expected);
  // More rows in the same time add little: halving their distance many times over leaves a limit.
  EXPECT_GT(*variation(report, PlanChange::rows, 4).standard_error, 0.97 * expected);
}

/// Two quantities, and an axis, which has two components: their information adds up.
TEST(Plan, SeveralQuantities) {
  MeasurementPlan plan = plan_for("azimuth_rad", 1e-4, 1, 60);
  plan.quantities.push_back(planned_quantity("tilt_arcsec", 2e-4 / kDegree * 3600));
  plan.estimates = {"omega_cos_latitude_rad_s", "omega_sin_latitude_rad_s"};
  const PlanReport report = plan_measurement(shipped("free-gyro"), {}, plan);
  ASSERT_EQ(report.outcome, PlanOutcome::determined);
  EXPECT_EQ(report.values, 122u);
  const double root = std::sqrt(sum_of_squares(1, 61));
  EXPECT_NEAR(*report.estimates[0].standard_error, 2e-4 / root, 1e-4 / root * 1e-2);  // terms of first order in the turn, 0.004
  EXPECT_NEAR(*report.estimates[1].standard_error, 1e-4 / root, 1e-4 / root * 1e-2);
  EXPECT_NEAR(report.estimates[0].value, kOmega * std::cos(45 * kDegree), 1e-15 * kOmega);
  MeasurementPlan axis = plan_for("axis_rad", 1e-4, 1, 60);
  axis.estimates = plan.estimates;
  const PlanReport whole = plan_measurement(shipped("free-gyro"), {}, axis);
  EXPECT_EQ(whole.values, 122u);
  for (const PlannedEstimate& estimate : whole.estimates)
    EXPECT_NEAR(*estimate.standard_error, 1e-4 / root, 1e-4 / root * 1e-2);
}

/// A gyrocompass feels the northward component only, and only its product with the spin.
TEST(Plan, WhatIsNotDeterminedIsNamed) {
  const Overrides set = {{"/release/azimuth_deg", "5"}, {"/site/latitude_deg", "45"}};
  const auto source = shipped("hard/t08-gyrocompass");
  MeasurementPlan plan = plan_for("azimuth_deg", 0.01, 0.1, 30);
  EXPECT_EQ(plan_measurement(source, set, plan).estimates.at(0).name, "omega_cos_latitude_rad_s");
  plan.estimates = {"omega_sin_latitude_rad_s"};
  const PlanReport vertical = plan_measurement(source, set, plan);
  EXPECT_EQ(vertical.outcome, PlanOutcome::not_determined);
  EXPECT_EQ(vertical.reason, "these data would not determine omega_sin_latitude_rad_s");
  EXPECT_FALSE(vertical.estimates[0].standard_error);
  plan.estimates = {"omega_cos_latitude_rad_s"};
  plan.nuisances = {"spin_rad_s", "/release/azimuth_deg"};
  const PlanReport product = plan_measurement(source, set, plan);
  EXPECT_EQ(product.outcome, PlanOutcome::not_determined);
  EXPECT_EQ(product.reason, "these data would not tell apart omega_cos_latitude_rad_s, spin_rad_s");
  ASSERT_EQ(product.undetermined.size(), 2u);
  // Their product stays: the relative changes are opposite.
  const double rate = kOmega * std::cos(45 * kDegree), spin = 628.3185307179587;
  EXPECT_NEAR(product.undetermined[0].second / rate, -product.undetermined[1].second / spin, std::sqrt(testing::rounding(2)));
  EXPECT_TRUE(testing::parse_json(plan_json(product)).at("estimates").at(0).at("standard_error").is_null());
  // Together with a prior on the spin they are.
  const Overrides known = {set[0], set[1], {"/uncertainty", R"({"spin_rad_s": 0.6283185307179587})"}};
  plan.nuisances = {"/release/azimuth_deg"};
  const PlanReport with_prior = plan_measurement(source, known, plan);
  ASSERT_EQ(with_prior.outcome, PlanOutcome::determined);
  // A thousandth of the spin leaves a thousandth of the rate, and what the azimuths add.
  EXPECT_NEAR(*with_prior.estimates[0].significance(), 1000, 10);
}

/// The tilt of a balanced gyroscope grows by Omega cos(latitude) sin(azimuth) t: towards East is best, and later is better.
TEST(Plan, TheBestReleaseAndDuration) {
  MeasurementPlan plan = plan_for("tilt_rad", 1e-5, 1, 30);
  plan.estimates = {"omega_cos_latitude_rad_s"};
  const Overrides set = {{"/release/azimuth_deg", "30"}, {"/motion/duration_s", "30"}};
  const std::vector<DesignInput> design = {design_input("/release/azimuth_deg=20:150"),
                                           design_input("/motion/duration_s=10:50")};
  const PlanReport report = plan_measurement(shipped("free-gyro"), set, plan, design);
  ASSERT_TRUE(report.optimum);
  const PlanOptimum& optimum = *report.optimum;
  EXPECT_NEAR(optimum.choices[0].best, 90, 1);  // at 1 deg from it the error is 1.00015 times as large
  EXPECT_FALSE(optimum.choices[0].is_at_limit);
  EXPECT_EQ(optimum.choices[0].given, 30);
  EXPECT_EQ(optimum.choices[1].best, 50);
  EXPECT_TRUE(optimum.choices[1].is_at_limit);
  EXPECT_EQ(optimum.rows, 51u);
  const double expected = 1e-5 / std::sqrt(sum_of_squares(1, 51));
  EXPECT_NEAR(optimum.standard_error, expected, 3e-4 * expected);
  EXPECT_NEAR(*report.estimates[0].standard_error, 1e-5 / std::sqrt(sum_of_squares(1, 31)) / 0.5, 1e-2 * expected * 8);
  EXPECT_GT(optimum.evaluations, 25);
  EXPECT_EQ(optimum.avoided, 0);
}

/// A steady precession exists above the critical spin only: slower tops are avoided.
TEST(Plan, DesignsWithoutAMotionAreAvoided) {
  MeasurementPlan plan = plan_for("tilt_deg", 0.01, 0.1, 2);
  const PlanReport report =
      plan_measurement(shipped("steady-precession-slow"), {}, plan, {design_input("/release/spin_rad_s=20:300")});
  ASSERT_TRUE(report.optimum);
  EXPECT_GT(report.optimum->avoided, 0);
  // The critical spin is 2 sqrt(m g l I1 cos(tilt)) / I3.
  const double critical = 2 * std::sqrt(0.2 * 9.8127 * 0.05 * 6e-4 * std::cos(50 * kDegree)) / 1.6e-4;
  EXPECT_GT(report.optimum->choices[0].best, critical * (1 - 1e-9));
}

TEST(Plan, RowsBeyondWhatCanBePredictedAreRefused) {
  try {
    MeasurementPlan plan = plan_for("tilt_deg", 1, 1, parse_scenario(shipped("hard/h11-chaotic")).duration_s);
    plan.estimates = {"gravity_m_s2"};
    plan_measurement(shipped("hard/h11-chaotic"), {}, plan);
    ADD_FAILURE();
  } catch (const ScenarioError& error) {
    EXPECT_NE(std::string(error.what()).find("chaotic"), std::string::npos) << error.what();
  }
}

TEST(Plan, RefusalsSayWhatInstead) {
  const auto refused = [](const auto& work, const std::string& words) {
    try {
      work();
      ADD_FAILURE() << words;
    } catch (const ScenarioError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  };
  for (const char* name : {"azimut_deg", "azimuth", "azimuth_se_deg", "_azimuth_deg", "t_s", "axis_L_x", "tilt_m", ""})
    refused([&] { planned_quantity(name, 1); }, "allowed are azimuth, tilt, axis");
  refused([] { planned_quantity("azimut_deg", 1); }, "did you mean azimuth_deg?");
  for (const double sigma : {0.0, -1.0, std::nan(""), HUGE_VAL})
    refused([&] { planned_quantity("tilt_deg", sigma); }, "above 0");
  const auto source = shipped("free-gyro");
  const auto with = [&](const auto& change, const std::vector<DesignInput>& design = {}) {
    MeasurementPlan plan = plan_for("azimuth_deg", 1, 1, 60);
    change(plan);
    return [=] { plan_measurement(source, {}, plan, design); };
  };
  refused(with([](auto& plan) { plan.quantities.clear(); }), "name what is measured");
  refused(with([](auto& plan) { plan.quantities.push_back(planned_quantity("azimuth_rad", 1)); }), "is measured already");
  refused(with([](auto& plan) { plan.every_s = 0; }), "--every: must be a time above 0 (s)");
  refused(with([](auto& plan) { plan.every_s = 61; }), "longer than the measurement");
  refused(with([](auto& plan) { plan.every_s = 1e-4; }), "take a longer one");
  refused(with([](auto& plan) { plan.until_s = -1; }), "--until: must be a time above 0 (s)");
  refused(with([](auto& plan) { plan.correlation_time_s = -1; }), "--correlation-time: must be a time of at least 0 (s)");
  refused(with([](auto& plan) { plan.nuisances = {"spin"}; }), "did you mean");
  refused(with([](auto& plan) { plan.nuisances = {"latitude_deg"}; }), "stands for the rotation rate and the latitude");
  const auto same = [](auto&) {};
  refused(with(same, {design_input("/name=1:2")}), "not a number that can be chosen");
  refused(with(same, {design_input("/motion/output_step_s=1:2")}), "not a number that can be chosen");
  refused(with(same, {design_input("/release/tilt_deg=1:200")}), "a limit is not possible");
  refused(with(same, {design_input("/release/tilt_deg=1:2"), design_input("/release/tilt_deg=1:3")}), "given twice");
  refused(with(same, {design_input("/platform/rate_rad_s=1:2")}), "");
  for (const char* text : {"", "/a", "/release/tilt_deg=5", "/release/tilt_deg=5:", "/release/tilt_deg=a:b",
                           "/release/tilt_deg=1:inf", "/release/tilt_deg=5:6:7"})
    refused([&] { design_input(text); }, "LOW:HIGH");
  refused([] { design_input("/release/tilt_deg=6:5"); }, "below the second");
  const Overrides one_step = {{"/numerics", R"({"method": "gauss", "step_s": 1})"}, {"/motion/output_step_s", "1"}};
  refused([&] { simulated_measurement(shipped("toy-top"), one_step, plan_for("tilt_deg", 1, 1, 2), 1); },
          "--write-data: the scenario's motion ended with not_converged");
  // A vertical axis has no azimuth.
  refused([&] { plan_measurement(source, {{"/release/tilt_deg", "0"}}, plan_for("azimuth_deg", 1, 1, 10)); }, "has no azimuth");
}

TEST(Plan, TheDocumentAndThePictureHaveEverything) {
  MeasurementPlan plan = plan_for("azimuth_deg", 0.01, 1, 20);
  plan.nuisances = {"/release/azimuth_deg"};
  const PlanReport report = plan_measurement(shipped("free-gyro"), {}, plan, {design_input("/motion/duration_s=10:50")});
  const auto document = testing::parse_json(plan_json(report));
  EXPECT_EQ(document.at("$schema"), "earthtop-plan-1.json");
  EXPECT_EQ(document.at("scenario").at("name"), "free-gyro");
  EXPECT_EQ(document.at("plan").at("rows"), 21);
  EXPECT_EQ(document.at("plan").at("quantities").at(0).at("name"), "azimuth_deg");
  EXPECT_EQ(document.at("outcome"), "determined");
  EXPECT_EQ(document.at("estimates").at(0).at("standard_error"), *report.estimates[0].standard_error);
  EXPECT_EQ(document.at("estimates").at(1).at("nuisance"), true);
  EXPECT_EQ(document.at("correlation").at(0).at(0), 1);
  EXPECT_EQ(document.at("variations").size(), report.variations.size());
  EXPECT_EQ(document.at("advice"), report.advice);
  EXPECT_EQ(document.at("optimum").at("choices").at(0).at("at_limit"), true);
  const testing::TemporaryDirectory directory;
  const std::string file = (directory.path() / "plan.json").string();
  std::ofstream(file, std::ios::binary) << plan_json(report);
  const Report page = make_report(file);
  EXPECT_NE(page.html.find("Planned measurement of free-gyro"), std::string::npos);
  EXPECT_NE(page.html.find("/motion/duration_s"), std::string::npos);
  ASSERT_EQ(page.pictures.size(), 1u);
  // The document says all that the picture shows: the two differ in the ids of their parts only.
  Figure shown = plan_figure(report);
  shown.id = "changes";
  EXPECT_EQ(page.pictures[0].second, svg(shown));
  const Figure figure = plan_figure(report);
  ASSERT_EQ(figure.panels.size(), 1u);
  ASSERT_EQ(figure.panels[0].lines.size(), 4u);
  for (const Line& line : figure.panels[0].lines) EXPECT_GE(line.x.size(), 2u) << line.label;
}

TEST(Plan, StopsWhenAsked) {
  const std::atomic<bool> stop = true;
  const PlanReport report = plan_measurement(shipped("toy-top"), {}, plan_for("tilt_deg", 0.01, 0.1, 60), {}, Watch(&stop));
  EXPECT_EQ(report.outcome, PlanOutcome::interrupted);
  EXPECT_FALSE(simulated_measurement(shipped("toy-top"), {}, plan_for("tilt_deg", 0.01, 0.1, 60), 1, Watch(&stop)));
}

}  // namespace
}  // namespace earthtop
