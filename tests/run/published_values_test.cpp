/// Published and extended-precision values: benchmarks T1 to T7 and the drift of a heavy top (T11), at default settings.
/// The numbers come from independent 113-bit Taylor integrations or closed forms; each is given to all printed digits.

#include <gtest/gtest.h>

#include "support/scenes.hpp"

namespace earthtop {
namespace {

using testing::set_principal;

/// 1e-10 is what the values are to be met to; the default settings do far better.
constexpr double kTolerance = 1e-10;

const DriftRow& row_at(const RunResult& result, double t) {
  for (const DriftRow& row : result.rows)
    if (std::abs(row.t_s - t) < 1e-12) return row;
  throw std::logic_error("no row at this time");
}

void expect_attitude(const std::array<double, 4>& q, std::array<double, 4> expected) {
  const double dot = q[0] * expected[0] + q[1] * expected[1] + q[2] * expected[2] + q[3] * expected[3];
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(q[i], dot < 0 ? -expected[i] : expected[i], kTolerance) << "component " << i;
}
void expect_vector(const std::array<double, 3>& v, const std::array<double, 3>& expected, double tolerance = kTolerance) {
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
    for (const DriftRow& row : r.rows) EXPECT_NEAR(row.w_LB_B[1], 150, 150 * kTolerance);
    // Kinetic + potential energy about the pivot, published: 5435.69679086554687500 J.
    ASSERT_EQ(r.invariants.at(1).name, "reference_energy");
    EXPECT_NEAR(r.invariants.at(1).initial, 5435.69679086554687500, 1e-14 * 5436);
  }
}

TEST(PublishedValues, T2SymmetricTopOfSimoAndWong) {
  Scenario s = without_earth(10, 10, 1);
  s.body.mass_kg = 2;
  s.body.center_of_mass_m = {0, 0, 1};
  set_principal(s.body, 5, 5, 1);
  s.release.angular_velocity_body_rad_s = {0, 0, 50};
  s.release.quaternion_LB = {std::cos(0.025), std::sin(0.025), 0, 0};
  RunResult r = run(s);
  expect_vector(r.rows.back().axis_L, {-0.047132231441981876198, 0.026748686358709884885, 0.99853045048079671607});
  EXPECT_NEAR(r.invariants.at(1).initial, 1269.97500520789932, 1e-12 * 1270);
  s.release.quaternion_LB = {std::cos(0.15), std::sin(0.15), 0, 0};
  r = run(s);
  expect_vector(r.rows.back().axis_L, {-0.27486460839002151370, 0.15474152101071960297, 0.94894916024510456308});
  EXPECT_NEAR(r.invariants.at(1).initial, 1269.10672978251212, 1e-12 * 1270);
}

TEST(PublishedValues, T3SteadyPrecessionOfAConeReturns) {
  const double period = real::pi<double>() / 5;
  Scenario s = without_earth(9.81, period, period / 10);
  s.body.mass_kg = 0.70685834705770347865;
  s.body.center_of_mass_m = {0, 0, 0.075};
  set_principal(s.body, 4.5062219624928596764e-3, 4.5062219624928596764e-3, 5.3014376029327760899e-4);
  s.release.tilt_deg = 60;
  s.release.spin_rad_s = 140.6;
  s.release.precession = Precession::steady_slow;
  const RunResult r = run(s);
  expect_vector(r.rows.back().axis_L, r.rows.front().axis_L);
  for (const DriftRow& row : r.rows) EXPECT_NEAR(row.axis_L[2], 0.5, kTolerance);
  // A tenth of a period is 36 degrees counterclockwise: from North toward the West.
  EXPECT_NEAR(std::atan2(-r.rows[1].axis_L[0], r.rows[1].axis_L[1]), period, kTolerance);
}

/// Bodies with m g = 1 N: m = 0.1 kg, g = 10 m/s^2, centre of mass 1 m along body axis 1.
Scenario body_with_unit_weight(double I12, double I3) {
  Scenario s = without_earth(10, 20, 0.5);
  s.body.mass_kg = 0.1;
  s.body.center_of_mass_m = {1, 0, 0};
  set_principal(s.body, I12, I12, I3);
  s.release.quaternion_LB = {std::cos(0.5), 0, std::sin(0.5), 0};
  return s;
}

Vec3<double> up_in_body(const DriftRow& row) {
  return rotation_matrix(Quaternion<double>{row.q_LB[0], Vec3<double>(row.q_LB[1], row.q_LB[2], row.q_LB[3])})
      .row(2)
      .transpose();
}

TEST(PublishedValues, T4Kovalevskaya) {
  Scenario s = body_with_unit_weight(2, 1);
  s.release.angular_velocity_body_rad_s = {0.3, -0.2, 1.5};
  const RunResult r = run(s);
  for (const DriftRow& row : r.rows) {
    const auto [p, q, w3] = row.w_LB_B;
    const Vec3<double> up = up_in_body(row);
    const double c = 1;  // m g l / I3
    const double K = std::pow(p * p - q * q - c * up[0], 2) + std::pow(2 * p * q - c * up[1], 2);
    EXPECT_NEAR(K, 0.809120516754360844164, kTolerance);
  }
  EXPECT_NEAR(r.invariants.at(1).initial, 0.413529015192103493347, 1e-14 * 4);
  expect_vector(r.rows.back().w_LB_B, {0.26803999820226882493, 0.088763144663589775470, 0.97270467568153514022});
}

TEST(PublishedValues, T5GoryachevChaplygin) {
  Scenario s = body_with_unit_weight(4, 1);
  s.duration_s = 5;
  s.release.angular_velocity_body_rad_s = {0.5, -0.4, 3.11481544930980446101};
  const RunResult r = run(s);
  for (const DriftRow& row : r.rows) {
    const auto [p, q, w3] = row.w_LB_B;
    EXPECT_NEAR(w3 * (p * p + q * q) - p * up_in_body(row)[2], 1.00692318128294997, kTolerance);
  }
  EXPECT_NEAR(r.invariants.at(1).initial, 4.82956665682162302, 1e-14 * 5);
  EXPECT_NEAR(r.rows.back().w_LB_B[2], 2.519423700050085, kTolerance);
}

/// The ladder top of T6 and T11.
Scenario ladder_top() {
  Scenario s;
  s.site = {45, 0, 0, 9.80665};
  s.body.mass_kg = 0.2;
  s.body.center_of_mass_m = {0, 0, 0.05};
  set_principal(s.body, 6e-4, 6e-4, 1.6e-4);
  return s;
}

TEST(PublishedValues, T6SleepingTopWakesBelowTheCriticalSpin) {
  const double critical = 95.88396307516706;
  const double growth_rate = std::sqrt(0.2 * 9.80665 * 0.05 / 6e-4);
  Scenario s = testing::non_rotating(ladder_top());
  s.release.tilt_deg = 1e-5;
  s.duration_s = 4;
  s.output_step_s = 0.01;
  const auto largest_tilt = [&](double spin) {
    s.release.spin_rad_s = spin;
    double largest = 0;
    for (const DriftRow& row : run(s).rows) largest = std::max(largest, std::hypot(row.axis_L[0], row.axis_L[1]));
    return largest / (1e-5 * real::pi<double>() / 180);
  };
  // Released at rest in the precession, the linear motion swings to 1/sqrt(1 - (wc/w)^2) of the tilt and no further.
  EXPECT_NEAR(largest_tilt(critical * 1.001), 1 / std::sqrt(1 - 1 / (1.001 * 1.001)), 0.05 * 22);
  // Below, the tilt grows as a sum of exponentials of rate sqrt(m g l / I1) sqrt(1 - f^2), here to about e^(4 x 12.8 x 0.14)/2.
  const double f = 0.99, exponent = 4 * growth_rate * std::sqrt(1 - f * f);
  EXPECT_GT(largest_tilt(critical * f), 0.5 * std::exp(exponent));
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
