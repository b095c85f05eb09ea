// SPDX-License-Identifier: GPL-3.0-or-later
/// The drift at default settings compared with 113-bit arithmetic in another observer's equations, and how close its bound is.

#include <gtest/gtest.h>

#include <limits>

#include "support/scenes.hpp"
#include "support/soundness.hpp"
#include "support/tolerances.hpp"

namespace earthtop {
namespace {

using testing::expect_sound;
using testing::shipped;

class RandomScene : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(RandomScene, DriftAndBoundAgainstExtendedPrecision) { testing::expect_random_scene_sound(GetParam()); }
INSTANTIATE_TEST_SUITE_P(Seeds, RandomScene, ::testing::Range<std::uint64_t>(1000, 1008));

/// Shipped scenarios, shortened so that 113 bits stay affordable; the slow tests run them whole.
class ShippedScene : public ::testing::TestWithParam<std::pair<const char*, double>> {};

TEST_P(ShippedScene, DriftAndBoundAgainstExtendedPrecision) {
  Scenario scenario = shipped(GetParam().first);
  scenario.duration_s = GetParam().second;
  scenario.output_step_s = scenario.duration_s / 50;
  expect_sound(scenario, Observer::inertial);
}
INSTANTIATE_TEST_SUITE_P(Beginnings, ShippedScene,
                         ::testing::Values(std::pair("toy-top", 1.0), std::pair("fast-gyro", 0.3), std::pair("free-gyro", 0.5),
                                           std::pair("asymmetric-top", 2.0), std::pair("turntable", 1.0)));

// Three observers, each with its own state from release to end, and the reduced model of symmetric tops: attitudes and drifts
// agree within the stated bounds.
TEST(Observers, AgreeWithinTheirBounds) {
  std::vector<Scenario> scenes;
  for (const char* name : {"toy-top", "free-gyro", "asymmetric-top", "turntable"}) scenes.push_back(shipped(name));
  scenes.push_back(shipped("fast-gyro"));
  scenes.back().duration_s = 5;
  for (std::uint64_t seed = 2000; seed < 2010; ++seed) scenes.push_back(testing::random_scene(seed, 500));
  Scenario without_coriolis = testing::random_scene(2011, 500);
  without_coriolis.effects.coriolis = false;
  scenes.push_back(without_coriolis);
  Scenario without_centrifugal = testing::random_scene(2013, 500);
  without_centrifugal.effects.centrifugal = false;
  without_centrifugal.rotation_rate_rad_s = 1;
  scenes.push_back(without_centrifugal);
  Scenario on_a_ship = testing::random_scene(2015, 500);
  on_a_ship.platform = PlatformSpec{PlatformMotion::harmonic, {1, 1, 0.2}, 0, 0, 0.1, 0.7, 20, {0.1, -0.2, 0.3}};
  on_a_ship.rotation_rate_rad_s = 0.3;
  scenes.push_back(on_a_ship);
  for (Scenario& scene : scenes) {
    SCOPED_TRACE(scene.name);
    std::vector<RunResult> results;
    for (const testing::Equations& equations : testing::kEquations) {
      equations.take(scene);
      results.push_back(run(scene));
    }
    // An observer with wrong equations would only widen its own bound, so in the shipped scenes, none of which is chaotic,
    // bounds must be small, too.
    const double widest = scene.name.starts_with("random") ? std::numeric_limits<double>::infinity() : 1e-6;
    for (const RunResult& r : results) ASSERT_LT(r.drift.attitude_bound_rad, widest * r.drift.axis_max_rad);
    for (std::size_t a = 0; a < results.size(); ++a)
      for (std::size_t b = a + 1; b < results.size(); ++b)
        for (std::size_t i = 0; i < results[a].rows.size(); ++i) {
          const DriftRow &x = results[a].rows[i], &y = results[b].rows[i];
          ASSERT_LE(std::abs(x.drift_axis_rad - y.drift_axis_rad), x.drift_axis_bound_rad + y.drift_axis_bound_rad)
              << a << b << i;
          ASSERT_LE(std::abs(x.drift_attitude_rad - y.drift_attitude_rad),
                    x.drift_attitude_bound_rad + y.drift_attitude_bound_rad);
          const Quaternion<double> p{x.q_LB[0], Vec3<double>(x.q_LB[1], x.q_LB[2], x.q_LB[3])};
          const Quaternion<double> q{y.q_LB[0], Vec3<double>(y.q_LB[1], y.q_LB[2], y.q_LB[3])};
          ASSERT_LE(2 * norm((p.conjugate() * q).v), results[a].attitude_bound_rad + results[b].attitude_bound_rad + 4e-16);
        }
  }
}

// Output times that cut every step make the rows more exact than the tolerance says, and two runs of one method equally wrong;
// the bound must hold nevertheless.
TEST(Bounds, HoldWhereOutputTimesCutTheSteps) {
  const auto cut = [](const char* name, double duration, double step, Method method, double tolerance) {
    Scenario s = shipped(name);
    s.duration_s = duration;
    s.output_step_s = step;
    s.numerics.method = method;
    s.numerics.relative_tolerance = tolerance;
    return s;
  };
  std::vector<Scenario> scenes{
      cut("toy-top", 0.5, 0.02, Method::rkf78, 1e-3),       cut("toy-top", 0.5, 0.01, Method::rkf78, 1e-5),
      cut("toy-top", 0.5, 0.005, Method::rkf78, 1e-9),      cut("foucault-pendulum", 20, 0.15, Method::automatic, 1e-9),
      cut("cusped-top", 2, 0.015, Method::automatic, 1e-9), cut("toy-top", 0.2, 0.005, Method::extrapolation, 1e-6)};
  scenes.push_back(scenes[1]);
  scenes.back().numerics.form = ModelForm::general;
  for (const Scenario& scene : scenes) {
    SCOPED_TRACE(scene.name);
    const RunResult result = run(scene);
    ASSERT_EQ(result.status, RunStatus::completed);
    const auto reference = testing::reference_run(scene, Observer::body);
    const auto comparison = testing::compare(result, reference);
    EXPECT_GE(comparison.least_margin, 1);
    double attitude_error = 0;
    for (std::size_t i = 0; i < result.rows.size(); ++i) {
      const std::array<double, 4>& q = result.rows[i].q_LB;
      const Quaternion<float128> d = Quaternion<float128>{q[0], Vec3<float128>(q[1], q[2], q[3])}.conjugate() *
                                     reference.samples[i].state.q_LB.normalized();
      attitude_error = std::max(attitude_error, static_cast<double>(2 * norm(d.v)));
    }
    EXPECT_LE(attitude_error, result.attitude_bound_rad);
  }
}

// drift / Omega tends to a limit and is the same at every tiny rate, down to 1e-300 rad/s.
TEST(TinyRates, DriftOverOmegaIsOneNumber) {
  for (const testing::Equations& equations : testing::kEquations)
    for (const RatesRelativeTo rule : {RatesRelativeTo::laboratory, RatesRelativeTo::inertial})
      for (Scenario s : {testing::heavy_rotor_top(), testing::asymmetric_top()}) {
        s.duration_s = 2;
        s.output_step_s = 0.1;
        equations.take(s);
        s.release.rates_relative_to = rule;
        s.rotation_rate_rad_s = 1e-12;
        const RunResult at_1e_12 = run(s);
        for (const double Omega : {1e-9, -1e-9, 1e-15, 1e-18, 1e-30, 1e-100, 1e-200, 1e-300}) {
          s.rotation_rate_rad_s = Omega;
          const RunResult r = run(s);
          for (std::size_t i = 1; i < r.rows.size(); ++i) {
            const double expected = at_1e_12.rows[i].drift_axis_rad / 1e-12;
            ASSERT_NEAR(r.rows[i].drift_axis_rad / std::abs(Omega), expected, 1e-9 * expected) << Omega << " row " << i;
            ASSERT_NEAR(r.rows[i].drift_azimuth_rad.value() / Omega, at_1e_12.rows[i].drift_azimuth_rad.value() / 1e-12,
                        1e-8 * expected * 10)
                << Omega << " row " << i;
          }
        }
      }
}

// The value found by subtraction in 113 bits for the heavy-rotor top at 1 s.
TEST(TinyRates, H2DriftOverOmegaOfTheHeavyRotorTop) {
  Scenario s = testing::heavy_rotor_top();
  for (const double Omega : {1e-9, 1e-12, 1e-15, 1e-18}) {
    s.rotation_rate_rad_s = Omega;
    EXPECT_NEAR(run(s).drift.axis_final_rad / Omega, 0.907499753, 1e-9);
  }
}

// Without the Earth's rotation every drift column is exactly zero, with every method and observer, and on a platform too.
TEST(ZeroRate, H3DriftIsExactlyZero) {
  for (const Method method : {Method::automatic, Method::dopri5, Method::rkf78, Method::bulirsch_stoer, Method::abm8,
                              Method::dop853, Method::gauss, Method::splitting})
    for (const testing::Equations& equations : testing::kEquations)
      for (const bool platform : {false, true})
        for (const RatesRelativeTo rule : {RatesRelativeTo::laboratory, RatesRelativeTo::inertial})
          for (Scenario s : {testing::toy_top(), testing::asymmetric_top()}) {
            s.rotation_rate_rad_s = 0;
            s.duration_s = 0.5;
            s.numerics.method = method;
            equations.take(s);
            s.release.rates_relative_to = rule;
            if (platform) s.platform = PlatformSpec{PlatformMotion::ramp, {0, 0.3, 1}, 0.2, 1.0, 0, 0, 0, {0.3, 0, 0}};
            if (method == Method::abm8) s.numerics.step_s = 5e-4;
            if (Scene(s).method_refusal(method)) continue;
            const RunResult r = run(s);
            ASSERT_EQ(r.status, RunStatus::completed);
            for (const DriftRow& row : r.rows) {
              for (const double value :
                   {row.drift_axis_rad, row.drift_axis_bound_rad, row.drift_azimuth_rad.value(), row.drift_tilt_rad,
                    row.drift_attitude_rad, row.drift_attitude_bound_rad, row.drift_spin_rad}) {
                ASSERT_EQ(value, 0.0);
                ASSERT_FALSE(std::signbit(value));
              }
              ASSERT_EQ(row.q_LB, row.ref_q_LB);
              ASSERT_EQ(row.w_LB_B, row.ref_w_LB_B);
            }
          }
}

// Large angles: an Earth with 1 rad/s turns a free gyroscope past pi many times, and the closed form holds throughout.
TEST(LargeDrift, PastPiOnAFastEarth) {
  for (const testing::Equations& equations : testing::kEquations) {
    Scenario s = testing::toy_top();
    s.body.center_of_mass_m = {0, 0, 0};
    testing::set_principal(s.body, 4e-4, 4e-4, 5e-4);
    s.release.rates_relative_to = RatesRelativeTo::inertial;
    s.release.spin_rad_s = 50;
    s.rotation_rate_rad_s = 1;
    s.duration_s = 20;
    s.output_step_s = 0.05;
    equations.take(s);
    const RunResult r = run(s);
    const Vec3<double> n = celestial_axis_L<double>(s.site);
    const Vec3<double> axis(r.rows.front().axis_L[0], r.rows.front().axis_L[1], r.rows.front().axis_L[2]);
    const double sine = norm(Vec3<double>(n.cross(axis)));
    for (const DriftRow& row : r.rows) {
      EXPECT_NEAR(row.drift_axis_rad, 2 * std::asin(sine * std::abs(std::sin(row.t_s / 2))),
                  testing::truncation(s.numerics.relative_tolerance));
      EXPECT_NEAR(row.drift_attitude_rad, std::abs(std::remainder(row.t_s, 2 * real::pi<double>())),
                  testing::truncation(s.numerics.relative_tolerance));
    }
    // The axis turns clockwise about the celestial axis; its azimuth has gone round three times and is counted on.
    EXPECT_LT(std::abs(r.rows.back().drift_azimuth_rad.value()), 2 * real::pi<double>() * 4);
    for (std::size_t i = 1; i < r.rows.size(); ++i)
      EXPECT_LT(std::abs(r.rows[i].drift_azimuth_rad.value() - r.rows[i - 1].drift_azimuth_rad.value()), 1.0);
  }
}

}  // namespace
}  // namespace earthtop
