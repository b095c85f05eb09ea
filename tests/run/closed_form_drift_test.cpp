// SPDX-License-Identifier: GPL-3.0-or-later
/// `closed_form` as the method of a run: compared with integrations in other equations at every size of the Earth's rate, and
/// with what is known without either.

#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "support/effect_scenes.hpp"
#include "support/soundness.hpp"

namespace earthtop {
namespace {

using testing::kPi;

Scenario by_closed_form(Scenario s) {
  s.numerics.method = Method::closed_form;
  return s;
}

/// Families of scenes that have a closed form.
enum class Family { free_asymmetric, free_symmetric, heavy_at_pole, heavy_sideways, heavy_standing };
constexpr Family kFamilies[] = {Family::free_asymmetric, Family::free_symmetric, Family::heavy_at_pole, Family::heavy_sideways,
                                Family::heavy_standing};

/// A random scene of a family; the seed also decides its matching rule, and the sign and size of the Earth's rate.
Scenario random_of(Family family, std::uint64_t seed, double radians) {
  // Odd seeds are symmetric tops.
  Scenario s = testing::random_scene(family == Family::free_asymmetric ? 2 * seed : 2 * seed + 1, radians);
  s.release.rates_relative_to = seed % 2 == 0 ? RatesRelativeTo::laboratory : RatesRelativeTo::inertial;
  if (family == Family::free_asymmetric || family == Family::free_symmetric) s.body.center_of_mass_m = {0, 0, 0};
  if (family == Family::heavy_sideways) {
    // Symmetric about body axis 1 or 2 instead of 3.
    const std::size_t axis = seed % 2;
    const auto I = s.body.inertia_kg_m2;
    const double l = s.body.center_of_mass_m[2];
    testing::set_principal(s.body, I[axis == 0 ? 2 : 0][axis == 0 ? 2 : 0], I[axis == 1 ? 2 : 1][axis == 1 ? 2 : 1], I[0][0]);
    s.body.center_of_mass_m = {axis == 0 ? l : 0, axis == 1 ? l : 0, 0};
  }
  if (family == Family::heavy_at_pole || family == Family::heavy_sideways) s.site.latitude_deg = seed % 4 < 2 ? 90 : -90;
  if (family == Family::heavy_standing) s.rotation_rate_rad_s = 0;
  return by_closed_form(s);
}

double distance(const std::array<double, 4>& p, const std::array<double, 4>& q) {
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i) sum += (p[i] - q[i]) * (p[i] - q[i]);
  return std::sqrt(sum);
}

/// Checks that two runs of one scene agree within the sum of their bounds: drift, attitudes and the signs of their quaternions,
/// and angles that go round more than once.
void expect_agreement(const RunResult& a, const RunResult& b) {
  ASSERT_EQ(a.status, RunStatus::completed);
  ASSERT_EQ(a.rows.size(), b.rows.size());
  const double of_attitudes = a.attitude_bound_rad + b.attitude_bound_rad + 1e-14;
  for (std::size_t i = 0; i < a.rows.size(); ++i) {
    const DriftRow &x = a.rows[i], &y = b.rows[i];
    const double of_axis = x.drift_axis_bound_rad + y.drift_axis_bound_rad;
    const double of_attitude = x.drift_attitude_bound_rad + y.drift_attitude_bound_rad;
    ASSERT_LE(std::abs(x.drift_axis_rad - y.drift_axis_rad), of_axis) << x.t_s;
    ASSERT_LE(std::abs(x.drift_attitude_rad - y.drift_attitude_rad), of_attitude) << x.t_s;
    ASSERT_LE(distance(x.q_LB, y.q_LB), of_attitudes) << x.t_s;
    ASSERT_LE(distance(x.ref_q_LB, y.ref_q_LB), of_attitudes) << x.t_s;
    // Half a turn of the body turns its half spin phase by as much as its attitude where e_w and e_z are both small.
    if (x.drift_attitude_rad < 2 && of_attitude < 0.01) {
      ASSERT_NEAR(x.drift_spin_rad, y.drift_spin_rad, 3 * of_attitude) << x.t_s;
    }
    const double sine = std::min(std::hypot(x.axis_L[0], x.axis_L[1]), std::hypot(x.ref_axis_L[0], x.ref_axis_L[1]));
    if (sine < 1e-3) continue;
    ASSERT_TRUE(x.drift_azimuth_rad && y.drift_azimuth_rad);
    ASSERT_NEAR(*x.drift_azimuth_rad, *y.drift_azimuth_rad, 3 * of_axis / sine + 1e-13 * std::abs(*y.drift_azimuth_rad))
        << x.t_s;
    ASSERT_NEAR(x.drift_tilt_rad, y.drift_tilt_rad, 3 * of_axis + 1e-18) << x.t_s;
    double scale = 0, off = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      scale = std::max(scale, std::abs(y.w_LB_B[k]));
      off = std::max({off, std::abs(x.w_LB_B[k] - y.w_LB_B[k]), std::abs(x.ref_w_LB_B[k] - y.ref_w_LB_B[k])});
    }
    ASSERT_LE(off, scale * of_attitudes * 10) << x.t_s;
  }
}

TEST(ClosedFormDrift, EveryShippedSceneThatHasOneAgreesWithTheIntegration) {
  std::set<std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator(EARTHTOP_SCENARIOS)) {
    if (entry.path().extension() != ".json") continue;
    const Scenario s = testing::shipped(entry.path().stem().string());
    if (Scene(s).method_refusal(Method::closed_form)) continue;
    SCOPED_TRACE(s.name);
    found.insert(s.name);
    expect_agreement(run(by_closed_form(s)), run(s));
  }
  const std::set<std::string> expected = {"dzhanibekov", "free-gyro", "free-rotor-benchmark", "heavy-top-benchmark",
                                          "nesc-tumbling-brick"};
  EXPECT_EQ(found, expected);
}

// Compares with 113-bit integrations in the laboratory's equations, more tightly than any integration in double.
TEST(ClosedFormDrift, RandomScenesAreRightAndTheirBoundsHold) {
  for (const Family family : kFamilies)
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
      const Scenario s = random_of(family, seed, 40);
      SCOPED_TRACE(::testing::Message() << static_cast<int>(family) << " " << seed);
      const RunResult result = run(s);
      ASSERT_EQ(result.status, RunStatus::completed);
      const auto reference = testing::reference_run(s, Observer::laboratory);
      const testing::Comparison c = testing::compare(result, reference);
      // 40 rad of phase, each with the rounding of the scene's derived moments, and a hundred for the functions'.
      EXPECT_LT(c.worst_axis_error, 1000 * real::epsilon<double>());
      EXPECT_LT(c.worst_attitude_error, 1000 * real::epsilon<double>());
      EXPECT_GE(c.least_margin, 1);
      // A body is unstable about its middle axis; there the bound must include the growth of a rounding error at release.
      const auto& I = s.body.inertia_kg_m2;
      const bool unstable = family == Family::free_asymmetric && (I[2][2] - I[0][0]) * (I[2][2] - I[1][1]) < 0;
      if (!unstable) {
        EXPECT_LE(c.worst_excess, 100);
      }
      for (std::size_t i = 0; i < result.rows.size(); ++i) {
        const DriftState<float128>& exact = reference.samples[i].state;
        const auto off = [&](const std::array<double, 4>& q, const Quaternion<float128>& truth) {
          const Quaternion<float128> unit = truth.normalized();
          return distance(q, {static_cast<double>(unit.w), static_cast<double>(unit.v[0]), static_cast<double>(unit.v[1]),
                              static_cast<double>(unit.v[2])});
        };
        ASSERT_LE(off(result.rows[i].q_LB, exact.q_LB), result.attitude_bound_rad) << i;
        ASSERT_LE(off(result.rows[i].ref_q_LB, exact.ref_q_LB), result.attitude_bound_rad) << i;
      }
    }
}

TEST(ClosedFormDrift, RandomScenesAgreeWithTheIntegrationsAnglesAndSigns) {
  for (const Family family : kFamilies)
    for (std::uint64_t seed = 20; seed < 40; ++seed) {
      SCOPED_TRACE(::testing::Message() << static_cast<int>(family) << " " << seed);
      const Scenario s = random_of(family, seed, 300);
      Scenario integrated = s;
      integrated.numerics.method = Method::rkf78;
      integrated.numerics.relative_tolerance = 1e-14;
      integrated.numerics.observer = seed % 3 == 0 ? Observer::laboratory : seed % 3 == 1 ? Observer::body : Observer::inertial;
      expect_agreement(run(s), run(integrated));
    }
}

// The drift is linear in a tiny rate: from one rate to the next, only the rate's own digits may change.
TEST(ClosedFormDrift, AnyEarthRateHasItsDigits) {
  for (const Family family : {Family::free_asymmetric, Family::free_symmetric, Family::heavy_at_pole})
    for (std::uint64_t seed = 0; seed < 8; seed += 4)  // matched in the laboratory
      for (const double rate : {1e-300, -1e-120, 1e-40, 1e-20, 1e-12, 1e-9, -1e-6, 1e-3, 0.1}) {
        Scenario s = random_of(family, seed, 30);
        s.rotation_rate_rad_s = rate;
        s.output_step_s = s.duration_s / 10;
        SCOPED_TRACE(::testing::Message() << static_cast<int>(family) << " " << seed << " " << rate);
        const testing::Comparison c = testing::compare(run(s), testing::reference_run(s, Observer::body));
        EXPECT_LT(c.worst_axis_error, 1000 * real::epsilon<double>());
        EXPECT_LT(c.worst_attitude_error, 1000 * real::epsilon<double>());
        EXPECT_GE(c.least_margin, 1);
      }
}

// Initially the laboratory and the body that was released with it turn alike; after a microradian, only a millionth of the two
// turns remains as their difference.
TEST(ClosedFormDrift, TheFirstMomentsHaveTheirDigits) {
  for (const Family family : {Family::free_asymmetric, Family::free_symmetric, Family::heavy_at_pole})
    for (const double rate : {1e-200, kEarthRateWgs84, 0.1}) {
      Scenario s = random_of(family, 2, 1e-6);
      s.rotation_rate_rad_s = rate;
      s.output_step_s = s.duration_s / 10;
      SCOPED_TRACE(::testing::Message() << static_cast<int>(family) << " " << rate);
      const testing::Comparison c = testing::compare(run(s), testing::reference_run(s, Observer::laboratory, 1e-24));
      EXPECT_LT(c.worst_axis_error, 1000 * real::epsilon<double>());
      EXPECT_LT(c.worst_attitude_error, 1000 * real::epsilon<double>());
      EXPECT_GE(c.least_margin, 1);
    }
}

TEST(ClosedFormDrift, AStandingEarthLeavesExactlyNothing) {
  for (const Family family : kFamilies)
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      const RunResult result = run(testing::non_rotating(random_of(family, seed, 60)));
      ASSERT_EQ(result.status, RunStatus::completed);
      for (const DriftRow& row : result.rows) {
        for (const double zero : {row.drift_axis_rad, row.drift_axis_bound_rad, *row.drift_azimuth_rad, row.drift_tilt_rad,
                                  row.drift_attitude_rad, row.drift_attitude_bound_rad, row.drift_spin_rad}) {
          ASSERT_EQ(zero, 0);
          ASSERT_FALSE(std::signbit(zero));
        }
        ASSERT_EQ(row.q_LB, row.ref_q_LB);
      }
    }
}

// Rows that are hours of turns apart have the same angles and signs as rows that follow every turn.
TEST(ClosedFormDrift, RareRowsKnowHowOftenAnglesWentRound) {
  for (const Family family : {Family::free_asymmetric, Family::free_symmetric, Family::heavy_at_pole, Family::heavy_sideways})
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
      SCOPED_TRACE(::testing::Message() << static_cast<int>(family) << " " << seed);
      Scenario s = random_of(family, seed, 2000);
      s.rotation_rate_rad_s = (seed % 3 == 0 ? -3 : 3) / s.duration_s * 20;
      s.output_step_s = s.duration_s / 3;
      Scenario often = s;
      often.output_step_s = s.duration_s / 1500;
      const RunResult rare = run(s), dense = run(often);
      ASSERT_EQ(rare.rows.size(), 4u);
      for (std::size_t i = 0; i < 4; ++i) {
        const DriftRow &x = rare.rows[i], &y = dense.rows[500 * i];
        EXPECT_LT(distance(x.q_LB, y.q_LB), 1e-10);
        EXPECT_LT(distance(x.ref_q_LB, y.ref_q_LB), 1e-10);
        EXPECT_NEAR(x.drift_spin_rad, y.drift_spin_rad, 1e-9);
        EXPECT_NEAR(x.drift_azimuth_rad.value_or(0), y.drift_azimuth_rad.value_or(0), 1e-9);
      }
      if (family == Family::heavy_at_pole && s.release.rates_relative_to == RatesRelativeTo::inertial) {
        // Compass azimuth: a laboratory that turns counterclockwise sees the axis go round clockwise.
        const double turned = s.rotation_rate_rad_s * s.duration_s * (s.site.latitude_deg > 0 ? 1 : -1);
        EXPECT_GT(std::abs(turned), 6 * kPi);
        EXPECT_NEAR(*rare.rows.back().drift_azimuth_rad, turned, 1e-11);
      }
    }
}

// Integrates the rotating motion alone, without a reference.
TEST(ClosedFormDrift, OneMotionByItselfIsThatOfTheRun) {
  for (const Family family : kFamilies)
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      SCOPED_TRACE(::testing::Message() << static_cast<int>(family) << " " << seed);
      Scenario s = random_of(family, seed, 30);
      s.output_step_s = s.duration_s / 5;
      const MotionTrajectory<double> motion = integrate_motion<double>(Scene(s).problem<double>(), s.numerics);
      ASSERT_EQ(motion.status, RunStatus::completed);
      const auto rows = testing::reference_run(s, Observer::inertial).samples;
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const Quaternion<double>& q = motion.samples[i].q_LB;
        const Quaternion<float128> truth = rows[i].state.q_LB.normalized();
        EXPECT_LT(distance({q.w, q.v[0], q.v[1], q.v[2]}, {static_cast<double>(truth.w), static_cast<double>(truth.v[0]),
                                                           static_cast<double>(truth.v[1]), static_cast<double>(truth.v[2])}),
                  1e-12);
        for (int k = 0; k < 3; ++k)
          EXPECT_NEAR(motion.samples[i].w_LB_B[k], static_cast<double>(rows[i].state.w_LB_B[k]),
                      1e-12 * norm(motion.samples[i].w_LB_B));
      }
    }
}

TEST(ClosedFormDrift, TheThresholdIsPassedWhenTheFormulaSaysSo) {
  Scenario s = by_closed_form(testing::shipped("free-gyro"));
  s.threshold_rad = 1e-3;
  // The gyro's axis is normal to the celestial axis: it drifts by the Earth's turn.
  EXPECT_NEAR(run(s).drift.threshold_time_s.value(), 1e-3 / s.rotation_rate_rad_s, 1e-11);
  s.output_step_s = s.duration_s;
  EXPECT_NEAR(run(s).drift.threshold_time_s.value(), 1e-3 / s.rotation_rate_rad_s, 1e-11);
  s.threshold_rad = 1;
  EXPECT_FALSE(run(s).drift.threshold_time_s);
}

// Results in extended precision agree with an integration in other equations to the digits asked for.
TEST(ClosedFormDrift, ExtendedPrecisionHasItsDigits) {
  for (const Family family : {Family::free_asymmetric, Family::free_symmetric, Family::heavy_at_pole})
    for (const std::uint64_t seed : {2u, 3u}) {
      SCOPED_TRACE(::testing::Message() << static_cast<int>(family) << " " << seed);
      Scenario s = random_of(family, seed, 30);
      s.rotation_rate_rad_s = kEarthRateWgs84;
      s.output_step_s = s.duration_s / 5;
      const auto reference = testing::reference_run(s, Observer::inertial, 1e-28);
      for (const Precision precision : {Precision::bits64, Precision::bits113}) {
        s.precision = precision;
        const RunResult result = run(s);
        ASSERT_EQ(result.extended_rows.size(), 6u);
        float128 largest = 0;
        for (std::size_t i = 0; i < 6; ++i) {
          const ExtendedDriftRow& row = result.extended_rows[i];
          const DriftMeasures<float128>& exact = reference.samples[i].measures;
          largest = std::max(largest, exact.attitude);
          const float128 allowed = (precision == Precision::bits64 ? 1e-16L : 1e-23L) * largest;
          EXPECT_LE(static_cast<double>(real::abs(row.drift_attitude_rad - exact.attitude)), static_cast<double>(allowed));
          // The reference's own error is 1e-26 of the drift.
          EXPECT_LE(static_cast<double>(real::abs(row.drift_axis_rad - exact.axis)),
                    static_cast<double>(row.drift_axis_bound_rad + largest * float128(1e-25L)));
        }
      }
    }
}

}  // namespace
}  // namespace earthtop
