/// Hard cases, each held to an independent criterion: an exact equivalence, a closed form, an invariant or a symmetry.

#include <gtest/gtest.h>

#include "support/scenes.hpp"

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

// The meaning of the initial rates is a declared choice; it moves the drift by half a percent here.
TEST(HardCases, H1MatchingRuleChangesTheDrift) {
  Scenario s = testing::heavy_rotor_top();
  EXPECT_NEAR(run(s).drift.axis_final_rad, 6.6176e-5, 0.5e-9);
  s.release.rates_relative_to = RatesRelativeTo::inertial;
  EXPECT_NEAR(run(s).drift.axis_final_rad, 6.5877e-5, 0.5e-9);
}

// At a pole the laboratory motion is the non-rotating one, seen from a frame that turns: any body, inertial rates.
TEST(HardCases, H4PoleEquivalenceOfAnAsymmetricBody) {
  for (const double latitude : {90.0, -90.0})
    for (const testing::Equations& equations : testing::kEquations) {
      SCOPED_TRACE(::testing::Message() << latitude << " " << equations);
      Scenario s = testing::asymmetric_top();
      s.site.latitude_deg = latitude;
      equations.take(s);
      s.release.rates_relative_to = RatesRelativeTo::inertial;
      const RunResult r = run(s);
      ASSERT_LT(r.attitude_bound_rad, 1e-9);
      for (const DriftRow& row : r.rows) {
        const double angle = -s.rotation_rate_rad_s * (latitude > 0 ? 1 : -1) * row.t_s;
        const Mat3<double> turn = Rotation<double>::about(Vec3<double>::UnitZ(), angle).matrix();
        ASSERT_LT(attitude_distance(attitude(row.q_LB), turn * attitude(row.ref_q_LB)), 2 * r.attitude_bound_rad);
        // The same statement without subtracting trajectories: the whole drift is that turn, exactly.
        ASSERT_NEAR(row.drift_attitude_rad, std::abs(angle), 1e-9 * std::abs(angle) + 1e-18);
      }
    }
}

// Without a gravity torque the same holds at every latitude, about the celestial axis.
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

/// Direction of the plane of swing over rows [from, to): the long axis of the second moments about their mean (rad).
double swing_plane(const std::vector<DriftRow>& rows, std::size_t from, std::size_t to) {
  double x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  const double n = static_cast<double>(to - from);
  for (std::size_t i = from; i < to; ++i) x += rows[i].axis_L[0] / n, y += rows[i].axis_L[1] / n;
  for (std::size_t i = from; i < to; ++i) {
    const double dx = rows[i].axis_L[0] - x, dy = rows[i].axis_L[1] - y;
    xx += dx * dx, xy += dx * dy, yy += dy * dy;
  }
  return std::atan2(2 * xy, xx - yy) / 2;
}

// The textbook rate -Omega sin(latitude) holds for a point bob only: the bob's own turning in space precesses it back.
TEST(HardCases, H6FoucaultPendulumWithAFiniteBob) {
  const double Omega = 2e-4;
  for (const double latitude : {90.0, 45.0, -30.0})
    for (const double ratio : {1e-4, 0.01, 0.1, 0.5}) {
      Scenario s;
      s.site = {latitude, 0, 0, 9.80665};
      s.rotation_rate_rad_s = Omega;
      s.body.mass_kg = 1;
      s.body.center_of_mass_m = {0, 0, -1};
      set_principal(s.body, 1.5, 1.5, 1.5 * ratio);
      const double period = 2 * real::pi<double>() / std::sqrt(9.80665 / 1.5);
      s.release.tilt_deg = 1e-4 * 180 / real::pi<double>();
      s.release.azimuth_deg = 90;  // to the East or West the tilt adds nothing to the turning about the string
      s.duration_s = 60 * period;
      s.output_step_s = period / 32;
      const RunResult r = run(s);
      const std::size_t window = 32 * 10, last = r.rows.size() - 1;
      const double angle = swing_plane(r.rows, last - window, last) - swing_plane(r.rows, 0, window);
      const double rate = std::remainder(angle, real::pi<double>()) / (50 * period);
      const double sine = sin_cos_degrees(latitude).sin;
      EXPECT_NEAR(rate / (-Omega * sine), 1 - ratio / 2, 1e-5) << "latitude " << latitude << ", I3/I1 " << ratio;
    }
}

// No vertical equilibrium on Earth: a sleeping top leans to the South, in both hemispheres.
TEST(HardCases, H7SleepingTopLeansSouth) {
  const struct { double spin, lean; } cases[] = {{200, 4.19e-5}, {400, 8.41e-5}, {800, 1.683e-4}};
  for (const double latitude : {45.0, -45.0})
    for (const auto& c : cases) {
      if (latitude < 0 && c.spin > 200) continue;
      Scenario s = testing::heavy_rotor_top();
      s.site.latitude_deg = latitude;
      s.release.quaternion_LB.reset();
      s.release.angular_velocity_body_rad_s.reset();
      s.release.tilt_deg = 0;
      s.release.spin_rad_s = c.spin;
      // Three turns of the slow precession, which is what carries the axis round its leaning rest.
      const double mgl = 5 * 0.004 * 9.80665;
      s.duration_s = 3 * 2 * real::pi<double>() * 8e-4 * c.spin / mgl;
      s.output_step_s = s.duration_s / 500;
      double south = 0, east = 0;
      const RunResult r = run(s);
      for (const DriftRow& row : r.rows) south -= row.axis_L[1] / 501, east += row.axis_L[0] / 501;
      EXPECT_NEAR(south, c.lean, 0.01 * c.lean) << latitude << " " << c.spin;
      EXPECT_LT(std::abs(east), 0.01 * c.lean);
    }
}

Scenario unit_weight_body(double I12, double I3) {
  Scenario s;
  s.site = {0, 0, 0, 10};
  s.rotation_rate_rad_s = 0;
  s.body.mass_kg = 0.1;
  s.body.center_of_mass_m = {1, 0, 0};
  set_principal(s.body, I12, I12, I3);
  s.duration_s = 100;
  s.output_step_s = 0.5;
  return s;
}

TEST(HardCases, H13KovalevskayaIntegral) {
  Scenario s = unit_weight_body(2, 1);
  s.duration_s = 200;
  s.release.tilt_deg = 70;
  s.release.spin_angle_deg = 33;
  s.release.angular_velocity_body_rad_s = {0.3, -0.7, 1.1};
  double first = 0;
  for (const DriftRow& row : run(s).rows) {
    const auto [p, q, w3] = row.w_LB_B;
    const Vec3<double> up = attitude(row.q_LB).row(2).transpose();
    const double K = std::pow(p * p - q * q - up[0], 2) + std::pow(2 * p * q - up[1], 2);
    if (row.t_s == 0) first = K;
    EXPECT_NEAR(K, first, 1e-11);
  }
}

TEST(HardCases, H14GoryachevChaplyginIntegral) {
  Scenario s = unit_weight_body(4, 1);
  const double tilt = 70;
  s.release.tilt_deg = tilt;
  // L.up = 0: 4 p up_1 + 4 q up_2 + w3 up_3 = 0 with up = (-sin, 0, cos) at spin angle 0.
  const SinCos<double> t = sin_cos_degrees(tilt);
  s.release.angular_velocity_body_rad_s = {0.4, -0.3, 4 * 0.4 * t.sin / t.cos};
  double first = 0;
  for (const DriftRow& row : run(s).rows) {
    const auto [p, q, w3] = row.w_LB_B;
    const double F = w3 * (p * p + q * q) - p * attitude(row.q_LB)(2, 2);
    if (row.t_s == 0) first = F;
    EXPECT_NEAR(F, first, 1e-10);
  }
}

// Released at rest, the axis falls to cos(theta1) = L - sqrt(L^2 - 2 L cos(theta0) + 1) and rises back to its cusp.
TEST(HardCases, H15CuspedTop) {
  Scenario s = testing::non_rotating(testing::toy_top());
  s.release.tilt_deg = 40;
  s.duration_s = 0.3;
  s.output_step_s = 1e-4;
  const double momentum = 4e-5 * 200, mgl = 0.1 * 0.03 * 9.80665;
  const double L = momentum * momentum / (4 * 1.2e-4 * mgl), u0 = sin_cos_degrees(40.0).cos;
  const double u1 = L - std::sqrt(L * L - 2 * L * u0 + 1);
  const RunResult r = run(s);
  double lowest = 2, highest = -2;
  for (std::size_t i = 1; i + 1 < r.rows.size(); ++i) {
    // The vertex of the parabola through three rows; its error is (h w_nutation)^4, 1e-10 of the swing.
    const double a = r.rows[i - 1].axis_L[2], b = r.rows[i].axis_L[2], c = r.rows[i + 1].axis_L[2];
    const double curvature = a - 2 * b + c;
    if ((b <= a && b <= c) || (b >= a && b >= c)) {
      const double vertex = b - (c - a) * (c - a) / (8 * curvature);
      lowest = std::min(lowest, vertex), highest = std::max(highest, vertex);
    }
  }
  EXPECT_NEAR(lowest, u1, 1e-9);
  EXPECT_NEAR(highest, u0, 1e-9);
}

TEST(HardCases, H16SteadyPrecessionAtAnyTilt) {
  for (const double tilt : {0.5, real::pi<double>() / 2, 2.5})
    for (const Precession which : {Precession::steady_slow, Precession::steady_fast}) {
      if (tilt == real::pi<double>() / 2 && which == Precession::steady_fast) continue;
      Scenario s = testing::non_rotating(testing::heavy_rotor_top());
      s.release.quaternion_LB.reset();
      s.release.angular_velocity_body_rad_s.reset();
      s.release.tilt_deg = tilt == real::pi<double>() / 2 ? 90 : tilt * 180 / real::pi<double>();
      s.release.azimuth_deg = 0;
      s.release.spin_rad_s = 200;
      s.release.precession = which;
      s.duration_s = 8;
      s.output_step_s = 0.02;
      const double momentum = 8e-4 * 200, mgl = 5 * 0.004 * 9.80665, c = 2 * 5e-4 * std::cos(tilt);
      const double root = std::sqrt(momentum * momentum - 2 * c * mgl);
      const double rate = which == Precession::steady_fast ? (momentum + root) / c : 2 * mgl / (momentum + root);
      for (const DriftRow& row : run(s).rows) {
        EXPECT_NEAR(tilt_sine(row.axis_L), std::sin(tilt), 1e-11);
        // The axis leans North at first: counterclockwise is toward the West.
        const double angle = std::remainder(std::atan2(-row.axis_L[0], row.axis_L[1]) - rate * row.t_s, 2 * real::pi<double>());
        EXPECT_NEAR(angle, 0, 1e-10 + 1e-13 * std::abs(rate * row.t_s));
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
      EXPECT_NEAR(row.drift_axis_rad, std::abs(row.drift_tilt_rad), 1e-15);
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

// A pendulum swung through the vertical to within 1e-12 rad: no Euler angle, no singularity.
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
  EXPECT_LT(r.invariants.at(1).largest_change, 1e-11 * r.invariants.at(1).scale);
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

// Turn back every rate, the Earth's too, and the top returns.
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

/// All drift numbers of two runs, bit for bit.
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

// At a pole the azimuth of the release is no matter, and a symmetric top does not know its spin angle.
TEST(HardCases, H23IrrelevantAngles) {
  Scenario s = testing::toy_top();
  s.duration_s = 5;
  const RunResult plain = run(s);
  s.release.spin_angle_deg = 77;
  const RunResult turned = run(s);
  EXPECT_NEAR(turned.drift.axis_final_rad, plain.drift.axis_final_rad, 1e-10 * plain.drift.axis_final_rad);
  s.site.latitude_deg = 90;
  const RunResult at_pole = run(s);
  s.release.azimuth_deg = -33;
  EXPECT_NEAR(run(s).drift.axis_final_rad, at_pole.drift.axis_final_rad, 1e-10 * at_pole.drift.axis_final_rad);
}

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

// The review of the progress after a million steps sees the time within a row, not that of the row before.
TEST(StepLimit, MillionsOfFixedStepsInOneRowAreAllowed) {
  Scenario s = testing::heavy_rotor_top();
  s.duration_s = s.output_step_s = 1.5;
  s.numerics.method = Method::abm8;
  s.numerics.step_s = 1e-6;
  EXPECT_EQ(run(s).status, RunStatus::completed);
}

}  // namespace
}  // namespace earthtop
