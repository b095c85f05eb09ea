// SPDX-License-Identifier: GPL-3.0-or-later
/// Published and extended-precision values in all four forms of the equations, at default settings: benchmarks T1 and T7, and
/// the drift of a heavy top (T11). The others are scenarios/hard, which `earthtop verify` judges. The numbers come from
/// independent 113-bit Taylor integrations or closed forms; each is given to all printed digits.

#include <gtest/gtest.h>

#include "support/scenes.hpp"

namespace earthtop {
namespace {

using testing::set_principal;

/// The values have to be met to 1e-10; the default settings do far better.
constexpr double kPublished = 1e-10;

const DriftRow& row_at(const RunResult& result, double t) {
  for (const DriftRow& row : result.rows)
    if (std::abs(row.t_s - t) < 1e-12) return row;
  throw std::logic_error("no row at this time");
}

void expect_attitude(const std::array<double, 4>& q, std::array<double, 4> expected) {
  const double dot = q[0] * expected[0] + q[1] * expected[1] + q[2] * expected[2] + q[3] * expected[3];
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(q[i], dot < 0 ? -expected[i] : expected[i], kPublished) << "component " << i;
}
void expect_vector(const std::array<double, 3>& v, const std::array<double, 3>& expected, double tolerance = kPublished) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(v[i], expected[i], tolerance) << "component " << i;
}

Scenario without_earth(double gravity, double duration, double step) {
  Scenario s;
  s.site = {0, 0, 0, gravity};
  s.rotation_rate_rad_s = 0;
  s.duration_s = duration;
  s.output_step_s = step;
  return s;
}

TEST(PublishedValues, T1HeavyTopOfBrulsCardonaArnold) {
  Scenario s = without_earth(9.81, 10, 0.2);
  s.body.mass_kg = 15;
  s.body.center_of_mass_m = {0, 1, 0};
  set_principal(s.body, 0.234375, 0.46875, 0.234375);
  s.body.inertia_about = InertiaAbout::center_of_mass;
  s.release.quaternion_LB = {1, 0, 0, 0};
  s.release.angular_velocity_body_rad_s = {0, 150, -4.61538};
  for (const testing::Equations& equations : testing::kEquations) {
    SCOPED_TRACE(equations);
    equations.take(s);
    const RunResult r = run(s);
    expect_attitude(row_at(r, 0.2).q_LB,
                    {-0.70827915297431256211, 0.43878108812658189737, 0.54572839614541767342, 0.089399752824005010462});
    expect_attitude(row_at(r, 1).q_LB,
                    {0.73294398067966371815, -0.27828571933761267852, 0.53182461133416261792, -0.32017614273624928141});
    expect_attitude(row_at(r, 2).q_LB,
                    {0.12294713504153346710, -0.49107989255002701470, 0.35043003034362096184, -0.78798688755048566932});
    expect_attitude(r.rows.back().q_LB,
                    {0.71661952574042007196, -0.62343619117272875658, -0.056639501384527221664, 0.30753168576022919409});
    for (const DriftRow& row : r.rows) EXPECT_NEAR(row.w_LB_B[1], 150, 150 * kPublished);
    // Kinetic + potential energy about the pivot, published: 5435.69679086554687500 J.
    ASSERT_EQ(r.invariants.at(1).name, "reference_energy");
    EXPECT_NEAR(r.invariants.at(1).initial, 5435.69679086554687500, 1e-14 * 5436);
  }
}

/// The ladder top of T11.
Scenario ladder_top() {
  Scenario s;
  s.site = {45, 0, 0, 9.80665};
  s.body.mass_kg = 0.2;
  s.body.center_of_mass_m = {0, 0, 0.05};
  set_principal(s.body, 6e-4, 6e-4, 1.6e-4);
  return s;
}

TEST(PublishedValues, T7BalancedGyroscopeStaysInSpace) {
  Scenario s = testing::toy_top();
  s.body.center_of_mass_m = {0, 0, 0};
  set_principal(s.body, 4e-4, 4e-4, 5e-4);
  s.release.tilt_deg = 90;
  s.release.azimuth_deg = 90;
  s.release.rates_relative_to = RatesRelativeTo::inertial;
  s.release.spin_rad_s = 300;
  s.output_step_s = 10;
  for (const testing::Equations& equations : testing::kEquations) {
    equations.take(s);
    const RunResult r = run(s);
    expect_vector(r.rows.back().axis_L, {0.99999042852585771135, -0.0030937725087229706379, 0.0030937725087229706379},
                  300 * 60 * 2.2e-16);
  }
}

TEST(PublishedValues, T11HeavyTopDriftOnTheEarth) {
  Scenario s = ladder_top();
  s.release.tilt_deg = 30;
  s.release.azimuth_deg = 90;
  s.release.spin_rad_s = 200;
  s.release.precession = Precession::steady_slow;
  s.duration_s = 240;
  s.output_step_s = 0.5;
  const double arcsecond = real::pi<double>() / 648000;
  const struct {
    RatesRelativeTo rule;
    std::array<double, 4> azimuth_arcsec;  // counterclockwise, at 10, 60, 120, 240 s
    double tilt_arcsec;
  } cases[] = {{RatesRelativeTo::laboratory, {-105.383, -645.736, -1289.119, -2576.625}, 3.84},
               {RatesRelativeTo::inertial, {-103.858, -636.608, -1270.908, -2540.294}, 3.48}};
  for (const auto& c : cases) {
    s.release.rates_relative_to = c.rule;
    const RunResult r = run(s);
    const double times[] = {10, 60, 120, 240};
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(-row_at(r, times[i]).drift_azimuth_rad.value() / arcsecond, c.azimuth_arcsec[i], 0.0006) << times[i] << " s";
    double tilt = 0;
    for (const DriftRow& row : r.rows) tilt = std::max(tilt, std::abs(row.drift_tilt_rad));
    EXPECT_NEAR(tilt / arcsecond, c.tilt_arcsec, 0.02);
  }
}

}  // namespace
}  // namespace earthtop
