// SPDX-License-Identifier: GPL-3.0-or-later
// The effects of real apparatus on a top, against closed forms and integrations of the tests' own: friction of body axes apart, a
// given torque, a pendulum on an unequal support, and the air about a top on a table.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "earthtop/run.hpp"
#include "support/effect_cases.hpp"
#include "support/scenes.hpp"

namespace earthtop::apparatus {
namespace {

using std::numbers::pi;

RunResult result_of(Scenario s) {
  s.numerics.relative_tolerance = 1e-14;
  RunResult result = run(s);
  EXPECT_EQ(result.status, RunStatus::completed);
  return result;
}
Vec3<double> vec(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }
Mat3<double> matrix(const std::array<double, 4>& q) {
  return rotation_matrix(Quaternion<double>{q[0], Vec3<double>(q[1], q[2], q[3])});
}

/// A body that nothing but its own torques turns.
Scenario weightless(double I1, double I2, double I3) {
  Scenario s = testing::toy_top();
  s.site.gravity_m_s2 = 0;
  s.body.center_of_mass_m = {0, 0, 0};
  testing::set_principal(s.body, I1, I2, I3);
  s.duration_s = s.output_step_s = 2;
  return s;
}

// Theta dw/dt = (Theta w) x w - (k1 w1, k2 w2, k3 w3), by steps of the classical method of Runge and Kutta in 113 bits.
TEST(Apparatus, ABrickWithThreeDampingsTurnsAsEulersEquationsSay) {
  const std::array<double, 3> I = {3e-4, 5e-4, 7e-4}, k = {2e-4, 5e-5, 9e-5}, start = {3, 0.4, -2};
  Scenario s = weightless(I[0], I[1], I[2]);
  s.release.angular_velocity_body_rad_s = start;
  s.effects.applied.viscous_by_axis_N_m_s = k;
  using Rates = std::array<float128, 3>;
  const auto slope = [&](const Rates& w) {
    Rates d;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t a = (i + 1) % 3, b = (i + 2) % 3;
      d[i] = ((float128(I[a]) - float128(I[b])) * w[a] * w[b] - float128(k[i]) * w[i]) / float128(I[i]);
    }
    return d;
  };
  constexpr int kSteps = 20000;
  const float128 h = float128(s.duration_s) / kSteps;
  Rates w = {start[0], start[1], start[2]};
  const auto moved = [](const Rates& at, float128 step, const Rates& d) {
    return Rates{at[0] + step * d[0], at[1] + step * d[1], at[2] + step * d[2]};
  };
  for (int n = 0; n < kSteps; ++n) {
    const Rates a = slope(w), b = slope(moved(w, h / 2, a)), c = slope(moved(w, h / 2, b)), d = slope(moved(w, h, c));
    for (std::size_t i = 0; i < 3; ++i) w[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
  }
  const RunResult result = result_of(s);
  // the steps leave some 1e-15, the run 1e-14 of its rates
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(result.rows.back().ref_w_LB_B[i], static_cast<double>(w[i]), 1e-12);
}

// Friction across the axis of a hanging top, and none along it: the spin in space stays, whatever the axis does.
TEST(Apparatus, FrictionAcrossTheAxisLeavesTheSpin) {
  Scenario s = testing::non_rotating(testing::toy_top());
  s.duration_s = 5, s.output_step_s = 5;
  s.effects.applied.viscous_by_axis_N_m_s = {1e-5, 1e-5, 0};
  // 1,000 rad of turns with 1e-14 each
  EXPECT_NEAR(result_of(s).rows.back().ref_w_LB_B[2], s.release.spin_rad_s, 1e-10);
}

GivenTorqueSpec given(TorqueAxes axes, const std::array<double, 3>& torque) {
  GivenTorqueSpec spec;
  spec.axes = axes, spec.torque_N_m = torque;
  return spec;
}

// Along the symmetry axis, also under gravity: I3 dw3/dt = tau.
TEST(Apparatus, AConstantTorqueAlongTheAxisSpinsATopUp) {
  Scenario s = testing::toy_top();
  s.duration_s = s.output_step_s = 3;
  s.effects.applied.given_torque = given(TorqueAxes::body, {0, 0, 1e-3});
  const double expected = s.release.spin_rad_s + 1e-3 * s.duration_s / s.body.inertia_kg_m2[2][2];
  // 1,000 rad of turns with 1e-14 each
  EXPECT_NEAR(result_of(s).rows.back().ref_w_LB_B[2], expected, 1e-10 * expected);
}

TEST(Apparatus, AHarmonicTorqueAlongTheAxisIsIntegrated) {
  Scenario s = testing::toy_top();
  s.duration_s = s.output_step_s = 3.3;
  GivenTorqueSpec spec = given(TorqueAxes::body, {0, 0, 4e-3});
  spec.course = TorqueCourse::harmonic, spec.frequency_hz = 0.7, spec.phase_deg = 25;
  s.effects.applied.given_torque = spec;
  const double rate = 2 * pi * 0.7, phase = 25 * pi / 180;
  const double change = 4e-3 / (4e-5 * rate) * (std::cos(phase) - std::cos(rate * s.duration_s + phase));
  // 1e-11 of the spin, of which the torque makes a thousandth and more
  EXPECT_NEAR(result_of(s).rows.back().ref_w_LB_B[2], s.release.spin_rad_s + change, 1e-9);
}

// A spline through values of a cubic is this cubic.
TEST(Apparatus, ATorqueByTableIsIntegrated) {
  Scenario s = testing::toy_top();
  s.duration_s = s.output_step_s = 3;
  const auto cubic = [](double t) { return 1e-3 * (1 + t * (0.5 + t * (-0.8 + 0.2 * t))); };
  GivenTorqueSpec spec;
  spec.course = TorqueCourse::table;
  std::array<AngleTable, 3> tables;
  for (const double t : {-0.5, 0.25, 1.0, 1.75, 2.5, 3.25})
    for (std::size_t i = 0; i < 3; ++i) tables[i].t_s.push_back(t), tables[i].value.push_back(i == 2 ? cubic(t) : 0);
  for (std::size_t i = 0; i < 3; ++i) spec.components[i].rows = std::make_shared<const AngleTable>(tables[i]);
  s.effects.applied.given_torque = spec;
  const double change = 1e-3 / 4e-5 * (3 + 0.5 * 9 / 2 - 0.8 * 27 / 3 + 0.2 * 81 / 4);
  // 1e-11 of the spin, of which the torque makes a thousandth and more
  EXPECT_NEAR(result_of(s).rows.back().ref_w_LB_B[2], s.release.spin_rad_s + change, 1e-9);
}

// A body with three equal moments has the momentum I w. On an Earth that rests it grows by tau t. In a laboratory that turns at
// W the torque turns with it: dL/dt = tau - W x L.
TEST(Apparatus, AConstantTorqueOfTheLaboratoryChangesTheMomentum) {
  constexpr double kMoment = 4e-4;
  for (const bool by_series : {true, false}) {
    Scenario s = weightless(kMoment, kMoment, kMoment);
    s.rotation_rate_rad_s = 0.4;
    s.release.angular_velocity_body_rad_s = std::array<double, 3>{1, -2, 3};
    const Vec3<double> tau(3e-4, 2e-4, -4e-4);
    s.effects.applied.given_torque = given(TorqueAxes::laboratory, {tau[0], tau[1], tau[2]});
    if (!by_series)
      s.numerics.method = Method::rkf78, s.numerics.observer = Observer::body, s.numerics.form = ModelForm::general;
    const RunResult result = result_of(s);
    const DriftRow &first = result.rows.front(), &last = result.rows.back();
    const Vec3<double> w0 = matrix(first.q_LB) * vec(first.w_LB_B), ref = matrix(last.ref_q_LB) * vec(last.ref_w_LB_B);
    const double t = s.duration_s;
    // 10 rad of turns with 1e-14 each, and their rounding
    EXPECT_LT(norm(Vec3<double>(ref - (w0 + t / kMoment * tau))), 1e-11);
    const double latitude = s.site.latitude_deg * pi / 180, angle = 0.4 * t;
    const Vec3<double> axis(0, std::cos(latitude), std::sin(latitude)), W = 0.4 * axis;
    const auto turned_back = [&](const Vec3<double>& v) {  // exp(-angle [axis]x) v
      const Vec3<double> along = axis.dot(v) * axis, across = v - along;
      return Vec3<double>(along + std::cos(angle) * across - std::sin(angle) * axis.cross(across));
    };
    const Vec3<double> along = axis.dot(tau) * axis, across = tau - along;
    const Vec3<double> grown =
        t * along + std::sin(angle) / 0.4 * across - (1 - std::cos(angle)) / 0.4 * Vec3<double>(axis.cross(across));
    const Vec3<double> L = kMoment * turned_back(Vec3<double>(w0 + W)) + grown;
    // the same of the steps of order 7 at a tolerance of 1e-14
    EXPECT_LT(norm(Vec3<double>(matrix(last.q_LB) * vec(last.w_LB_B) + W - L / kMoment)), 1e-10);
  }
}

/// A bob on a rod of 1 m, released at rest in the laboratory or on an ellipse.
Scenario pendulum(double tilt_rad, double ellipse_rate_rad_s) {
  Scenario s = testing::toy_top();
  s.site = {90, 0, 0, 9.8};
  s.body.mass_kg = 1;
  s.body.center_of_mass_m = {0, 0, -1};
  testing::set_principal(s.body, 1 + 5e-9, 1 + 5e-9, 1e-8);
  s.release.tilt_deg = tilt_rad * 180 / pi, s.release.azimuth_deg = 0, s.release.spin_rad_s = 0;
  if (ellipse_rate_rad_s != 0) s.release.precession = Precession::given, s.release.precession_rate_rad_s = ellipse_rate_rad_s;
  return s;
}
/// The axis in the directions along e and 90 degrees counterclockwise from it, for the compass azimuth of e.
std::array<double, 2> beside(const Vec3<double>& v_L, double azimuth_deg) {
  const double sine = std::sin(azimuth_deg * pi / 180), cosine = std::cos(azimuth_deg * pi / 180);
  return {v_L[0] * sine + v_L[1] * cosine, -v_L[0] * cosine + v_L[1] * sine};
}

TEST(Apparatus, SmallSwingsOfAnUnequalPendulumHaveTheirTwoPeriods) {
  Scenario s = pendulum(1e-4, 0);
  s.rotation_rate_rad_s = 0;
  s.duration_s = s.output_step_s = 23;
  const double across = 2 * pi * std::sqrt((1 + 5e-9) / 9.8), along = 0.93 * across;
  UnequalSupportSpec support;
  support.azimuth_deg = 40;
  for (const bool by_periods : {true, false}) {
    if (by_periods)
      support.periods_s = {along, across};
    else
      support.periods_s.reset(), support.kappa_N_m = 9.8 * (1 / (0.93 * 0.93) - 1);
    s.effects.applied.unequal_support = support;
    const RunResult result = result_of(s);
    const auto first = beside(vec(result.rows.front().ref_axis_L), 40), last = beside(vec(result.rows.back().ref_axis_L), 40);
    // the rates fall by A^2/16 of themselves, 6e-10, over 72 rad of a swing of 7e-5
    EXPECT_NEAR(last[0], first[0] * std::cos(2 * pi * s.duration_s / along), 1e-11);
    // the same
    EXPECT_NEAR(last[1], first[1] * std::cos(2 * pi * s.duration_s / across), 1e-11);
  }
}

/// The Stokes parameters of an ellipse with the semiaxes A and B, whose major axis is at the angle psi counterclockwise from e:
/// (A^2 - B^2) cos 2 psi, (A^2 - B^2) sin 2 psi, and 2 A B, above 0 if it is run through counterclockwise.
Vec3<double> stokes(const std::array<double, 4>& q_LB, const std::array<double, 3>& w_LB_B, double azimuth_deg, double rate) {
  const Mat3<double> R = matrix(q_LB);
  const auto [x, y] = beside(Vec3<double>(R.col(2)), azimuth_deg);
  const auto [u, v] =
      beside(Vec3<double>(R * Vec3<double>(vec(w_LB_B).cross(Vec3<double>(Vec3<double>::UnitZ())))), azimuth_deg);
  return {x * x - y * y + (u * u - v * v) / (rate * rate), 2 * (x * y + u * v / (rate * rate)), 2 * (x * v - u * y) / rate};
}

// An ellipse precesses at 3/8 of A B times its rate [G. B. Airy, Mon. Not. R. Astron. Soc. 11 (1851) 159], turns with the Earth
// at
// -Omega sin(latitude), and opens and closes with the difference d of both rates of an unequal support [M. G. Olsson, Am. J.
// Phys. 46 (1978) 1118; 49 (1981) 531]. Its Stokes parameters then obey  ds/dt = (-G s2, G s1 - d s3, d s2) , G = 3/8 rate s3 -
// 2 Omega sin(latitude) . Left out are terms of the relative size of A^2 = 4e-4.
TEST(Apparatus, AnEllipseOnAnUnequalSupportFollowsAiryAndOlsson) {
  constexpr double kAzimuth = 25, kEarth = 1e-4, kLeftOut = 1e-3;
  Scenario s = pendulum(0.02, 1.5);
  s.rotation_rate_rad_s = kEarth;
  s.duration_s = 1500, s.output_step_s = 500;
  UnequalSupportSpec support;
  support.kappa_N_m = 6e-3, support.azimuth_deg = kAzimuth;
  s.effects.applied.unequal_support = support;
  const double across = std::sqrt(9.8), along = std::sqrt(9.8 + 6e-3), rate = across * (1 - 0.02 * 0.02 / 16);
  const RunResult result = result_of(s);
  const DriftRow& first = result.rows.front();
  for (const bool turns : {false, true}) {
    Vec3<double> p =
        turns ? stokes(first.q_LB, first.w_LB_B, kAzimuth, rate) : stokes(first.ref_q_LB, first.ref_w_LB_B, kAzimuth, rate);
    const double size = norm(p);
    const auto slope = [&](const Vec3<double>& at) {
      const double G = 3.0 / 8 * rate * at[2] - (turns ? 2 * kEarth : 0), d = along - across;
      return Vec3<double>(-G * at[1], G * at[0] - d * at[2], d * at[1]);
    };
    const double h = 0.25;
    for (std::size_t row = 1; row < result.rows.size(); ++row) {
      for (int n = 0; n < 2000; ++n) {
        const Vec3<double> a = slope(p), b = slope(Vec3<double>(p + h / 2 * a)), c = slope(Vec3<double>(p + h / 2 * b)),
                           d = slope(Vec3<double>(p + h * c));
        p += h / 6 * (a + 2 * b + 2 * c + d);
      }
      const DriftRow& at = result.rows[row];
      const Vec3<double> seen =
          turns ? stokes(at.q_LB, at.w_LB_B, kAzimuth, rate) : stokes(at.ref_q_LB, at.ref_w_LB_B, kAzimuth, rate);
      EXPECT_LT(norm(Vec3<double>(seen - p)), kLeftOut * size) << at.t_s << (turns ? " s on the Earth" : " s");
    }
  }
}

// The energy of the support is part of what is conserved.
TEST(Apparatus, AnUnequalSupportConservesTheJacobiIntegralAndTheSpin) {
  Scenario s = testing::fast_earth_top();
  s.duration_s = 5, s.output_step_s = 0.05;
  UnequalSupportSpec support;
  support.kappa_N_m = 0.02, support.azimuth_deg = 70;
  s.effects.applied.unequal_support = support;
  const RunResult result = result_of(s);
  std::vector<std::string> names;
  for (const InvariantReport& invariant : result.invariants) {
    names.push_back(invariant.name);
    // 1,000 rad of turns with 1e-14 each
    EXPECT_LT(invariant.largest_change, 1e-11 * invariant.scale) << invariant.name;
  }
  EXPECT_EQ(names, (std::vector<std::string>{"jacobi_integral", "reference_energy", "inertial_spin"}));
}

Scenario on_table(double spin_rad_s) {
  Scenario s = testing::non_rotating(testing::toy_top());
  s.release.tilt_deg = 0, s.release.spin_rad_s = spin_rad_s;
  s.contact = ContactSpec{.tip_radius_m = 0.002, .law = ContactLaw::viscous, .sliding_viscosity_N_s_m = 0.05};
  s.duration_s = s.output_step_s = 4;
  return s;
}

// dw/dt = -(a + b w) w has the solution a w0 / ((a + b w0) e^(a t) - b w0).
TEST(Apparatus, ASleepingTopOnATableSlowsDownInAirByItsOwnEquation) {
  Scenario s = on_table(400);
  s.effects.applied.viscous_by_axis_N_m_s = {5e-6, 5e-6, 2e-6}, s.effects.applied.quadratic_N_m_s2 = 1e-8;
  const double I3 = 4e-5, a = 2e-6 / I3, b = 1e-8 / I3, w0 = 400;
  const double expected = a * w0 / ((a + b * w0) * std::exp(a * s.duration_s) - b * w0);
  // the floor of the rate, 0.01 rad/s, is seen with its square over that of the spin: 3e-10
  EXPECT_NEAR(result_of(s).rows.back().ref_w_LB_B[2], expected, 1e-9 * (w0 - expected));
}

// dw/dt = -c w^1.5 has the solution w0 / (1 + c sqrt(w0) t/2)^2: c = 3.87/2 density R^4 sqrt(viscosity) / I3.
TEST(Apparatus, ADiscOnATableSlowsDownAsVonKarmanSays) {
  Scenario s = on_table(400);
  s.effects.applied.air_drag = AirDragSpec{.disc_radius_m = 0.08, .flow = DiscFlow::laminar};
  const double c = 3.87 / 2 * 1.204 * std::pow(0.08, 4) * std::sqrt(1.516e-5) / 4e-5;
  const double expected = 400 / std::pow(1 + c * std::sqrt(400.0) * s.duration_s / 2, 2);
  // the same, and density and viscosity to all digits
  EXPECT_NEAR(result_of(s).rows.back().ref_w_LB_B[2], expected, 1e-8 * (400 - expected));
}

// A ball that slides without friction: m dv/dt = -(b + c v) v. Below 1 mm/s the force is linear, which takes 1e-6 of c at 0.5
// m/s.
TEST(Apparatus, TheForceOfTheAirBrakesABallOnATable) {
  Scenario s = testing::non_rotating(testing::toy_top());
  s.body.center_of_mass_m = {0, 0, 0};
  testing::set_principal(s.body, 1.6e-5, 1.6e-5, 1.6e-5);
  s.release.tilt_deg = 10, s.release.spin_rad_s = 20;
  s.contact = ContactSpec{.tip_radius_m = 0.02, .law = ContactLaw::frictionless};
  s.contact->start = ContactStart::tip_velocity, s.contact->tip_velocity_m_s = {0.8, 0};
  s.duration_s = s.output_step_s = 3;
  AirForceSpec force;
  force.linear_N_s_m = 0.01, force.quadratic_N_s2_m2 = 0.02;
  s.effects.applied.air_force = force;
  const double a = 0.1, b = 0.2, v0 = 0.8, path = std::log1p(b * v0 / a * -std::expm1(-a * s.duration_s)) / b;
  const auto contact = result_of(s).rows.back().contact;
  ASSERT_TRUE(contact);
  // the floor of the speed, 1 mm/s, is seen with its square over that of 0.5 m/s: 2e-6
  EXPECT_NEAR(contact->ref_tip_m[0], path, 2e-6 * (v0 * s.duration_s - path));
  // nothing acts across
  EXPECT_NEAR(contact->ref_tip_m[1], 0, 1e-12);
}

// A ball that rolls: (m + I/r^2) dv/dt = -(b + k/r^2) v with the force b v and the torque k w.
TEST(Apparatus, ForceAndTorqueOfTheAirBrakeARollingBall) {
  for (const Observer observer : {Observer::laboratory, Observer::inertial}) {
    Scenario s = testing::non_rotating(testing::toy_top());
    s.body.center_of_mass_m = {0, 0, 0};
    testing::set_principal(s.body, 1.6e-5, 1.6e-5, 1.6e-5);
    s.release.tilt_deg = 0, s.release.angular_velocity_body_rad_s = std::array<double, 3>{0, 30, 5};
    s.contact = ContactSpec{.tip_radius_m = 0.02, .law = ContactLaw::rolling};
    s.contact->start = ContactStart::rolling;
    s.duration_s = s.output_step_s = 3;
    s.numerics.observer = observer;
    AirForceSpec force;
    force.linear_N_s_m = 0.01;
    s.effects.applied.air_force = force, s.effects.applied.viscous_N_m_s = 4e-6;
    const double rate = (0.01 + 4e-6 / 4e-4) / (0.1 + 1.6e-5 / 4e-4), v0 = 0.02 * 30;
    const auto contact = result_of(s).rows.back().contact;
    ASSERT_TRUE(contact);
    // 100 rad of turns with 1e-14 each
    EXPECT_NEAR(contact->ref_tip_m[0], v0 / rate * -std::expm1(-rate * s.duration_s), 1e-11);
  }
}

// What friction and the air take out is what the Jacobi integral loses, and Jellett's lambda changes by their torques: a
// tumbling top, on an Earth that turns fast.
TEST(Apparatus, TheBalancesOnATableCountTheAir) {
  for (const double I2 : {1.2e-4, 1.05e-4}) {
    Scenario s = testing::fast_earth_top();
    testing::set_principal(s.body, 1.2e-4, I2, 4e-5);
    s.contact = ContactSpec{.tip_radius_m = 0.003, .law = ContactLaw::viscous, .sliding_viscosity_N_s_m = 0.5};
    s.effects.applied.viscous_N_m_s = 1e-5, s.effects.applied.quadratic_N_m_s2 = 2e-8;
    s.effects.applied.air_drag.emplace().disc_radius_m = 0.06;
    AirForceSpec force;
    force.linear_N_s_m = 0.02, force.quadratic_N_s2_m2 = 0.05;
    s.effects.applied.air_force = force;
    const RunResult result = result_of(s);
    ASSERT_TRUE(result.contact);
    for (const ContactBalances& balances : {result.contact->rotating, result.contact->reference}) {
      ASSERT_TRUE(balances.jacobi);
      // 400 rad of turns with 1e-14 each
      EXPECT_LT(std::abs(balances.jacobi->balance), 1e-11 * balances.jacobi->size);
      EXPECT_GT(std::abs(balances.jacobi->integral), 1e-2 * balances.jacobi->size);
      if (I2 == 1.2e-4) {
        ASSERT_TRUE(balances.jellett);
        // the same
        EXPECT_LT(std::abs(balances.jellett->balance), 1e-11 * balances.jellett->size);
      }
    }
  }
}

}  // namespace
}  // namespace earthtop::apparatus
