// SPDX-License-Identifier: GPL-3.0-or-later
/// Runs of laboratories that travel against closed forms: compasses and directional gyroscopes aboard, what a carried beam keeps, bodies
/// without torque, the parallel as another Earth, Eotvos' formula, and the sky that is brought to a stop.
#include <gtest/gtest.h>

#include <numbers>

#include "earthtop/model/laboratory_now.hpp"
#include "earthtop/run.hpp"
#include "earthtop/scene/top_figures.hpp"
#include "support/gimbal_scenes.hpp"
#include "support/soundness.hpp"
#include "support/tolerances.hpp"
#include "support/travel_scenes.hpp"

namespace earthtop {
namespace {

using testing::rounding;
using testing::sailing;

constexpr double kDegree = std::numbers::pi / 180;

/// The radii of curvature along the meridian and across it, with the height.
struct Radii {
  double meridian, prime;
};
Radii radii(const Scenario& s, double latitude_deg, double height_m) {
  const double r = s.travel->radius_m;
  if (s.travel->figure == TravelFigure::sphere) return {r + height_m, r + height_m};
  const double f = 1 / kInverseFlatteningWgs84, e2 = f * (2 - f), sine = std::sin(latitude_deg * kDegree);
  const double q = 1 - e2 * sine * sine, N = kEquatorialRadiusWgs84 / std::sqrt(q);
  return {N * (1 - e2) / q + height_m, N + height_m};
}

double azimuth(const std::array<double, 3>& axis_L) { return std::atan2(axis_L[0], axis_L[1]); }
double elevation(const std::array<double, 3>& axis_L) { return std::asin(axis_L[2]); }

/// A compass that is held level and damped, 1,000 rad/s, over the time in which it settles to 1e-9.
Scenario level_compass() {
  Scenario s = testing::foucault_gyroscope();
  s.gimbals->inner.locked = true;
  s.gimbals->outer.viscous_torque_N_m_s = 1.5e-4;
  s.release.gimbals = GimbalReleaseSpec{-10, 90, 0, 0};
  s.duration_s = 600, s.output_step_s = 20;
  return s;
}

/// tan d = [v cos C/(M + h)]/[Omega cos phi + v sin C/(N + h)], on which the damper lags behind by (damping time) x (rate of turning); what
/// that leaves over is a hundredth of the lag, a millionth of the error.
TEST(TravelClosedForms, ADampedCompassSettlesOnTheSteamingError) {
  constexpr double kSettled = 1e-8, kOfLag = 0.01;  // rad, and a share
  for (const TravelFigure figure : {TravelFigure::wgs84, TravelFigure::sphere})
    for (const double course : {0.0, 30.0, 75.0, 90.0, 200.0, 290.0})
      for (const double speed : {10.0, 250.0}) {
        Scenario s = level_compass();
        s.site.height_m = 5000;
        s.travel = sailing(TravelPath::rhumb, course, speed);
        s.travel->figure = figure;
        const RunResult result = run(s);
        ASSERT_EQ(result.status, RunStatus::completed);
        const auto expected_at = [&](double latitude_deg) {
          const Radii R = radii(s, latitude_deg, 5000);
          const double sine = std::sin(course * kDegree), cosine = std::cos(course * kDegree);
          const double north = s.rotation_rate_rad_s * std::cos(latitude_deg * kDegree) + speed * sine / R.prime;
          return std::pair(-std::atan2(speed * cosine / R.meridian, north), std::hypot(speed * cosine / R.meridian, north));
        };
        const DriftRow& last = result.rows.back();
        const double latitude = last.journey->latitude_deg, step = 1e-3;
        const auto [settled, rate] = expected_at(latitude);
        const double to_north = speed * std::cos(course * kDegree) / radii(s, latitude, 5000).meridian / kDegree;  // deg/s
        const double turning =
            (expected_at(latitude + step).first - expected_at(latitude - step).first) / (2 * step) * to_north;
        const double momentum = s.rotor->axial_kg_m2 * s.rotor->spin_rad_s;
        const double lag = s.gimbals->outer.viscous_torque_N_m_s / (momentum * rate) * turning;
        EXPECT_NEAR(azimuth(last.rotor->axis_L), settled - lag, kSettled + kOfLag * std::abs(lag)) << course << ", " << speed;
        // The reference, which makes the same way over an Earth that stands still, settles along the way's own rate, if it settles at all: the
        // steaming error is no part of the drift.
        if (course == 0 && speed == 250) {
          EXPECT_GT(last.rotor->drift_axis_rad, 0.5);
        }
      }
}

/// The ellipsoid's radius along the meridian makes it 1,795 instead of 1,794 thousandths of a degree at 20 knots.
TEST(TravelClosedForms, FalseNorthIsAnotherOnTheSphere) {
  Scenario s = level_compass();
  s.travel = sailing(TravelPath::rhumb, 0, 20 * 1852.0 / 3600);
  double found[2];
  for (const TravelFigure figure : {TravelFigure::wgs84, TravelFigure::sphere}) {
    s.travel->figure = figure;
    const double north = s.rotation_rate_rad_s * std::cos(45 * kDegree);
    const double expected = -std::atan2(s.travel->speed_m_s / radii(s, 45, 0).meridian, north);
    found[static_cast<int>(figure)] = *Scene(s).top().journey->false_north_start_rad;
    EXPECT_NEAR(found[static_cast<int>(figure)], expected, rounding(10 * 0.03));
  }
  EXPECT_GT(found[1] - found[0], 1.7e-5);
}

/// Against a laboratory at rest the steaming error is the drift.
TEST(TravelClosedForms, SteamingErrorIsTheDriftFromALaboratoryAtRest) {
  Scenario s = level_compass();
  s.travel = sailing(TravelPath::rhumb, 0, 10);
  s.travel->reference = TravelReference::at_rest;
  const RunResult result = run(s);
  const DriftRow& last = result.rows.back();
  EXPECT_NEAR(last.rotor->drift_axis_rad, std::abs(azimuth(last.rotor->axis_L)), 1e-8);  // the reference points North by then
  EXPECT_GT(last.rotor->drift_axis_rad, 0.03);
}

/// A' = Omega sin(latitude) + v sin C tan(latitude)/(N + h) of an axis that is level and stays nearly so, as it points North.
TEST(TravelClosedForms, ADirectionalGyroWandersWithTheTransportRate) {
  constexpr double kNutation = 1e-6;  // rad: of the release at rest, and of the tilt that comes; the journey turns it by 1.4e-3
  for (const double latitude : {-60.0}) {
    Scenario s = testing::foucault_gyroscope();
    s.site.latitude_deg = latitude, s.site.height_m = 11000;
    s.release.gimbals = GimbalReleaseSpec{0, 90, 0, 0};
    s.duration_s = 20, s.output_step_s = 5;
    s.travel = sailing(TravelPath::rhumb, 90, 250);
    const RunResult result = run(s);
    const double up = (s.rotation_rate_rad_s * std::sin(latitude * kDegree) +
                       250 * std::tan(latitude * kDegree) / radii(s, latitude, 11000).prime);
    const DriftRow &first = result.rows.front(), &last = result.rows.back();
    ASSERT_NEAR(elevation(first.rotor->axis_L), 0, rounding(2));
    EXPECT_NEAR(azimuth(last.rotor->axis_L) - azimuth(first.rotor->axis_L), 20 * up, kNutation) << latitude;
    const double reference_turn = 20 * (up - s.rotation_rate_rad_s * std::sin(latitude * kDegree));
    EXPECT_NEAR(azimuth(last.rotor->ref_axis_L) - azimuth(first.rotor->ref_axis_L), reference_turn, kNutation) << latitude;
  }
}

/// A level beam without friction that is carried once round a parallel turns by -2 pi sin(latitude), whatever its speeds on the way.
TEST(TravelClosedForms, ABeamCarriedRoundAParallelKeepsTheHolonomy) {
  for (const double latitude : {30.0, -50.0}) {
    Scenario s;
    s.site.latitude_deg = latitude, s.site.gravity_m_s2 = 9.80665;
    s.rotation_rate_rad_s = 0;
    s.body.mass_kg = 0.5;
    testing::set_principal(s.body, 0.02, 0.02, 0.03);
    s.gimbals.emplace().inner.locked = true;
    s.release.gimbals = GimbalReleaseSpec{0, 0, 0, 0};
    s.release.rates_relative_to = RatesRelativeTo::inertial;
    s.travel = sailing(TravelPath::rhumb, 90, 50);
    s.travel->figure = TravelFigure::sphere, s.travel->radius_m = 1000;
    s.travel->reference = TravelReference::at_rest;
    const double round = 2 * std::numbers::pi * 1000 * std::cos(latitude * kDegree);
    for (const bool with_legs : {false, true}) {
      s.duration_s = round / 50;
      if (with_legs) {
        s.travel->legs = {{20, 80.0, 0, 0}, {10, 20.0, 0, 0}};  // 1,300 and 500 m, the rest at 20 m/s
        s.duration_s = 30 + (round - 1800) / 20;
      }
      s.output_step_s = s.duration_s / 40;
      const RunResult result = run(s);
      const DriftRow& last = result.rows.back();
      EXPECT_NEAR(last.gimbals->drift_outer_angle_rad, -2 * std::numbers::pi * std::sin(latitude * kDegree), 1e-12)  // rounding
          << latitude << with_legs;
      EXPECT_EQ(last.gimbals->ref_outer_angle_rad, 0) << latitude;
      EXPECT_NEAR(std::remainder(last.journey->longitude_deg, 360), 0, 1e-11);  // rounding of 360
    }
  }
}

/// A body without torque, released with the same inertial rates, drifts by Omega t on any journey.
TEST(TravelClosedForms, AFreeBodyDriftsByTheEarthsTurnOnAnyJourney) {
  const auto& reference = testing::travel_case("T4");
  for (const char* eotvos : {"rotating", "both", "off"}) {
    Scenario s = testing::travel_scenario(reference, {{"/travel/eotvos", eotvos}});
    s.travel->legs = {{100, {}, 0, 0}, {200, {}, 70, 0}, {200, 180.0, 0, 800}};
    s.duration_s = 900, s.output_step_s = 100;
    const RunResult result = run(s);
    for (const DriftRow& row : result.rows) {
      const double turned = s.rotation_rate_rad_s * row.t_s;
      EXPECT_NEAR(row.drift_attitude_rad, turned, row.drift_attitude_bound_rad + rounding(2 * turned)) << row.t_s;
    }
    constexpr double kSmall = 1e-10;  // so that the line above can fail: of a turn of 0.07 rad
    EXPECT_LT(result.drift.attitude_bound_rad, kSmall);
  }
}

Mat3<double> matrix(const std::array<double, 4>& q) {
  return rotation_matrix(Quaternion<double>{q[0], Vec3<double>(q[1], q[2], q[3])});
}
Mat3<double> about_east(double angle) {
  Mat3<double> R;
  R << 1, 0, 0, 0, std::cos(angle), -std::sin(angle), 0, std::sin(angle), std::cos(angle);
  return R;
}

/// On a parallel a motion is that of a laboratory at rest on an Earth that turns by the rate of the longitude more, with a plumb line that
/// leans by what is felt aboard; of the rotating motion, and of the reference.
TEST(TravelClosedForms, AParallelIsAnotherEarth) {
  for (const double course : {90.0, 270.0}) {
    Scenario s = testing::asymmetric_top();
    s.site.latitude_deg = 52, s.site.height_m = 9000;
    s.duration_s = 3, s.output_step_s = 0.5;
    s.travel = sailing(TravelPath::rhumb, course, 250);
    const RunResult result = run(s);
    const double v = course == 90 ? 250 : -250, sine = std::sin(52 * kDegree), cosine = std::cos(52 * kDegree);
    const double N = radii(s, 52, 9000).prime, longitude_rate = v / (N * cosine), Omega = s.rotation_rate_rad_s;
    for (const bool rotating : {true, false}) {
      const double W = rotating ? Omega : 0;
      const double felt_north = -2 * W * v * sine - v * v * sine / cosine / N;
      const double felt_up = -s.site.gravity_m_s2 + 2 * W * v * cosine + v * v / N;
      const double lean = std::atan2(-felt_north, -felt_up);
      Scenario still = s;
      still.travel.reset();
      still.site.gravity_m_s2 = std::hypot(felt_north, felt_up);
      still.site.latitude_deg = 52 + lean / kDegree;
      still.rotation_rate_rad_s = W + longitude_rate;
      const Release<double> release = Scene(s).release<double>();
      const Quaternion<double> turned =
          Quaternion<double>{std::cos(lean / 2), Vec3<double>(std::sin(lean / 2), 0, 0)} * release.q_LB;
      still.release.quaternion_LB = {turned.w, turned.v[0], turned.v[1], turned.v[2]};
      still.release.angular_velocity_body_rad_s = {release.w_XB_B[0], release.w_XB_B[1], release.w_XB_B[2]};
      still.release.tilt_deg = still.release.azimuth_deg = still.release.spin_angle_deg = still.release.spin_rad_s = 0;
      const RunResult other = run(still);
      ASSERT_EQ(other.rows.size(), result.rows.size());
      for (std::size_t i = 0; i < other.rows.size(); ++i) {
        const Mat3<double> seen = about_east(-lean) * matrix(other.rows[i].q_LB);
        const Mat3<double> made = matrix(rotating ? result.rows[i].q_LB : result.rows[i].ref_q_LB);
        EXPECT_LT((seen - made).norm(), other.attitude_bound_rad + result.attitude_bound_rad + rounding(40)) << i << rotating;
      }
    }
    EXPECT_GT(result.drift.axis_final_rad, 1e-3);
    constexpr double kSmall = 1e-8;  // so that the lines above can fail: of leans of 1e-3 rad
    EXPECT_LT(result.attitude_bound_rad, kSmall);
  }
}

/// Upward 2 Omega v sin C cos(latitude) + v^2/R less than gravity on the sphere, and on the ellipsoid with its two radii.
TEST(TravelClosedForms, GravityAboardIsLessByEotvosFormula) {
  for (const TravelFigure figure : {TravelFigure::wgs84, TravelFigure::sphere})
    for (const double course : {20.0, 90.0, 130.0, 255.0}) {
      Scenario s = testing::toy_top();
      s.site.latitude_deg = -37, s.site.height_m = 2000;
      s.travel = sailing(TravelPath::rhumb, course, 200);
      s.travel->figure = figure;
      const LaboratoryNow<double> now(Scene(s).model<double>(), 0.0);
      const Radii R = radii(s, -37, 2000);
      const double east = 200 * std::sin(course * kDegree), north = 200 * std::cos(course * kDegree);
      const double less =
          2 * s.rotation_rate_rad_s * east * std::cos(37 * kDegree) + east * east / R.prime + north * north / R.meridian;
      EXPECT_NEAR(now.field_L[2] + s.site.gravity_m_s2, less, rounding(8 * 9.8)) << course;
    }
}

/// To the West as fast as the Earth turns: a body that is let go at rest stays at rest.
TEST(TravelClosedForms, TheSkyStopsOnAWesterlyCourse) {
  for (const double latitude : {0.0, 40.0}) {
    Scenario s = testing::travel_scenario(testing::travel_case("T4"));
    s.site.latitude_deg = latitude;
    s.travel = sailing(TravelPath::rhumb, 270, 1);
    s.travel->speed_m_s = s.rotation_rate_rad_s * radii(s, latitude, 0).prime * std::cos(latitude * kDegree);
    s.release.angular_velocity_body_rad_s = {0, 0, 0};
    s.release.rates_relative_to = RatesRelativeTo::laboratory;
    s.duration_s = 3600, s.output_step_s = 600;
    const RunResult result = run(s);
    const Mat3<double> first = matrix(result.rows.front().q_LB);
    for (const DriftRow& row : result.rows) EXPECT_LT((matrix(row.q_LB) - first).norm(), rounding(40)) << row.t_s;
  }
}

}  // namespace
}  // namespace earthtop
