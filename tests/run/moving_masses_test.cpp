// SPDX-License-Identifier: GPL-3.0-or-later
/// Runs of bodies in which masses move: closed forms that know nothing of the equations, observers against each other, bounds against
/// truth, the ledger, what is conserved, and what is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "earthtop/run.hpp"
#include "earthtop/run_batch.hpp"
#include "earthtop/scenario/support.hpp"
#include "run/invariant_follower.hpp"
#include "support/mass_scenes.hpp"
#include "support/reference.hpp"

namespace earthtop {
namespace {

using testing::any_body_with_masses;
using testing::any_mass;

/// A beam that is free about the upright axis 3 and balanced on it as long as its masses are; nothing acts on it.
Scenario free_beam() {
  Scenario s;
  s.name = "free-beam";
  s.site = {45, 0, 0, 0};
  s.rotation_rate_rad_s = 0;
  s.body.mass_kg = 0.5;
  testing::set_principal(s.body, 0.003, 0.004, 0.005);
  s.release.tilt_deg = 0, s.release.azimuth_deg = 90;
  s.duration_s = 2, s.output_step_s = 0.1;
  return s;
}
constexpr double kMoment = 0.005;

/// The angle by which a body has turned about the upright axis 3, followed from row to row.
std::vector<double> turned(const RunResult& result) {
  std::vector<double> angles;
  double before = 0;
  for (const DriftRow& row : result.rows) {
    const double angle = 2 * std::atan2(row.q_LB[3], row.q_LB[0]), around = 2 * std::numbers::pi;
    before = angle + around * std::round((before - angle) / around);
    angles.push_back(before);
  }
  for (double& angle : angles) angle -= angles.front() * (&angle != angles.data());
  if (!angles.empty()) angles.front() = 0;
  return angles;
}

/// Simpson's rule over smooth functions.
template <class F>
double integral(const F& f, double from, double to) {
  constexpr int kIntervals = 4000;
  const double h = (to - from) / kIntervals;
  double sum = f(from) + f(to);
  for (int i = 1; i < kIntervals; ++i) sum += (i % 2 == 0 ? 2 : 4) * f(from + i * h);
  return sum * h / 3;
}

// Runs at a tolerance of 1e-12 a step over some hundred steps turn by some radians.
constexpr double kErrorOfTurn = 2e-11;

/// A skater: two masses swing along a line through the axis; the momentum about it stays.
TEST(MovingMasses, SkaterTurnsByItsMomentumOverItsMoment) {
  Scenario s = free_beam();
  const double m = 0.2, r = 0.1, a = 0.06, f = 0.7, phase = 0.5, w = 1.5;
  for (const double side : {1.0, -1.0}) {
    MovingMassSpec mass;
    mass.mass_kg = m, mass.motion = MassMotion::harmonic;
    mass.center_m = {side * r, 0, 0}, mass.amplitude_m = {side * a, 0, 0};
    mass.frequency_hz = f, mass.phase_deg = phase * 180 / std::numbers::pi;
    s.moving_masses.push_back(mass);
  }
  s.release.spin_rad_s = w;
  const auto moment = [&](double t) {
    const double x = r + a * std::sin(2 * std::numbers::pi * f * t + phase);
    return kMoment + 2 * m * x * x;
  };
  const RunResult result = run(s);
  const std::vector<double> angles = turned(result);
  for (std::size_t i = 0; i < angles.size(); ++i)
    EXPECT_NEAR(angles[i], integral([&](double t) { return moment(0) * w / moment(t); }, 0, result.rows[i].t_s), kErrorOfTurn);
  EXPECT_GT(std::abs(angles.back() - w * s.duration_s), 0.1);  // so that the lines above can fail
}

/// A mass that goes round a circle in a body without momentum turns it by an angle that depends on the circle alone.
TEST(MovingMasses, CircleWithoutMomentumTurnsByItsGeometricPhase) {
  for (const double frequency : {0.5, -2.0}) {
    Scenario s = free_beam();
    const double m = 0.2, d = 0.1, a = 0.05, sense = frequency > 0 ? 1 : -1;
    MovingMassSpec mass;
    mass.mass_kg = m, mass.motion = MassMotion::circle;
    mass.center_m = {d, 0, 0}, mass.start_m = {a, 0, 0}, mass.axis = {0, 0, 2}, mass.frequency_hz = frequency;
    s.moving_masses = {mass};
    // The body starts without momentum: its rate is what the mass's speed at release takes.
    const double speed = 2 * std::numbers::pi * frequency * a, moment = kMoment + m * (d + a) * (d + a);
    s.release.spin_rad_s = -m * (d + a) * speed / moment;
    s.duration_s = s.output_step_s = 1 / std::abs(frequency);
    const double D = (kMoment + m * (d - a) * (d - a)) * (kMoment + m * (d + a) * (d + a));
    const double expected = -sense * std::numbers::pi * (1 - (kMoment + m * (d * d - a * a)) / std::sqrt(D));
    EXPECT_NEAR(turned(run(s)).back(), expected, kErrorOfTurn) << frequency;
  }
}

/// Along straight lines the angles are arctangents, whatever the speed, by waypoints and by a table; a table of a straight line with cubic
/// progress is that line.
TEST(MovingMasses, PolygonTurnsByArctangents) {
  const double m = 0.2, p = 0.08, from = -0.1, to = 0.15;
  const double k = std::sqrt(m / (kMoment + m * p * p));
  const double expected = m * p / std::sqrt(m * (kMoment + m * p * p)) * (std::atan(k * to) - std::atan(k * from));
  Scenario waypoints = free_beam();
  MovingMassSpec mass;
  mass.mass_kg = m, mass.motion = MassMotion::waypoints;
  mass.times_s = {0.3, 1.7}, mass.points_m = {{from, p, 0}, {to, p, 0}};
  waypoints.moving_masses = {mass};
  EXPECT_NEAR(turned(run(waypoints)).back(), expected, kErrorOfTurn);

  Scenario table = free_beam();
  mass.times_s.clear(), mass.points_m.clear();
  mass.motion = MassMotion::table;
  AngleTable x, y, z;
  for (const double t : {-0.2, 0.4, 0.9, 1.5, 2.1}) {
    const double u = t / 2;
    for (AngleTable* one : {&x, &y, &z}) one->t_s.push_back(t);
    x.value.push_back(from + (to - from) * u * u * (3 - 2 * u)), y.value.push_back(p), z.value.push_back(0);
  }
  mass.coordinates = {FiledTable{std::make_shared<const AngleTable>(x)}, FiledTable{std::make_shared<const AngleTable>(y)},
                      FiledTable{std::make_shared<const AngleTable>(z)}};
  table.moving_masses = {mass};
  EXPECT_NEAR(turned(run(table)).back(), expected, kErrorOfTurn);
}

/// A mass that is fixed is a part of a rigid body, beside a rotor, too.
TEST(MovingMasses, FixedOnesMakeARigidBody) {
  Scenario s = testing::caged_gyroscope(), rigid = s;
  MovingMassSpec mass;
  mass.mass_kg = 0.004, mass.center_m = {0, 0.01, 0.04};
  s.moving_masses = {mass};
  EXPECT_EQ(support_of(s).kind, SupportKind::rotor);
  const double all = s.body.mass_kg + mass.mass_kg;
  const double y = mass.mass_kg * 0.01 / all, z = (s.body.mass_kg * 0.035 + mass.mass_kg * 0.04) / all;
  rigid.body.mass_kg = all;
  rigid.body.center_of_mass_m = {0, y, z};
  const double cage_z = 0.035 - z, mass_y = 0.01 - y, mass_z = 0.04 - z, m = s.body.mass_kg, k = mass.mass_kg;
  const double yy = m * y * y + k * mass_y * mass_y, zz = m * cage_z * cage_z + k * mass_z * mass_z,
               yz = -m * y * cage_z + k * mass_y * mass_z;
  rigid.body.inertia_kg_m2 = {{{1e-5 + yy + zz, 0, 0}, {0, 1e-5 + zz, -yz}, {0, -yz, 1.2e-5 + yy}}};
  const RunResult a = run(s), b = run(rigid);
  for (std::size_t i = 0; i < a.rows.size(); ++i)
    EXPECT_NEAR(a.rows[i].drift_axis_rad, b.rows[i].drift_axis_rad,
                a.rows[i].drift_axis_bound_rad + b.rows[i].drift_axis_bound_rad);
  ASSERT_EQ(a.invariants.size(), b.invariants.size());
  EXPECT_GE(a.invariants.size(), 3u);
}

/// In the equations of every observer bodies with masses drift by the same, within both bounds.
TEST(MovingMasses, ObserversAgree) {
  std::mt19937_64 random(71);
  for (int i = 0; i < 16; ++i) {
    Scenario s = any_body_with_masses(random);
    s.rotation_rate_rad_s = 0.5;
    std::vector<RunResult> results;
    for (const Observer observer : {Observer::laboratory, Observer::inertial, Observer::body}) {
      s.numerics.observer = observer, s.numerics.form = ModelForm::general;
      results.push_back(run(s));
    }
    const DriftRow& a = results[0].rows.back();
    for (std::size_t k : {1u, 2u}) {
      const DriftRow& b = results[k].rows.back();
      EXPECT_NEAR(a.drift_axis_rad, b.drift_axis_rad, a.drift_axis_bound_rad + b.drift_axis_bound_rad) << i;
      EXPECT_NEAR(a.drift_attitude_rad, b.drift_attitude_rad, a.drift_attitude_bound_rad + b.drift_attitude_bound_rad) << i;
      EXPECT_EQ(a.rotor.has_value(), s.rotor.has_value());
    }
    EXPECT_LT(a.drift_axis_bound_rad, 1e-6 * a.drift_axis_rad) << i;  // so that the lines above can fail
  }
}

/// Balanced and matched in inertial rates, a body drifts as the laboratory turns, whatever moves in it.
TEST(MovingMasses, NothingOutsideLetsTheLaboratoryTurnAway) {
  std::mt19937_64 random(72);
  for (int i = 0; i < 8; ++i) {
    Scenario s = any_body_with_masses(random);
    s.site.gravity_m_s2 = 0;
    s.effects.applied = {};
    s.platform.reset();
    s.rotation_rate_rad_s = 1e-3;
    s.release.rates_relative_to = RatesRelativeTo::inertial;
    for (const DriftRow& row : run(s).rows)
      EXPECT_NEAR(row.drift_attitude_rad, 1e-3 * row.t_s, row.drift_attitude_bound_rad) << i;
  }
}

/// [F]'s torques against Euler's equation, for every observer, the one in the body among them; the Coriolis torque is the sum of its parts.
TEST(MovingMassesLedger, BalancesForEveryObserver) {
  std::mt19937_64 random(73);
  for (int i = 0; i < 10; ++i) {
    Scenario s = any_body_with_masses(random);
    s.rotation_rate_rad_s = 0.5;
    for (const LedgerObserver observer :
         {LedgerObserver::inertial, LedgerObserver::laboratory, LedgerObserver::platform, LedgerObserver::body}) {
      s.ledger = observer;
      const RunResult result = run(s);
      EXPECT_LT(result.ledger->largest.relative_residual(), 1e-12) << i << to_string(observer);  // rounding of the states
      for (const LedgerRow<double>& row : result.ledger->entries)
        for (std::size_t k = 0; k < 3; ++k)
          EXPECT_NEAR(row.tau_cor_A[k], row.tau_cor_inertia_A[k] + row.tau_cor_gyroscopic_A[k],
                      1e-14 * result.ledger->largest.tau_cor);  // some roundings
    }
  }
}

/// For the observer in the body the change of the inertia is what moves mass outward, -(dTheta/dt) w.
TEST(MovingMassesLedger, ShowsTheSkater) {
  Scenario s = free_beam();
  MovingMassSpec mass;
  mass.mass_kg = 0.2, mass.motion = MassMotion::waypoints, mass.times_s = {0, 2}, mass.points_m = {{0.1, 0, 0}, {0.4, 0, 0}};
  s.moving_masses = {mass};
  s.release.spin_rad_s = 2;
  s.ledger = LedgerObserver::body;
  const RunResult result = run(s);
  for (std::size_t i = 0; i < result.rows.size(); ++i) {
    const double x = result.rows[i].t_s / 2, place = 0.1 + 0.3 * x * x * x * (10 + x * (6 * x - 15)),
                 speed = 0.15 * 30 * x * x * (1 - x) * (1 - x);
    const double expected = -2 * 0.2 * place * speed * result.rows[i].w_LB_B[2];
    EXPECT_NEAR(result.ledger->entries[i].tau_cor_inertia_A[2], expected, 1e-12 * result.ledger->largest.tau_cor);  // rounding
  }
}

/// Motors work: neither energy nor a rotor's momentum is reported as conserved. At a pole the momentum about the vertical is.
TEST(MovingMasses, MotorsWork) {
  std::mt19937_64 random(74);
  Scenario s = testing::caged_gyroscope();
  s.rotor->axis = {0.1, 0.2, 1};
  s.moving_masses = {any_mass(random, MassMotion::circle, s.duration_s)};
  EXPECT_TRUE(run(s).invariants.empty());
  s.site.latitude_deg = 90;
  s.rotation_rate_rad_s = 0.3;
  const RunResult result = run(s);
  const ModelInTime<double> in_time(result.scene.model<double>());
  for (const ConservedQuantity<double>& quantity : kConserved<double>) {
    if (quantity.name != "vertical_momentum") continue;
    const InvariantReport report = followed_on_pivot(quantity, result.scene.model<double>(), result.rows);
    EXPECT_LT(report.largest_change, 1e-11 * report.scale);  // a run of some hundred steps at 1e-12
  }
}

/// Side by side they drift as each by itself does.
TEST(MovingMassesLanes, DriftAsEachByItself) {
  std::mt19937_64 random(75);
  std::vector<Scene> scenes;
  for (int i = 0; i < 4; ++i) {
    Scenario s = testing::any_gyrostat(random);
    s.moving_masses = {any_mass(random, MassMotion::harmonic, s.duration_s),
                       any_mass(random, MassMotion::circle, s.duration_s)};
    s.numerics.observer = Observer::body, s.numerics.form = ModelForm::general;
    scenes.push_back(resolve(std::move(s)));
  }
  Scenario waypoints = scenes[0].scenario();
  waypoints.moving_masses = {any_mass(random, MassMotion::waypoints, waypoints.duration_s)};
  scenes.push_back(resolve(std::move(waypoints)));
  const std::vector<BatchOutcome> together = run_batch(scenes);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    ASSERT_TRUE(together[i].result) << together[i].refusal;
    const DriftRow &a = together[i].result->rows.back(), b = run(scenes[i]).rows.back();
    EXPECT_NEAR(a.drift_axis_rad, b.drift_axis_rad, a.drift_axis_bound_rad + b.drift_axis_bound_rad) << i;
    EXPECT_NEAR(a.drift_attitude_rad, b.drift_attitude_rad, a.drift_attitude_bound_rad + b.drift_attitude_bound_rad) << i;
  }
}

/// A body with moving masses alone has the columns of a rigid body, and its verdict, growth and sensitivities.
TEST(MovingMasses, AloneAreJudgedAsARigidBodyIs) {
  std::mt19937_64 random(76);
  Scenario s = testing::toy_top();
  s.duration_s = 2;
  s.moving_masses = {any_mass(random, MassMotion::waypoints, s.duration_s),
                     any_mass(random, MassMotion::harmonic, s.duration_s)};
  s.rotation_rate_rad_s = 1e-3;
  s.sensitivities = true;
  s.threshold_rad = 1e-5;
  const RunResult result = run(s);
  EXPECT_FALSE(result.rows.back().rotor);
  EXPECT_EQ(result.verdict.verdict, Verdict::reliable);
  EXPECT_EQ(result.drift.threshold_crossing, ThresholdCrossing::clear);
  ASSERT_TRUE(result.sensitivities);
  for (const InputSensitivity& input : result.sensitivities->inputs) EXPECT_EQ(input.unavailable, "") << input.name;
}

/// Random scenes against 113 bits in the equations of another observer: no error is beyond its bound.
TEST(MovingMassesBounds, HoldOverRandomScenes) {
  std::mt19937_64 random(77);
  int reliable = 0;
  constexpr int kScenes = 6;
  for (int i = 0; i < kScenes; ++i) {
    const Scenario s = any_body_with_masses(random);
    const RunResult result = run(s);
    reliable += result.verdict.verdict == Verdict::reliable;
    EXPECT_GE(testing::compare(result, testing::reference_run(s, Observer::inertial)).least_margin, 1) << i;
  }
  EXPECT_GE(reliable, kScenes * 8 / 10);
}

}  // namespace
}  // namespace earthtop
