// SPDX-License-Identifier: GPL-3.0-or-later
// Tests what estimates say: whether the Earth is seen, whether the known rate is contradicted, by which errors of inputs, in which
// words; and which inputs a fit and a plan took as exact.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "earthtop/plan/plan.hpp"
#include "measure/known_rate.hpp"
#include "measure/made_up_measurements.hpp"
#include "support/tolerances.hpp"
#include "text/json.hpp"

namespace earthtop {
namespace {

using namespace test;

constexpr double kRounding = 1e-9;          // of a result of some hundred operations in double, with cancellation to six digits
constexpr double kDouble = 1e-12;           // of a product of some doubles
constexpr double kConverged = 0.02;         // standard errors: twice a fit's thousandth, and the linear law's second order
constexpr double kRoughDifferences = 0.01;  // of a derivative by a rough difference, and of one at numbers a noise apart

class RateFindings : public MeasurementTest {
 protected:
  /// The azimuths of a free gyroscope on an Earth that turns `times` as fast.
  Measurement turning(double times, double standard_error) const {
    std::string csv = "t_s,azimuth_rad,azimuth_se_rad\n";
    for (int i = 1; i <= 10; ++i)
      csv += fmt::format("{},{},{}\n", 6 * i, azimuth(free_axis(kEast, times * kNorthward45, times * kVertical45, 6.0 * i)),
                         standard_error);
    return read(csv);
  }
  static MeasurementReport fitted(const Measurement& data, const Overrides& overrides = {},
                                  const std::string& name = "omega_sin_latitude_rad_s") {
    return compare_with_measurement(shipped("free-gyro"), overrides, data, {.estimates = {name}});
  }
};

RateOutcome outcome_of(double estimate, double error, double known, double known_error) {
  return rate_finding(estimate, error, {known, known_error}, {}).outcome();
}

TEST(RateFinding, HasThreeOutcomesWithOneLimit) {
  EXPECT_EQ(RateFinding::kLimit_sigma, 3);
  const double below = 0.999, above = 1.001;
  // Zero is 3 standard errors away from a rate of 1 where these are 1/3.
  EXPECT_EQ(outcome_of(1, below / 3, 1, 0), RateOutcome::seen);
  EXPECT_EQ(outcome_of(1, above / 3, 1, 0), RateOutcome::not_seen);
  EXPECT_EQ(outcome_of(-1, below / 3, -1, 0), RateOutcome::seen) << "of a rate with the other sign as well";
  // Away from the known rate, to both sides; an error of the known rate counts as one of the estimate does.
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_EQ(outcome_of(1 + sign * below * 0.03, 0.01, 1, 0), RateOutcome::seen);
    EXPECT_EQ(outcome_of(1 + sign * above * 0.03, 0.01, 1, 0), RateOutcome::contradicts);
    EXPECT_EQ(outcome_of(1 + sign * below * 0.15, 0.03, 1, 0.04), RateOutcome::seen) << "3 * hypot(0.03, 0.04)";
    EXPECT_EQ(outcome_of(1 + sign * above * 0.15, 0.03, 1, 0.04), RateOutcome::contradicts);
  }
  // An estimate that excludes the known rate and not zero has seen nothing.
  EXPECT_EQ(outcome_of(0, 0.01, 1, 0), RateOutcome::contradicts);
}

// Two data on one number, x1 +- s1 from the measurement and x2 +- s2 known beforehand, give the weighted mean. From the mean and x2
// the finding must give back what x1 alone says.
TEST(RateFinding, IsOfTheDataAlone) {
  for (const auto& [x1, s1, s2] : {std::array{5.0, 0.5, 0.3}, {-2.0, 0.1, 0.9}, {4.0, 0.7, 0.7}, {1.0, 2.0, 0.02}}) {
    const double x2 = 4, w1 = 1 / (s1 * s1), w2 = 1 / (s2 * s2);
    const RateFinding both = rate_finding((w1 * x1 + w2 * x2) / (w1 + w2), 1 / std::sqrt(w1 + w2), {x2, s2}, s2);
    const RateFinding alone = rate_finding(x1, s1, {x2, s2}, {});
    EXPECT_NEAR(both.from_zero_sigma, alone.from_zero_sigma, kRounding * alone.from_zero_sigma);
    EXPECT_NEAR(both.from_known_sigma, alone.from_known_sigma, kRounding * (1 + std::abs(alone.from_known_sigma)));
    EXPECT_TRUE(both.had_prior && !alone.had_prior);
  }
  // Data that say nothing leave the prior's value: nothing is seen, though the estimate is a thousand errors from zero.
  EXPECT_EQ(rate_finding(1, 1e-3, {1, 1e-3}, 1e-3).outcome(), RateOutcome::not_seen);
}

TEST_F(RateFindings, SeeTheEarthThatIsThere) {
  const MeasurementReport report = fitted(turning(1, 1e-5));
  ASSERT_TRUE(report.estimates.at(0).finding);
  const RateFinding& finding = *report.estimates[0].finding;
  EXPECT_EQ(finding.outcome(), RateOutcome::seen);
  EXPECT_TRUE(report.agrees());
  EXPECT_NEAR(finding.known.value, kVertical45, kDouble * kVertical45);
  EXPECT_NEAR(finding.known.standard_error, 1e-8 * kVertical45, testing::rounding(20) * finding.known.standard_error);
  EXPECT_NEAR(finding.from_zero_sigma, *report.estimates[0].estimate / *report.estimates[0].standard_error, kRounding);
  EXPECT_EQ(fitted(turning(1, 1e-2)).estimates.at(0).finding->outcome(), RateOutcome::not_seen);
  EXPECT_TRUE(fitted(turning(1, 1e-2)).agrees());
}

TEST_F(RateFindings, ContradictAnEarthThatTurnsAsItDoesNot) {
  for (const char* name : {"omega_sin_latitude_rad_s", "rotation_rate_rad_s", "/earth/rotation_rate_rad_s"}) {
    const MeasurementReport report = fitted(turning(1.5, 1e-5), {}, name);
    ASSERT_TRUE(report.estimates.at(0).finding) << name;
    EXPECT_EQ(report.estimates[0].finding->outcome(), RateOutcome::contradicts) << name;
    EXPECT_GE(*report.fitted->p_value, MeasurementReport::kLeastPValue) << "the residuals are as they should be";
    EXPECT_FALSE(report.agrees()) << name;
    const nlohmann::ordered_json document = json_of(measurement_json(report));
    EXPECT_EQ(document.at("agrees"), false);
    EXPECT_EQ(document.at("estimates").at(0).at("finding").at("outcome"), "contradicts");
  }
  EXPECT_FALSE(fitted(turning(1, 1e-5), {}, "/release/azimuth_deg").estimates.at(0).finding) << "no rate of the Earth";
}

// The latitude and its error: d(sin) = cos d(latitude). With 20 degrees of error a rate half as large again is no contradiction.
TEST_F(RateFindings, KnowARateAsWellAsTheScenarioSays) {
  const auto known = [](const std::string& uncertainty, const std::string& name) {
    const Overrides overrides = {{"/uncertainty", uncertainty}};
    const Scene scene = parse_scene(shipped("free-gyro"), overrides);
    return measure::known_rate(scene, measure::EstimatedInputs(shipped("free-gyro"), overrides, scene, {name}).list()[0])
        ->standard_error;
  };
  const double of_latitude = kOmega * std::cos(kPi / 4) * 20 * kDegree;
  EXPECT_NEAR(known(R"({"latitude_deg": 20})", "omega_sin_latitude_rad_s"), of_latitude, kRounding * of_latitude);
  EXPECT_NEAR(known(R"({"latitude_deg": 20})", "omega_cos_latitude_rad_s"), of_latitude, kRounding * of_latitude);
  EXPECT_NEAR(known(R"({"latitude_deg": 20})", "rotation_rate_rad_s"), 1e-8 * kOmega, kRounding * 1e-8 * kOmega);
  const double of_rate = std::sin(kPi / 4) * 1e-6;
  EXPECT_NEAR(known(R"({"rotation_rate_rad_s": 1e-6})", "omega_sin_latitude_rad_s"), of_rate, kRounding * of_rate);
  EXPECT_NEAR(known(R"({"rotation_rate_rad_s": 1e-6, "latitude_deg": 20})", "omega_sin_latitude_rad_s"),
              std::hypot(of_rate, of_latitude), kRounding * of_latitude);
  EXPECT_EQ(known(R"({"rotation_rate_rad_s": 1e-6})", "rotation_rate_rad_s"), 1e-6);
  const MeasurementReport report = fitted(turning(1.5, 1e-5), {{"/uncertainty", R"({"latitude_deg": 20})"}});
  EXPECT_EQ(report.estimates.at(0).finding->outcome(), RateOutcome::seen);
  EXPECT_TRUE(report.agrees());
  // Another rate than the Earth's is what the scenario says it is.
  const MeasurementReport other = fitted(turning(2, 1e-5), {{"/earth/rotation_rate_rad_s", "1.458423e-4"}});
  EXPECT_EQ(other.estimates.at(0).finding->known.standard_error, 0);
  EXPECT_FALSE(other.estimates.at(0).finding->known.is_earths);
  EXPECT_EQ(other.estimates.at(0).finding->outcome(), RateOutcome::seen);
}

/// A change of an exact input of the scenario by d moves the estimate from the same data by -shift * d: the error of the input is
/// its true value less the scenario's.
TEST_F(RateFindings, ExactInputsShiftTheEstimateAsTheySay) {
  MeasurementPlan plan;
  plan.quantities = {planned_quantity("azimuth_deg", 0.01), planned_quantity("tilt_deg", 0.01)};
  plan.every_s = 0.25;
  plan.until_s = 20;
  struct Case {
    std::vector<std::string> estimates;
    std::vector<std::pair<std::string, std::string>> exact;  ///< some that must be there, with their pointers
    Overrides overrides;
  };
  const Overrides stated = {{"/uncertainty", R"({"center_of_mass_m": 1e-5, "viscous_torque_N_m_s": 1e-9})"},
                            {"/effects/viscous_torque_N_m_s", "1e-7"}};
  const std::pair<std::string, std::string> gravity = {"gravity_m_s2", "/site/gravity_m_s2"},
                                            spin = {"spin_rad_s", "/release/spin_rad_s"},
                                            tilt = {"tilt_deg", "/release/tilt_deg"},
                                            azimuth = {"/release/azimuth_deg", "/release/azimuth_deg"},
                                            viscous = {"viscous_torque_N_m_s", "/effects/viscous_torque_N_m_s"},
                                            center = {"center_of_mass_m", "/body/center_of_mass_m/2"};
  const Case cases[] = {{{"omega_sin_latitude_rad_s", "spin_rad_s"}, {gravity, center, tilt, azimuth}, {}},
                        {{"omega_sin_latitude_rad_s"}, {spin, gravity, viscous}, stated},
                        {{"gravity_m_s2", "tilt_deg"}, {spin, center}, {}},
                        {{"spin_rad_s"}, {gravity, tilt}, {}}};
  int compared = 0;
  for (const Case& c : cases) {
    const auto data = simulated_measurement(shipped("toy-top"), c.overrides, plan, 3);
    const Measurement measurement = read(*data);
    const auto fit = [&](const Overrides& more) {
      Overrides all = c.overrides;
      all.insert(all.end(), more.begin(), more.end());
      return compare_with_measurement(shipped("toy-top"), all, measurement, {.estimates = c.estimates});
    };
    const MeasurementReport report = fit({});
    const ParameterEstimate& estimate = report.estimates.at(0);
    for (const auto& [name, pointer] : c.exact) {
      const auto found = std::ranges::find(estimate.exact, name, &ExactInput::name);
      ASSERT_NE(found, estimate.exact.end()) << name;
      const double d = found->error_of_one_sigma(*estimate.standard_error);
      const MeasurementReport moved = fit(Overrides{{pointer, fmt::format("{}", found->value + d)}});
      EXPECT_NEAR(*moved.estimates.at(0).estimate - *estimate.estimate, -found->shift * d,
                  kConverged * *estimate.standard_error)
          << name << " of " << c.estimates[0];
      ++compared;
    }
    for (std::size_t i = 1; i < estimate.exact.size(); ++i) {
      const ExactInput &more = estimate.exact[i - 1], &less = estimate.exact[i];
      if (!more.stated && !less.stated && more.value != 0 && less.unit != "deg" && more.unit != "deg" &&
          !less.name.starts_with("omega") && !less.name.starts_with("rotation"))
        EXPECT_GE(std::abs(more.shift * more.value), std::abs(less.shift * less.value)) << "largest first";
    }
  }
  EXPECT_EQ(compared, 11);
}

/// The one-sigma errors of a plan are those of a fit to data of that plan, and an input that is stated says so.
TEST_F(RateFindings, ThePlanSaysTheSame) {
  MeasurementPlan plan;
  plan.quantities = {planned_quantity("axis_deg", 0.01)};
  plan.every_s = 0.2;
  plan.until_s = 20;
  plan.nuisances = {"spin_rad_s"};
  const PlanReport planned = plan_measurement(shipped("toy-top"), {}, plan);
  ASSERT_EQ(planned.outcome, PlanOutcome::determined);
  const auto report = compare_with_measurement(shipped("toy-top"), {{"/uncertainty", R"({"center_of_mass_m": 1e-5})"}},
                                               read(*simulated_measurement(shipped("toy-top"), {}, plan, 5)),
                                               {.estimates = {"omega_sin_latitude_rad_s", "spin_rad_s"}});
  const std::vector<ExactInput>&of_plan = planned.estimates.at(0).exact, &of_fit = report.estimates.at(0).exact;
  ASSERT_FALSE(of_plan.empty());
  ASSERT_EQ(of_plan.size(), of_fit.size());
  for (const ExactInput& input : of_plan) {
    const auto same = std::ranges::find(of_fit, input.name, &ExactInput::name);
    ASSERT_NE(same, of_fit.end()) << input.name;
    EXPECT_NEAR(input.shift, same->shift, kRoughDifferences * std::abs(input.shift)) << input.name;
    EXPECT_EQ(same->stated.has_value(), input.name == "center_of_mass_m");
    EXPECT_TRUE(input.name != "omega_sin_latitude_rad_s" && input.name != "spin_rad_s");
  }
  EXPECT_TRUE(planned.estimates.at(1).exact.empty()) << "of what is fitted along nothing is asked";
  // Distance of the centre of mass and gravity act as their product: the parts of themselves are alike.
  const auto part = [&](std::string_view name) {
    const auto input = std::ranges::find(of_plan, name, &ExactInput::name);
    return input->error_of_one_sigma(1) / input->value;
  };
  EXPECT_NEAR(part("gravity_m_s2"), part("center_of_mass_m"), testing::rounding(5e7) * part("gravity_m_s2"))
      << "both act as their product";
}

/// The wrong input is among those that are named, and with its error put right the Earth is seen. An azimuth's offset, which would
/// leave residuals, is not named.
TEST_F(RateFindings, NameTheInputThatIsWrong) {
  MeasurementPlan plan;
  plan.quantities = {planned_quantity("azimuth_deg", 0.01), planned_quantity("tilt_deg", 0.01)};
  plan.every_s = 0.1;
  plan.until_s = 30;
  const auto data = simulated_measurement(shipped("toy-top"), {{"/site/gravity_m_s2", "9.808"}}, plan, 7);
  const MeasurementOptions options{.estimates = {"omega_sin_latitude_rad_s", "spin_rad_s", "tilt_deg"}};
  const auto report = compare_with_measurement(shipped("toy-top"), {}, read(*data), options);
  ASSERT_EQ(report.estimates.at(0).finding->outcome(), RateOutcome::contradicts);
  const std::vector<InputError>& culprits = report.estimates[0].finding->culprits;
  const auto gravity = std::ranges::find(culprits, "gravity_m_s2", &InputError::name);
  ASSERT_NE(gravity, culprits.end());
  constexpr double kNoise = 0.05;  // of the error: the data's noise, and second order
  EXPECT_NEAR(gravity->error, 9.808 - 9.80665, kNoise * 0.00135);
  EXPECT_EQ(std::ranges::find(culprits, "/release/azimuth_deg", &InputError::name), culprits.end());
  const auto mended = compare_with_measurement(
      shipped("toy-top"), {{"/site/gravity_m_s2", fmt::format("{}", 9.80665 + gravity->error)}}, read(*data), options);
  EXPECT_EQ(mended.estimates.at(0).finding->outcome(), RateOutcome::seen);
  EXPECT_TRUE(mended.agrees());
  EXPECT_TRUE(mended.estimates[0].finding->culprits.empty());
}

TEST(Sentences, SayWhatEstimatesMean) {
  struct Case {
    ParameterEstimate estimate;
    bool by_scatter;
    std::string expected;
  };
  const auto rate = [](const std::string& name, double known, double estimate, double error, double scaled, bool by_scatter,
                       std::vector<InputError> culprits = {}, double known_error = 0, std::optional<double> prior = {},
                       bool is_earths = true) {
    ParameterEstimate e{name, "rad/s", known, estimate, error, scaled};
    e.finding = rate_finding(estimate, by_scatter ? scaled : error, {known, known_error, is_earths}, prior);
    e.finding->culprits = std::move(culprits);
    return e;
  };
  const std::string vertical = "omega_sin_latitude_rad_s";
  const std::vector<InputError> many = {
      {"gravity_m_s2", "m/s^2", 0.001}, {"center_of_mass_m", "m", -3.6e-6}, {"inertia_ratio", "", 0.2}, {"tilt_deg", "deg", 1}};
  const Case cases[] = {
      {rate(vertical, 5.2e-5, 5.16e-5, 3.0e-6, 3.0e-6, false), false,
       "the Earth's rate times sin(latitude) is 5.16e-5 ± 0.30e-5 rad/s: seen, zero is excluded at 17 sigma; consistent with "
       "the "
       "known 5.2e-05, 0.1 sigma below it"},
      {rate(vertical, 5.2e-5, -5.16e-5, 3.0e-6, 6.0e-6, true, many), true,
       "the Earth's rate times sin(latitude) is -5.16e-5 ± 0.60e-5 rad/s (the standard error that the scatter gives, 2 times "
       "the "
       "one from the stated errors): contradicts the known 5.2e-05, 17 sigma below it: something else in the scenario is wrong "
       "or "
       "missing; an error of gravity_m_s2 by +0.001 m/s^2, center_of_mass_m by -3.6e-06 m or inertia_ratio by +0.2 would do "
       "it"},
      {rate("omega_cos_latitude_rad_s", 5.2e-5, 5.3e-5, 1e-7, 1e-7, false), false,
       "the Earth's rate times cos(latitude) is 5.300e-5 ± 0.010e-5 rad/s: contradicts the known 5.2e-05, 10 sigma above it: "
       "something else in the scenario is wrong or missing; no error of one of its inputs alone would do it"},
      {rate("rotation_rate_rad_s", 7.3e-5, 4e-5, 8e-5, 9e-5, false, {}, 1e-5), false,
       "the Earth's rate is 4.0e-5 ± 8.0e-5 rad/s: not seen, 0.5 sigma from zero; consistent with the known 7.3e-5 ± 1.0e-5, "
       "0.4 "
       "sigma below it"},
      {rate("rotation_rate_rad_s", 7e-5, 7e-5, 6e-6, 6e-6, false, {}, 1e-5, 1e-5), false,
       "the Earth's rate is 7.00e-5 ± 0.60e-5 rad/s: by the data alone seen, zero is excluded at 9.3 sigma; consistent with "
       "the "
       "known 7.0e-5 ± 1.0e-5, 0.0 sigma above it"},
      {rate("rotation_rate_rad_s", 1e-4, 7.3e-5, 1e-6, 1e-6, false, {}, 0, {}, false), false,
       "the Earth's rate is 7.30e-5 ± 0.10e-5 rad/s: contradicts the scenario's 0.0001, 27 sigma below it: something in the "
       "scenario is wrong or missing; no error of one of its inputs alone would do it"},
      {{"latitude_deg", "deg", 45, 45.7, 0.35, 0.35},
       false,
       "the latitude is 45.70 ± 0.35 deg; the scenario's 45 is 2.0 sigma below it"},
      {{"/body/mass_kg", "kg", 0.1, 0.1, 0.02, 0.02},
       false,
       "/body/mass_kg is 0.100 ± 0.020 kg; the scenario's 0.1 is 0.0 sigma above it"},
      {{"spin_rad_s", "rad/s", 2e7, 2.5e7, 1e6, 1e6},
       false,
       "the spin is 2.50e7 ± 0.10e7 rad/s; the scenario's 20000000 is 5.0 sigma below it"},
  };
  for (const Case& c : cases) EXPECT_EQ(estimate_sentence(c.estimate, c.by_scatter), c.expected);
  EXPECT_EQ(estimate_sentence({"latitude_deg", "deg", 45, {}, {}, {}}, false), "");
}

TEST_F(RateFindings, PlansSayWhatWouldBeSeen) {
  const auto advice = [](double sigma) {
    MeasurementPlan plan;
    plan.quantities = {planned_quantity("azimuth_deg", sigma)};
    plan.every_s = 1;
    plan.until_s = 60;
    return plan_measurement(shipped("free-gyro"), {}, plan);
  };
  const PlanReport fine = advice(0.01), coarse = advice(1);
  EXPECT_EQ(fine.estimates.at(0).finding->outcome(), RateOutcome::seen);
  EXPECT_EQ(fine.advice.find(fmt::format("omega_sin_latitude_rad_s would be seen: it is {:.3g} sigma from zero. ",
                                         *fine.estimates[0].significance())),
            0u)
      << fine.advice;
  EXPECT_EQ(coarse.estimates.at(0).finding->outcome(), RateOutcome::not_seen);
  EXPECT_EQ(coarse.advice.find("omega_sin_latitude_rad_s would not be seen: it is 0.803 sigma"), 0u) << coarse.advice;
}

}  // namespace
}  // namespace earthtop
