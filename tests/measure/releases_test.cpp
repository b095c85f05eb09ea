// SPDX-License-Identifier: GPL-3.0-or-later
/// Several releases in one fit and in one plan.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>

#include "earthtop/measure/releases_file.hpp"
#include "earthtop/plan/plan.hpp"
#include "measure/made_up_measurements.hpp"
#include "support/json.hpp"

namespace earthtop {
namespace {

using test::kDegree, test::shipped;

constexpr double kError_deg = 1e-4;

class ReleasesTest : public test::MeasurementTest {
 protected:
  /// Azimuths of a balanced gyroscope on an Earth that turns at `vertical`, read on a circle whose zero is wrong by `zero_deg`.
  Measurement azimuths(int rows, double vertical, double zero_deg, std::uint64_t seed, double noise = 1) const {
    std::string csv = "t_s,azimuth_deg,azimuth_se_deg\n";
    test::Normal normal(seed);
    for (int k = 0; k < rows; ++k) {
      const Vec3<double> n = test::free_axis(test::kEast, test::kNorthward45, vertical, 3.0 * k);
      csv += fmt::format("{},{:.17g},{}\n", 3 * k, test::azimuth(n) / kDegree + zero_deg + noise * kError_deg * normal(),
                         kError_deg);
    }
    return read(csv);
  }
  static MeasurementOptions wanted(std::vector<std::string> estimates, std::vector<std::string> shared) {
    MeasurementOptions options;
    options.estimates = std::move(estimates);
    options.shared = std::move(shared);
    return options;
  }
};

const ParameterEstimate& found(const FitReport& report, const std::string& name, std::size_t release) {
  for (const ParameterEstimate& estimate : report.estimates)
    if (estimate.name == name && estimate.release == release) return estimate;
  throw std::runtime_error("no estimate of " + name);
}

/// Azimuths grow with the vertical rate in proportion, nearly, and each circle has its own zero: the shared rate is the mean of the
/// rates that each release gives by itself, weighted by their information, and so is its error.
TEST_F(ReleasesTest, ASharedNumberIsTheWeightedMean) {
  const std::vector<MeasuredRelease> releases = {{shipped("free-gyro"), {}, azimuths(20, test::kVertical45, 0.3, 1)},
                                                 {shipped("free-gyro"), {}, azimuths(12, test::kVertical45, -0.2, 2)}};
  const std::vector<std::string> zero = {"/instrument/azimuth_zero_deg"}, rate = {"omega_sin_latitude_rad_s"};
  const ReleasesReport joint = compare_releases(releases, wanted(zero, rate));
  ASSERT_EQ(joint.fit, FitOutcome::converged);
  ASSERT_EQ(joint.estimates.size(), 3);
  double information = 0, sum = 0;
  for (std::size_t r = 0; r < 2; ++r) {
    const MeasurementReport alone =
        compare_with_measurement(releases[r].source, {}, releases[r].measurement, wanted({rate[0], zero[0]}, {}));
    ASSERT_EQ(alone.fit, FitOutcome::converged);
    const double weight = 1 / (*alone.estimates[0].standard_error * *alone.estimates[0].standard_error);
    information += weight;
    sum += weight * *alone.estimates[0].estimate;
    EXPECT_LT(std::abs(*found(joint, zero[0], r + 1).estimate - (r == 0 ? 0.3 : -0.2)),
              5 * *found(joint, zero[0], r + 1).standard_error);
  }
  const ParameterEstimate& shared = found(joint, rate[0], 0);
  const double error = 1 / std::sqrt(information);
  // Fits stop a thousandth of a standard error from their minima; their errors have five digits.
  EXPECT_NEAR(*shared.standard_error, error, 1e-4 * error);
  EXPECT_NEAR(*shared.estimate, sum / information, 5e-3 * error);  // three fits, each a thousandth off
  EXPECT_EQ(joint.fitted->degrees_of_freedom, 32 - 3);
  EXPECT_TRUE(joint.agrees());
  // Each release has its own part of chi-squared, its own residuals, and the numbers of its scenario.
  EXPECT_DOUBLE_EQ(joint.releases[0].fitted->value + joint.releases[1].fitted->value, joint.fitted->value);
  EXPECT_EQ(joint.releases[1].residuals.size(), 12);
  ASSERT_EQ(joint.releases[1].estimates.size(), 2);
  EXPECT_EQ(joint.releases[1].estimates[1].estimate, found(joint, zero[0], 2).estimate);
}

/// Where another release's own number varies, a release's motion is not computed again: eight releases take 240 motions, and would take
/// 912 if it were.
TEST_F(ReleasesTest, MotionsOfOtherReleasesAreKept) {
  std::vector<MeasuredRelease> releases;
  for (std::uint64_t seed = 1; seed <= 8; ++seed)
    releases.push_back({shipped("free-gyro"), {}, azimuths(12, test::kVertical45, 0.1, seed)});
  const ReleasesReport joint =
      compare_releases(releases, wanted({"/instrument/azimuth_zero_deg"}, {"omega_sin_latitude_rad_s"}));
  ASSERT_EQ(joint.fit, FitOutcome::converged);
  EXPECT_LT(joint.predictions, 300);
}

/// A top that is spun both ways: the error of gravity shifts both results by opposite amounts.
TEST_F(ReleasesTest, SpunBothWaysTheErrorOfTheWeightCancels) {
  MeasurementPlan plan;
  plan.quantities = {planned_quantity("axis_deg", 0.01)};
  plan.every_s = 0.1;
  plan.until_s = 10;
  plan.nuisances = {"gravity_m_s2"};
  plan.shared = {"omega_sin_latitude_rad_s", "gravity_m_s2"};
  const test::Overrides heavier = {{"/site/gravity_m_s2", "9.81"}}, reversed = {{"/release/spin_rad_s", "-200"}};
  test::Overrides both = heavier;
  both.push_back(reversed[0]);
  const auto one_way = simulated_measurement(shipped("toy-top"), heavier, plan, 1);
  const auto other_way = simulated_measurement(shipped("toy-top"), both, plan, 2);
  const std::vector<MeasuredRelease> releases = {{shipped("toy-top"), {}, read(*one_way)},
                                                 {shipped("toy-top"), reversed, read(*other_way)}};
  const MeasurementReport alone =
      compare_with_measurement(releases[0].source, {}, releases[0].measurement, wanted({"omega_sin_latitude_rad_s"}, {}));
  EXPECT_TRUE(alone.contradicts_known_rate());
  const ReleasesReport joint = compare_releases(releases, wanted({}, plan.shared));
  ASSERT_EQ(joint.fit, FitOutcome::converged);
  EXPECT_TRUE(joint.agrees());
  EXPECT_FALSE(joint.contradicts_known_rate());
  const ParameterEstimate &rate = found(joint, "omega_sin_latitude_rad_s", 0), &gravity = found(joint, "gravity_m_s2", 0);
  EXPECT_LT(std::abs(*gravity.estimate - 9.81), 4 * *gravity.standard_error);
  EXPECT_LT(std::abs(joint.correlation[0][1]), 0.01);

  // The plan says so beforehand, and that neither release would do alone: its rows hardly tell weight and Earth apart.
  const PlanReport planned = plan_releases({{shipped("toy-top"), {}}, {shipped("toy-top"), reversed}}, plan);
  ASSERT_EQ(planned.outcome, PlanOutcome::determined);
  EXPECT_EQ(planned.estimates[0].name, "omega_sin_latitude_rad_s");
  EXPECT_FALSE(planned.estimates[0].is_nuisance);
  EXPECT_TRUE(planned.estimates[1].is_nuisance);
  EXPECT_NEAR(*planned.estimates[0].standard_error, *rate.standard_error,
              0.01 * *rate.standard_error);  // planned with a gravity that is wrong by 3e-4
  ASSERT_EQ(planned.releases.size(), 2);
  for (const ReleasePlan& release : planned.releases)
    EXPECT_GT(release.standard_error.value_or(0), 10 * *planned.estimates[0].standard_error);
}

/// Gravity is known beforehand to half the error that the data of both releases give it: that is one datum, though both scenarios say
/// it.
TEST_F(ReleasesTest, WhatIsKnownOfASharedNumberIsOneDatum) {
  MeasurementPlan plan;
  plan.quantities = {planned_quantity("axis_deg", 0.01)};
  plan.every_s = 0.1;
  plan.until_s = 5;
  const std::vector<std::string> gravity = {"gravity_m_s2"};
  std::vector<MeasuredRelease> releases;
  for (const std::uint64_t seed : {1, 2})
    releases.push_back({shipped("toy-top"), {}, read(*simulated_measurement(shipped("toy-top"), {}, plan, seed))});
  MeasurementOptions options = wanted({}, gravity);
  const double of_data = *compare_releases(releases, options).estimates[0].standard_error, prior = of_data / 2;
  for (MeasuredRelease& release : releases)
    release.overrides = {{"/uncertainty", fmt::format("{{\"gravity_m_s2\": {}}}", prior)}};
  options.priors = true;
  const ReleasesReport known = compare_releases(releases, options);
  ASSERT_EQ(known.priors.size(), 1);
  EXPECT_EQ(known.fitted->degrees_of_freedom, 2 * 2 * 51 + 1 - 1);
  const double expected = 1 / std::sqrt(1 / (of_data * of_data) + 1 / (prior * prior));
  EXPECT_NEAR(*known.estimates[0].standard_error, expected, 1e-3 * expected);  // where a fit stops
  // In a plan as well: there the scenarios' block alone makes it a number of the fit, which is shared since both have it.
  plan.estimates = {"omega_sin_latitude_rad_s"};
  plan.shared = plan.estimates;
  const PlanReport planned =
      plan_releases({{releases[0].source, releases[0].overrides}, {releases[1].source, releases[1].overrides}}, plan);
  ASSERT_EQ(planned.estimates.size(), 2);
  EXPECT_EQ(planned.estimates[1].release, 0);
  plan.shared.clear();
  EXPECT_EQ(plan_releases({{releases[0].source, releases[0].overrides}, {releases[1].source, {}}}, plan).estimates.size(), 3);
}

TEST_F(ReleasesTest, TheDocumentHasTheFitAndEachRelease) {
  std::vector<MeasuredRelease> releases = {{shipped("free-gyro"), {}, azimuths(9, test::kVertical45, 0, 1)},
                                           {shipped("free-gyro"), {}, azimuths(7, test::kVertical45, 0, 2)}};
  releases[1].estimates = {"/instrument/azimuth_zero_deg"};
  MeasurementOptions options = wanted({}, {"omega_sin_latitude_rad_s"});
  options.correlation_time_s = 2;
  options.curve_points = 5;
  const ReleasesReport report = compare_releases(releases, options);
  const auto document = testing::parse_json(releases_json(report));
  EXPECT_EQ(document.at("$schema"), "earthtop-releases-1.json");
  ASSERT_EQ(document.at("estimates").size(), 2);
  EXPECT_FALSE(document.at("estimates").at(0).contains("release"));
  EXPECT_EQ(document.at("estimates").at(1).at("release"), 2);
  EXPECT_EQ(document.at("correlation").size(), 2);
  ASSERT_EQ(document.at("releases").size(), 2);
  const auto& second = document.at("releases").at(1);
  EXPECT_EQ(second.at("residuals").size(), 7);
  EXPECT_TRUE(second.at("residuals").at(1).contains("whitened"));
  EXPECT_GE(second.at("curve").at("t_s").size(), 5);
  EXPECT_EQ(second.at("prediction").at("verdict"), "reliable");
}

TEST_F(ReleasesTest, WhatCannotBeSharedIsRefused) {
  const auto refused = [](const auto& work, const std::string& words) {
    try {
      work();
      ADD_FAILURE() << "accepted: " << words;
    } catch (const ScenarioError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  };
  const MeasuredRelease one = {shipped("free-gyro"), {}, azimuths(9, test::kVertical45, 0, 1)};
  MeasuredRelease other = one;
  other.overrides = {{"/site/latitude_deg", "44"}};
  refused(
      [&] {
        compare_releases({one, other}, wanted({}, {"latitude_deg"}));
      },
      "starts at 45 in one scenario and at 44 in another");
  refused([&] { compare_releases({one}, wanted({}, {"latitude_deg"})); }, "is for several releases");
  refused([&] { compare_releases({}, {}); }, "0 releases; from 1 to 64");
  refused([&] { compare_releases({one, other}, wanted({}, {"latitude"})); }, "free-gyro.json");
  MeasurementPlan plan;
  plan.quantities = {planned_quantity("azimuth_deg", 0.01)};
  plan.every_s = 1;
  refused([&] { plan_releases({{one.source, {}}, {one.source, {{"/motion/duration_s", "10"}}}}, plan); }, "say until when");
  plan.shared = {"latitude_deg"};
  refused([&] { plan_releases({{one.source, {}}}, plan); }, "is for several releases");
}

TEST_F(ReleasesTest, AListNamesScenariosAndMeasurements) {
  const std::string file = (directory_.path() / "list.json").string();
  const auto list_of = [&](const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
    return read_releases(file);
  };
  const ListedReleases list = list_of(R"({"estimate": ["spin_rad_s"], "shared": ["gravity_m_s2"], "releases": [
    {"scenario": "a.json", "measurement": "../a.csv", "columns": ["phi=azimuth_deg"], "sigma": ["azimuth_deg=0.2"], "time_offset_s": 2.5},
    {"scenario": "a.json", "set": ["/release/spin_rpm=-2400"], "estimate": ["tilt_deg"]}]})");
  ASSERT_EQ(list.releases.size(), 2);
  EXPECT_EQ(list.releases[0].scenario, (directory_.path() / "a.json").string());
  EXPECT_EQ(list.releases[0].measurement, (directory_.path() / "../a.csv").string());
  EXPECT_EQ(list.releases[1].measurement, "");
  EXPECT_EQ(list.releases[1].sets, std::vector<std::string>{"/release/spin_rpm=-2400"});
  EXPECT_EQ(list.releases[1].estimates, std::vector<std::string>{"tilt_deg"});
  EXPECT_EQ(list.estimates, std::vector<std::string>{"spin_rad_s"});
  EXPECT_EQ(list.releases[0].format.columns, std::vector<std::string>{"phi=azimuth_deg"});
  EXPECT_EQ(list.releases[0].format.sigmas, std::vector<std::string>{"azimuth_deg=0.2"});
  EXPECT_EQ(list.releases[0].format.time_offset_s, 2.5);
  EXPECT_EQ(list.releases[1].format.time_offset_s, 0);
  EXPECT_EQ(list.shared, std::vector<std::string>{"gravity_m_s2"});
  const auto refused = [&](const std::string& text, int line, const std::string& words) {
    try {
      list_of(text);
      ADD_FAILURE() << "accepted: " << text;
    } catch (const ScenarioError& error) {
      EXPECT_EQ(error.diagnostics().front().line, line);
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  };
  refused("{}", 1, "releases");
  refused(R"({"releases": []})", 1, "must have at least one release");
  refused("{\"releases\": [\n{\"measurement\": \"a.csv\"}]}", 2, "scenario");
  refused("{\"releases\": [\n{\"scenario\": \"\"}]}", 2, "must be the path of a file");
  refused("{\"releases\": [{\"scenario\": \"a.json\",\n\"set\": \"x\"}]}", 2, "set");
  refused("{\"releases\": [{\"scenario\": \"a.json\"}],\n\"shared\": \"gravity_m_s2\"}", 2, "must be an array of names");
  refused("{\"releases\": [{\"scenario\": \"a.json\",\n\"mesurement\": \"a.csv\"}]}", 2, "measurement");
}

}  // namespace
}  // namespace earthtop
