// SPDX-License-Identifier: GPL-3.0-or-later
/// Hard cases in all four forms of the equations, and limits of these forms. The other hard cases are scenarios/hard, which
/// `earthtop verify` judges.

#include <gtest/gtest.h>

#include "earthtop/frames/earth.hpp"
#include "support/scenes.hpp"
#include "support/tolerances.hpp"

namespace earthtop {
namespace {

using testing::set_principal;

Mat3<double> attitude(const std::array<double, 4>& q) {
  return rotation_matrix(Quaternion<double>{q[0], Vec3<double>(q[1], q[2], q[3])});
}
double attitude_distance(const Mat3<double>& A, const Mat3<double>& B) {
  const Mat3<double> D = A.transpose() * B;
  return norm(Vec3<double>(D(2, 1) - D(1, 2), D(0, 2) - D(2, 0), D(1, 0) - D(0, 1))) / 2;
}
double tilt_sine(const std::array<double, 3>& axis) { return std::hypot(axis[0], axis[1]); }

// The frame to which the initial rates refer is a declared choice; here it changes the drift by half a percent.
TEST(HardCases, H1MatchingRuleChangesTheDrift) {
  Scenario s = testing::heavy_rotor_top();
  EXPECT_NEAR(run(s).drift.axis_final_rad, 6.6176e-5, 0.5e-9);
  s.release.rates_relative_to = RatesRelativeTo::inertial;
  EXPECT_NEAR(run(s).drift.axis_final_rad, 6.5877e-5, 0.5e-9);
}

// At a pole, with inertial rates, any body's laboratory motion is the non-rotating one seen from a turning frame.
TEST(HardCases, H4PoleEquivalenceOfAnAsymmetricBody) {
  for (const double latitude : {90.0, -90.0})
    for (const testing::Equations& equations : testing::kEquations) {
      SCOPED_TRACE(::testing::Message() << latitude << " " << equations);
      Scenario s = testing::asymmetric_top();
      s.site.latitude_deg = latitude;
      equations.take(s);
      s.release.rates_relative_to = RatesRelativeTo::inertial;
      const RunResult r = run(s);
      ASSERT_LT(r.attitude_bound_rad, 2e-9);
      for (const DriftRow& row : r.rows) {
        const double angle = -s.rotation_rate_rad_s * (latitude > 0 ? 1 : -1) * row.t_s;
        const Mat3<double> turn = Rotation<double>::about(Vec3<double>::UnitZ(), angle).matrix();
        ASSERT_LT(attitude_distance(attitude(row.q_LB), turn * attitude(row.ref_q_LB)), 2 * r.attitude_bound_rad);
        // The same statement without subtracting trajectories: the whole drift is that turn, exactly.
        ASSERT_NEAR(row.drift_attitude_rad, std::abs(angle), 1e-9 * std::abs(angle) + 1e-18);
      }
    }
}

// Without a gravity torque the same holds at every latitude, for turns about the celestial axis.
TEST(HardCases, H5FreeBodyKeepsItsMotionInSpace) {
  for (const double latitude : {-90.0, -33.0, 0.0, 51.0})
    for (const testing::Equations& equations : testing::kEquations) {
      Scenario s = testing::asymmetric_top();
      s.site.latitude_deg = latitude;
      s.body.center_of_mass_m = {0, 0, 0};
      equations.take(s);
      s.release.rates_relative_to = RatesRelativeTo::inertial;
      s.release.angular_velocity_body_rad_s = {5, 20, 30};
      const Vec3<double> n = celestial_axis_L<double>(s.site);
      for (const DriftRow& row : run(s).rows) {
        const double angle = s.rotation_rate_rad_s * row.t_s;
        const Mat3<double> turn = Rotation<double>::about(n, -angle).matrix();
        ASSERT_LT(attitude_distance(attitude(row.q_LB), turn * attitude(row.ref_q_LB)), 1e-11) << latitude;
        ASSERT_NEAR(row.drift_attitude_rad, angle, 1e-9 * angle);
      }
    }
}

TEST(HardCases, H17VerticalAxes) {
  for (const double tilt : {0.0, 180.0}) {
    Scenario s = testing::toy_top();
    s.release.tilt_deg = tilt;
    s.duration_s = 5;
    const RunResult r = run(s);
    EXPECT_EQ(r.status, RunStatus::completed);
    for (const DriftRow& row : r.rows) {
      // The reference stays exactly vertical, so its azimuth is not defined, nor is the difference.
      EXPECT_EQ(tilt_sine(row.ref_axis_L), 0);
      EXPECT_FALSE(row.drift_azimuth_rad.has_value());
      EXPECT_NEAR(row.drift_axis_rad, std::abs(row.drift_tilt_rad), testing::rounding(40) * row.drift_axis_rad);
    }
    EXPECT_GT(r.drift.axis_max_rad, 1e-6);
    EXPECT_FALSE(r.drift.secular.has_value());
  }
  // Nearly vertical: continuous in the tilt.
  Scenario s = testing::toy_top();
  s.duration_s = 2;
  const auto final_drift = [&](double tilt) {
    s.release.tilt_deg = tilt;
    return run(s).drift.axis_final_rad;
  };
  const double exactly = final_drift(0);
  EXPECT_NEAR(final_drift(1e-12 * 180 / real::pi<double>()), exactly, 1e-9 * exactly);
  EXPECT_NEAR(final_drift(1e-6), exactly, 1e-4 * exactly);
}

// A pendulum that passes the vertical within 1e-12 rad: without Euler angles there is no singularity.
TEST(HardCases, H17PassageThroughTheVertical) {
  Scenario s = testing::non_rotating(testing::toy_top());
  s.body.center_of_mass_m = {0, 0, -0.03};
  s.release.tilt_deg = 30;
  s.release.spin_rad_s = 0;
  s.duration_s = 10;
  s.output_step_s = 0.01;
  const RunResult r = run(s);
  for (const DriftRow& row : r.rows) {
    // Released toward the East at rest, it never leaves the East-Up plane, and its energy keeps it within 30 degrees.
    EXPECT_LT(std::abs(row.axis_L[1]), 1e-13);
    EXPECT_GT(row.axis_L[2], sin_cos_degrees(30.0).cos - 1e-12);
  }
  EXPECT_LT(r.invariants.at(1).largest_change, testing::rounding(100) * r.invariants.at(1).scale);
}

TEST(HardCases, H18NearlyEqualMomentsGiveNearlyTheSameMotion) {
  const auto final_axis = [](double excess) {
    Scenario s = testing::toy_top();
    s.duration_s = 10;
    s.release.angular_velocity_body_rad_s = {3, -2, 100};
    set_principal(s.body, 1.2e-4 * (1 + excess), 1.2e-4, 4e-5);
    return run(s).rows.back();
  };
  const DriftRow equal = final_axis(0);
  for (const double excess : {1e-12, 1e-15}) {
    const DriftRow other = final_axis(excess);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(other.axis_L[i], equal.axis_L[i], 100 * excess + 2e-12);
    EXPECT_NEAR(other.drift_axis_rad, equal.drift_axis_rad, 1e-9 * equal.drift_axis_rad);
  }
}

// If every rate is reversed, the Earth's too, the top returns to its start.
TEST(HardCases, H22TimeReversal) {
  for (const testing::Equations& equations : testing::kEquations) {
    Scenario s = testing::heavy_rotor_top();
    s.duration_s = 60;
    s.output_step_s = 1;
    s.rotation_rate_rad_s = 0.01;
    equations.take(s);
    const RunResult forth = run(s);
    Scenario back = s;
    back.rotation_rate_rad_s = -s.rotation_rate_rad_s;
    const DriftRow& end = forth.rows.back();
    back.release.quaternion_LB = end.q_LB;
    back.release.angular_velocity_body_rad_s = {-end.w_LB_B[0], -end.w_LB_B[1], -end.w_LB_B[2]};
    const DriftRow returned = run(back).rows.back();
    EXPECT_LT(attitude_distance(attitude(returned.q_LB), attitude(forth.rows.front().q_LB)), 1e-9);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(returned.axis_L[i], forth.rows.front().axis_L[i], 1e-10);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(-returned.w_LB_B[i], forth.rows.front().w_LB_B[i], 1e-8);
  }
}

/// Checks that all drift numbers of two runs agree bit for bit.
void expect_same_drift(const RunResult& a, const RunResult& b, double azimuth_sign = 1) {
  ASSERT_EQ(a.rows.size(), b.rows.size());
  for (std::size_t i = 0; i < a.rows.size(); ++i) {
    ASSERT_EQ(a.rows[i].drift_axis_rad, b.rows[i].drift_axis_rad) << "row " << i;
    ASSERT_EQ(a.rows[i].drift_attitude_rad, b.rows[i].drift_attitude_rad);
    ASSERT_EQ(a.rows[i].drift_tilt_rad, b.rows[i].drift_tilt_rad);
    ASSERT_EQ(a.rows[i].drift_azimuth_rad.value(), azimuth_sign * b.rows[i].drift_azimuth_rad.value());
  }
}

class Symmetry : public ::testing::TestWithParam<std::tuple<testing::Equations, Method>> {
 protected:
  Scenario scene() const {
    Scenario s = testing::asymmetric_top();
    s.duration_s = 2;
    s.rotation_rate_rad_s = 0.01;
    std::get<0>(GetParam()).take(s);
    s.numerics.method = std::get<1>(GetParam());
    if (s.numerics.method == Method::abm8) s.numerics.step_s = 1e-3;
    return s;
  }
};

TEST_P(Symmetry, H23MassTimesAPowerOfTwoChangesNoBit) {
  const Scenario s = scene();
  Scenario heavy = s;
  heavy.body.mass_kg *= 1024;
  for (auto& row : heavy.body.inertia_kg_m2)
    for (double& value : row) value *= 1024;
  expect_same_drift(run(s), run(heavy));
}

TEST_P(Symmetry, H23TimeTimesAPowerOfTwoChangesNoBit) {
  const Scenario s = scene();
  Scenario fast = s;
  fast.duration_s /= 4;
  fast.output_step_s /= 4;
  fast.rotation_rate_rad_s *= 4;
  fast.release.spin_rad_s *= 4;
  fast.site.gravity_m_s2 *= 16;
  if (fast.numerics.step_s) *fast.numerics.step_s /= 4;
  expect_same_drift(run(s), run(fast));
}

TEST_P(Symmetry, H23MirrorNorthSouthChangesNoBit) {
  Scenario s = scene();
  s.release.azimuth_deg = 70;
  Scenario mirrored = s;
  mirrored.site.latitude_deg = -s.site.latitude_deg;
  mirrored.release.azimuth_deg = 180 - s.release.azimuth_deg;
  mirrored.release.spin_rad_s = -s.release.spin_rad_s;
  expect_same_drift(run(s), run(mirrored), -1);
}

INSTANTIATE_TEST_SUITE_P(AllObservers, Symmetry,
                         ::testing::Combine(::testing::ValuesIn(testing::kEquations),
                                            ::testing::Values(Method::automatic, Method::abm8)));

TEST(HardCases, H24NoNorthwardRateAtAPole) {
  for (const double latitude : {90.0, -90.0}) {
    const Vec3<double> axis = celestial_axis_L<double>(Site{latitude, 0, 0, 9.8});
    EXPECT_EQ(axis[1], 0.0);
    EXPECT_EQ(std::abs(axis[2]), 1.0);
    // A sleeping top at a pole has nowhere to lean: its axis stays exactly vertical.
    Scenario s = testing::toy_top();
    s.site.latitude_deg = latitude;
    s.release.tilt_deg = 0;
    s.duration_s = 2;
    for (const testing::Equations& equations : testing::kEquations) {
      equations.take(s);
      EXPECT_EQ(run(s).drift.axis_max_rad, 0.0);
    }
  }
}

// The check of the progress after a million steps uses the time within a row, not that of the row before.
TEST(StepLimit, MillionsOfFixedStepsInOneRowAreAllowed) {
  Scenario s = testing::heavy_rotor_top();
  s.duration_s = s.output_step_s = 1.5;
  s.numerics.method = Method::abm8;
  s.numerics.step_s = 1e-6;
  EXPECT_EQ(run(s).status, RunStatus::completed);
}

}  // namespace
}  // namespace earthtop
