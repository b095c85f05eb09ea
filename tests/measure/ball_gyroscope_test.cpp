// SPDX-License-Identifier: GPL-3.0-or-later
// A tachometer and a stopwatch tell of a ball gyroscope.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "earthtop/measure/measurement.hpp"
#include "earthtop/plan/plan.hpp"

namespace earthtop {
namespace {

/// The Heidelberg ball gyroscope: a ball of steel on air, with a small weight on its rod.
std::string ball(double spin_rpm, double lever_m, double I3_kg_m2) {
  return fmt::format(R"({{"site": {{"latitude_deg": 49.4, "gravity_m_s2": 9.80665}}, "body": {{"mass_kg": 4.164,
    "center_of_mass_m": [0, 0, {}], "inertia": {{"principal_kg_m2": [4.3315e-3, 4.3315e-3, {}]}}}},
    "release": {{"tilt_deg": 90, "azimuth_deg": 0, "spin_rpm": {}}}, "motion": {{"duration_s": 200}}}})",
                     lever_m, I3_kg_m2, spin_rpm);
}

/// Seven rows of its tachometer in twelve minutes: viscous friction about the axis, I3 times the rate at which the logarithm falls.
TEST(BallGyroscope, ATachometerTellsItsFriction) {
  MeasurementOptions options;
  options.estimates = {"/effects/viscous_torque_N_m_s"};
  const MeasurementReport fit = compare_with_measurement(
      {"ball.json", ball(1000, 3.6784e-4, 4.0624e-3)}, {{"/effects/viscous_torque_N_m_s", "2e-6"}},
      parse_measurement("m.csv", "t_s,spin_rpm\n0,1000\n120,920\n240,850\n360,775\n480,710\n600,660\n720,610\n",
                        {{}, {"spin_rpm=10"}}),
      options);
  ASSERT_EQ(fit.fit, FitOutcome::converged) << fit.fit_reason;
  EXPECT_NEAR(*fit.estimates[0].estimate, 2.8265e-6,
              0.0005e-6);  // least squares of 1000 exp(-k t / I3) by itself, to these digits
  EXPECT_NEAR(*fit.estimates[0].standard_error, 0.053e-6, 0.0005e-6);  // likewise
}

/// Sixteen times of precession, of four spins and four loads: one moment. Each time has an error that is far larger than its nutation.
TEST(BallGyroscope, SixteenTimesOfPrecessionAreOneMoment) {
  constexpr double kBallI3 = 4.0624e-3, kSigma_s = 2;
  std::vector<MeasuredRelease> releases;
  double information = 0;  // about the logarithm of I3, to which each time is proportional
  unsigned seed = 0;
  for (const double lever_m : {3.6784e-4, 4.8611e-4, 7.617e-4, 9.9825e-4})
    for (const double spin_rpm : {680.0, 535.0, 392.5, 245.0}) {
      MeasurementPlan plan{
          {planned_quantity("precession_period_s", kSigma_s)}, 1, 1, 0, {"/body/inertia/principal_kg_m2/2"}, {}};
      const auto csv = simulated_measurement({"ball.json", ball(spin_rpm, lever_m, kBallI3)}, {}, plan, ++seed);
      Measurement one = parse_measurement("m.csv", *csv);
      one.values.resize(1);  // that of the release
      information += std::pow(one.values[0].value / kSigma_s, 2);
      releases.push_back({{"ball.json", ball(spin_rpm, lever_m, 0.97 * kBallI3)}, {}, one, {}});
    }
  MeasurementOptions options;
  options.shared = {"/body/inertia/principal_kg_m2/2"};
  const ReleasesReport fit = compare_releases(releases, options);
  ASSERT_EQ(fit.fit, FitOutcome::converged) << fit.fit_reason;
  const ParameterEstimate& I3 = fit.estimates[0];
  EXPECT_LT(std::abs(*I3.estimate - kBallI3), 3 * *I3.standard_error);
  EXPECT_NEAR(*I3.standard_error, kBallI3 / std::sqrt(information),
              0.1 * kBallI3 / std::sqrt(information));  // what the nutation leaves
  EXPECT_TRUE(fit.agrees());
}

}  // namespace
}  // namespace earthtop
