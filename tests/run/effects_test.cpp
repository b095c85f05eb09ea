// SPDX-License-Identifier: GPL-3.0-or-later
// Runs with applied torques: three observers, higher precision, an Earth that turns hardly or not at all, the ledger.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

#include "earthtop/model/body.hpp"
#include "earthtop/results/results.hpp"
#include "earthtop/run.hpp"
#include "support/effect_scenes.hpp"
#include "support/tolerances.hpp"

namespace earthtop {
namespace {

using testing::busy_scene, testing::gyrocompass, testing::held_rotor, testing::spinning_top;

// The Earth turns uniformly, so that its transverse torque is zero, and not the remainder of torques that cancel.
TEST(Effects, WithoutTheTorquesThatActThereIsNoDrift) {
  Scenario s = testing::toy_top();
  s.duration_s = 1;
  s.effects.coriolis = s.effects.centrifugal = false;
  for (const double viscous : {0.0, 1e-7}) {
    s.effects.applied.viscous_N_m_s = viscous;
    for (const DriftRow& row : run(s).rows) {
      EXPECT_EQ(row.drift_axis_rad, 0);
      EXPECT_EQ(row.drift_attitude_rad, 0);
    }
  }
}

TEST(Effects, AllObserversAndMoreBitsAgree) {
  for (const Scenario& scene : {busy_scene(), held_rotor(), testing::apparatus_scene()}) {
    SCOPED_TRACE(scene.name);
    Scenario extended = scene;
    extended.precision = Precision::bits113;
    extended.numerics.relative_tolerance = 1e-20;
    const RunResult truth = run(extended);
    ASSERT_EQ(truth.status, RunStatus::completed) << why_limited(truth);
    for (const Observer observer : {Observer::laboratory, Observer::body, Observer::inertial}) {
      SCOPED_TRACE(to_string(observer));
      Scenario s = scene;
      s.numerics.observer = observer;
      const RunResult result = run(s);
      ASSERT_EQ(result.status, RunStatus::completed);
      for (std::size_t i = 1; i < result.rows.size(); ++i) {
        const DriftRow &row = result.rows[i], &exact = truth.rows[i];
        EXPECT_NEAR(row.drift_axis_rad, exact.drift_axis_rad, row.drift_axis_bound_rad);
        EXPECT_NEAR(row.drift_axis_rad, exact.drift_axis_rad,
                    testing::truncation(s.numerics.relative_tolerance, 10) * exact.drift_axis_rad);
        EXPECT_NEAR(row.drift_attitude_rad, exact.drift_attitude_rad, row.drift_attitude_bound_rad);
        for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(row.axis_L[k], exact.axis_L[k], result.attitude_bound_rad);
      }
    }
  }
}

// A plumb line under a constant push to the East swings by (1 - cos(w t)) a/g, about a new rest position.
TEST(Effects, APendulumLeansWithTheTide) {
  Scenario s = testing::toy_top();
  s.release = {};
  s.release.tilt_deg = 180;
  const double push = 1e-4, g = s.site.gravity_m_s2;
  s.effects.tide = TideSpec{true, {}, {push, 0, 0}, 0, 90};
  const auto body = make_body<double>(s.body);
  const double w = std::sqrt(body.mass * g * body.p_PBcm_B[2] / body.I_BP_B(0, 0));
  s.duration_s = s.output_step_s = 1 / w;
  const DriftRow row = run(s).rows.back();
  EXPECT_NEAR(row.ref_axis_L[0], (1 - std::cos(1.0)) * push / g, std::pow(push / g, 3));
  EXPECT_EQ(row.ref_axis_L[1], 0);
}

TEST(Effects, AnEarthThatDoesNotTurnMakesNoDrift) {
  Scenario held = testing::non_rotating(gyrocompass(30, 10, 1e-5));
  held.duration_s = 0.5, held.output_step_s = 0.1;
  Scenario rubbed = spinning_top();
  rubbed.effects.applied.viscous_N_m_s = 1e-5, rubbed.effects.applied.coulomb_N_m = 4e-3;
  for (const Scenario& s :
       {testing::non_rotating(busy_scene()), testing::non_rotating(testing::apparatus_scene()), held, rubbed}) {
    const RunResult result = run(s);
    ASSERT_EQ(result.status, RunStatus::completed);
    for (const DriftRow& row : result.rows) {
      EXPECT_EQ(row.drift_axis_rad, 0);
      EXPECT_EQ(row.drift_attitude_rad, 0);
      EXPECT_EQ(row.drift_tilt_rad, 0);
      EXPECT_EQ(row.drift_spin_rad, 0);
    }
  }
}

TEST(Effects, ATinyRatesDriftIsInProportion) {
  for (const Scenario& scene : {gyrocompass(30, 10, 1e-5), busy_scene(), testing::apparatus_scene()}) {
    Scenario s = scene;
    s.duration_s = 0.5, s.output_step_s = 0.1;
    s.rotation_rate_rad_s = 1e-300;
    const RunResult tiny = run(s);
    s.rotation_rate_rad_s = 1e-9;
    const RunResult small = run(s);
    ASSERT_EQ(tiny.rows.size(), small.rows.size());
    for (std::size_t i = 1; i < tiny.rows.size(); ++i) {
      EXPECT_GT(tiny.rows[i].drift_axis_rad, 0);
      EXPECT_NEAR(tiny.rows[i].drift_axis_rad * 1e300 / (small.rows[i].drift_axis_rad * 1e9), 1, 1e-6);
      EXPECT_NEAR(tiny.rows[i].drift_attitude_rad * 1e300 / (small.rows[i].drift_attitude_rad * 1e9), 1, 1e-6);
    }
  }
}

TEST(Effects, EveryObserversLedgerBalances) {
  Scenario held = gyrocompass(30, 10, 1e-5);
  held.effects.applied.viscous_N_m_s = 1e-5;
  held.effects.coriolis = false;
  held.duration_s = 0.5, held.output_step_s = 0.1;
  Scenario rubbed = spinning_top();
  rubbed.rotation_rate_rad_s = 0.01;
  rubbed.effects.applied.coulomb_N_m = 8e-4;  // stops after the end
  for (const Scenario& scene : {busy_scene(), testing::apparatus_scene(), held, rubbed})
    for (const LedgerObserver observer :
         {LedgerObserver::inertial, LedgerObserver::laboratory, LedgerObserver::platform, LedgerObserver::body}) {
      Scenario s = scene;
      s.ledger = observer;
      const RunResult result = run(s);
      ASSERT_TRUE(result.ledger);
      EXPECT_GT(result.ledger->largest.tau_phys, 0);
      EXPECT_LT(result.ledger->largest.relative_residual(), 1e-14) << to_string(observer);
    }
}

// At release the state is the same with and without effects, so the physical torques differ by the sum of the effects' columns.
TEST(Effects, TheLedgerNamesTheirShares) {
  const std::pair<Scenario, std::string> scenes[] = {
      {busy_scene(), "tau_friction_x_N_m,tau_friction_y_N_m,tau_friction_z_N_m"},
      {testing::apparatus_scene(),
       "tau_friction_x_N_m,tau_friction_y_N_m,tau_friction_z_N_m,tau_support_x_N_m,tau_support_y_N_m,tau_support_z_N_m,"
       "tau_given_x_N_m,tau_given_y_N_m,tau_given_z_N_m"}};
  for (const auto& [scene, columns] : scenes) {
    Scenario with = scene;
    with.ledger = LedgerObserver::laboratory;
    Scenario without = with;
    without.effects.applied = {};
    without.effects.tide.reset();
    const RunResult busy = run(with), plain = run(without);
    const LedgerRow<double>&a = busy.ledger->entries.front(), &b = plain.ledger->entries.front();
    const auto vector = [](const std::array<double, 3>& v) { return Vec3<double>(v[0], v[1], v[2]); };
    Vec3<double> shares = Vec3<double>::Zero();
    for (const std::array<double, 3>& share : a.share_A) shares += vector(share);
    EXPECT_GT(norm(shares), 0);
    // A few roundings of torques of this size.
    EXPECT_LT(norm(Vec3<double>(vector(a.tau_phys_A) - vector(b.tau_phys_A) - shares)), 1e-15 * norm(vector(a.tau_phys_A)));
    const std::string header = torques_csv(busy).substr(0, torques_csv(busy).find('\n'));
    EXPECT_TRUE(header.ends_with(columns)) << header;
    EXPECT_TRUE(torques_csv(plain).find("tau_friction") == std::string::npos);
  }
}

// A compass swings about North, and a mean over some part of a swing is no trend. One that is released with a turn has a mean rate.
TEST(Effects, ACompassReleasedAtRestHasNoTrend) {
  for (const double latitude_deg : {0.0, 48.0, -70.0, 90.0})
    for (const double amplitude_deg : {10.0, 120.0})
      for (const double damping : {0.0, 1e-5}) {
        Scenario s = gyrocompass(latitude_deg, amplitude_deg, damping);
        s.duration_s = 30;
        s.output_step_s = 0.5;
        const RunResult result = run(s);
        ASSERT_TRUE(result.drift.secular.has_value());
        EXPECT_FALSE(result.drift.secular->azimuth_rate_rad_s) << latitude_deg << " " << amplitude_deg;
        EXPECT_FALSE(result.drift.secular->azimuth_oscillation_rad);
        EXPECT_EQ(result.drift.secular->reason,
                  "the axis is released at rest in its gimbal: it swings to and fro, and its azimuth has no secular rate");
      }
  Scenario turning = gyrocompass(48, 10, 0);
  turning.duration_s = 30;
  turning.release.precession = Precession::given;
  turning.release.precession_rate_rad_s = 2;
  EXPECT_TRUE(run(turning).drift.secular->azimuth_rate_rad_s.has_value());
}

}  // namespace
}  // namespace earthtop
