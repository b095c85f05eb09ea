// SPDX-License-Identifier: GPL-3.0-or-later
/// More random journeys than the gate has, the reference values in 113 bits, and the pendulous compass.
#include <gtest/gtest.h>

#include <numbers>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/frames/earth.hpp"
#include "earthtop/scene/top_figures.hpp"
#include "support/gimbal_references.hpp"
#include "support/gyrostat_references.hpp"
#include "support/soundness.hpp"
#include "support/tolerances.hpp"
#include "support/travel_runs.hpp"

namespace earthtop {
namespace {

TEST(Travel, SixtyJourneysDriftAsTheirPlacesInSpaceSay) {
  for (std::uint64_t seed = 1000; seed < 1060; ++seed) testing::expect_as_by_force(testing::random_journey(seed, 20));
}

TEST(Travel, BoundsOfAHundredJourneysHoldAndAreClose) {
  for (std::uint64_t seed = 2000; seed < 2100; ++seed)
    testing::expect_sound(testing::random_journey(seed, 40), seed % 2 == 0 ? Observer::inertial : Observer::body);
}

TEST(Travel, MeetsItsReferencesIn113Bits) {
  // The digits that are printed: 25 of motions, the last two of which may differ, and 20 of drifts, which are below 1.
  constexpr double kOfMotion = testing::reference(23, 10), kOfDrift = testing::reference(20);
  for (const nlohmann::json& reference : testing::travel_references().at("cases")) {
    const std::string name = reference.at("name").get<std::string>();
    const bool gimbals = reference.at("scenario").contains("gimbals");
    if (name == "T1 both" || name == "T7") continue;  // drifts of the axis alone; a day and a half
    const Observer observer = name == "T3" || name == "T8"                   ? Observer::body
                              : name == "T2" || name == "T4" || name == "T6" ? Observer::inertial
                                                                             : Observer::laboratory;
    SCOPED_TRACE(name + ", " + std::string(to_string(observer)));
    IntegrationOptions options;
    const bool series = gimbals || reference.at("scenario").contains("rotor");  // of 113 bits there are those alone
    options.method = series ? Method::taylor : Method::extrapolation;
    options.observer = observer, options.form = ModelForm::general;
    options.relative_tolerance = 1e-26;
    DriftProblem<float128> problem = Scene(testing::travel_scenario(reference)).problem<float128>();
    const auto made = integrate_drift(problem, options);
    ASSERT_EQ(made.status, RunStatus::completed);
    if (gimbals) {
      const auto errors = testing::gimbal_errors(reference, made);
      EXPECT_LT(errors.motion, kOfMotion);
      EXPECT_LT(errors.drift, kOfDrift);
    } else {
      const auto errors = testing::gyrostat_errors(reference, made);
      EXPECT_LT(errors.motion, kOfMotion);
      EXPECT_LT(errors.drift, kOfDrift);
    }
  }
}

/// A pendulous compass whose axis is near North, without its nutation: azimuth and elevation from the mass moment below the pivot, the
/// spin momentum and the moment of inertia about the upright axis. A North-bound laboratory accelerates from 0 to `speed` in a minute.
struct SlowCompass {
  double rate, M, g, moment, momentum, inertia, speed;
  double azimuth = 0, elevation = 0, latitude = std::numbers::pi / 4;

  double velocity(double t_s) const {
    const double x = std::min(t_s / 60, 1.0);
    return speed * x * x * x * (10 - 15 * x + 6 * x * x);
  }
  /// The rates of azimuth, elevation and latitude.
  std::array<double, 3> slope(double t_s, const std::array<double, 3>& at) const {
    const double x = std::min(t_s / 60, 1.0), v = velocity(t_s), ratio = moment / momentum;
    const double a = speed * 30 * x * x * (1 - x) * (1 - x) / 60, jerk = speed * 60 * x * (1 - x) * (1 - 2 * x) / 3600;
    const double north = rate * std::cos(at[2]), up = rate * std::sin(at[2]), e = at[1];
    const double held = inertia / momentum, felt_east = 2 * up * v;
    const double e1 = (v / M + north * at[0] - ratio * e * felt_east + held * ((north + up * e) * v / M - ratio * jerk)) /
                      (1 + held * (north + ratio * g));
    return {up - north * e - ratio * (g * e + a), e1, v / M};
  }
  /// Runge and Kutta's step.
  void step(double t_s, double h) {
    const std::array<double, 3> y{azimuth, elevation, latitude};
    const auto moved = [&](const std::array<double, 3>& k, double by) {
      return std::array<double, 3>{y[0] + by * k[0], y[1] + by * k[1], y[2] + by * k[2]};
    };
    const auto k1 = slope(t_s, y), k2 = slope(t_s + h / 2, moved(k1, h / 2)), k3 = slope(t_s + h / 2, moved(k2, h / 2)),
               k4 = slope(t_s + h, moved(k3, h));
    const auto mean = [&](std::size_t i) { return h * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]) / 6; };
    azimuth += mean(0), elevation += mean(1), latitude += mean(2);
  }
};

/// A change of speed deflects a pendulous compass by 1 - kappa of what it moves false North by: with Schuler's tuning not at all, but for
/// what the Coriolis force on the raised pendulum does; and it swings with Schuler's period.
TEST(Travel, AChangeOfSpeedDeflectsAPendulousCompassByItsTuning) {
  const double momentum = 0.1, speed = 1, M = meridian_radius_m(45);
  for (const double kappa : {1.0, 2.0}) {
    Scenario s = testing::shipped("schuler-tuned-compass");
    s.travel->legs = {{60, speed, 0, 0}};
    const double rate = s.rotation_rate_rad_s, north = rate * std::sqrt(0.5), g = s.site.gravity_m_s2;
    const double moment = kappa * momentum / (M * north);
    s.body.center_of_mass_m = {moment / s.body.mass_kg, 0, 0};
    const double elevation = momentum * north / (moment * g + momentum * north);
    s.release.gimbals->inner_angle_deg = 90 - elevation * 180 / std::numbers::pi;
    const RunResult result = run(s);
    ASSERT_EQ(result.status, RunStatus::completed);
    // About the upright axis: of the body, which hangs along its axis 1, the rotor across its own, and the outer gimbal.
    const double inertia = s.body.inertia_kg_m2[0][0] + s.rotor->transverse_kg_m2 + s.gimbals->ring->inertia_kg_m2[2][2];
    SlowCompass slow{rate, M, g, moment, momentum, inertia, speed};
    slow.elevation = elevation;
    const double whole = speed / (M * north);  // what false North moves by
    double largest = 0, apart = 0;
    for (std::size_t i = 1; i < result.rows.size(); ++i) {
      const double begin = result.rows[i - 1].t_s, h = (result.rows[i].t_s - begin) / 10;
      for (int k = 0; k < 10; ++k) slow.step(begin + k * h, h);
      const auto& axis = result.rows[i].rotor->axis_L;
      const double azimuth = std::atan2(axis[0], axis[1]);
      apart = std::max(apart, std::abs(azimuth - slow.azimuth) / whole);
      largest = std::max(largest, std::abs(azimuth / whole + slow.velocity(result.rows[i].t_s) / speed));
    }
    constexpr double kApart = 1e-3;  // of the first swing: nutation and second orders, which the slow equations do not have
    EXPECT_LT(apart, kApart * kappa) << kappa;
    constexpr double kOfInertia = 0.02;  // the moments of inertia are a hundredth
    EXPECT_NEAR(largest, kappa - 1, kOfInertia);
    const JourneyFigures& figures = *result.scene.top().journey;
    EXPECT_NEAR(*figures.schuler_kappa, kappa, testing::rounding(40 * kappa));
    const double period = 2 * std::numbers::pi / std::sqrt(north * north + moment * g * north / momentum);
    EXPECT_NEAR(*figures.schuler_period_s, period, testing::rounding(40 * period));
  }
}

}  // namespace
}  // namespace earthtop
