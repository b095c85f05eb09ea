// SPDX-License-Identifier: GPL-3.0-or-later
/// The precision switch: unrelated methods and observers agree on the digits, bounds hold from one precision to the next,
/// residuals are of the size of the scalar's rounding, and zeros are exact.

#include <gtest/gtest.h>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/results/results.hpp"
#include "earthtop/scene/scene.hpp"
#include "support/scenes.hpp"
#include "support/soundness.hpp"

namespace earthtop {
namespace {

using testing::shipped;

/// The beginning of a shipped scene, over `radians` of its fastest motion, in ten rows.
Scenario beginning(const char* name, double radians, Precision precision) {
  Scenario scenario = shipped(name);
  scenario.duration_s = radians / Scene(scenario).fastest_rate_rad_s();
  scenario.output_step_s = scenario.duration_s / 10;
  scenario.precision = precision;
  scenario.numerics.relative_tolerance = default_tolerance(precision);
  return scenario;
}

std::string last_field(const std::string& csv, std::size_t column) {
  std::string line = csv.substr(csv.rfind('\n', csv.size() - 2) + 1);
  for (; column > 0; --column) line.erase(0, line.find(',') + 1);
  return line.substr(0, line.find(','));
}

/// Number of significant digits that two printed numbers share.
int shared_digits(const std::string& a, const std::string& b) {
  int digits = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()) && a[i] == b[i] && a[i] != 'e'; ++i)
    digits += a[i] != '.' && (digits > 0 || (a[i] != '0' && a[i] != '-'));
  return digits;
}

constexpr std::size_t kAxisColumn = 21, kAttitudeColumn = 25;

TEST(Precision, PrintedDigitsAgreeBetweenUnrelatedMethods) {
  for (const char* name : {"toy-top", "fast-gyro"}) {
    SCOPED_TRACE(name);
    Scenario scenario = beginning(name, 25, Precision::bits113);
    const RunResult extrapolated = run(scenario);
    EXPECT_EQ(extrapolated.solution.method, Method::extrapolation);
    EXPECT_EQ(extrapolated.solution.precision, "float128");
    scenario.numerics.method = Method::rkf78;
    scenario.numerics.observer = Observer::body;
    scenario.numerics.relative_tolerance = 1e-27;
    const RunResult embedded = run(scenario);
    scenario.numerics.method = Method::taylor;
    scenario.numerics.observer = Observer::laboratory;
    const RunResult series = run(scenario);
    EXPECT_EQ(series.solution.form, ModelForm::reduced);
    EXPECT_GE(
        shared_digits(last_field(trajectory_csv(extrapolated), kAxisColumn), last_field(trajectory_csv(series), kAxisColumn)),
        26);
    const std::string one = trajectory_csv(extrapolated), other = trajectory_csv(embedded);
    for (const std::size_t column : {kAxisColumn, kAttitudeColumn}) {
      EXPECT_GE(last_field(one, column).size(), 30u);
      EXPECT_GE(shared_digits(last_field(one, column), last_field(other, column)), 25)
          << last_field(one, column) << " " << last_field(other, column);
    }
    // Both bounds hold: each covers its own run's distance from the truth, so the sum covers that between the runs.
    for (std::size_t i = 0; i < embedded.rows.size(); ++i) {
      const ExtendedDriftRow &p = extrapolated.extended_rows[i], &q = embedded.extended_rows[i];
      EXPECT_LE(real::abs(p.drift_axis_rad - q.drift_axis_rad), p.drift_axis_bound_rad + q.drift_axis_bound_rad);
      EXPECT_LE(real::abs(p.drift_attitude_rad - q.drift_attitude_rad),
                p.drift_attitude_bound_rad + q.drift_attitude_bound_rad);
    }
    EXPECT_LT(extrapolated.drift.axis_bound_rad, 1e-24 * extrapolated.drift.axis_max_rad);
  }
}

TEST(Precision, BoundsHoldFromOnePrecisionToTheNext) {
  for (const char* name : {"toy-top", "fast-gyro", "asymmetric-top", "turntable", "dzhanibekov", "lecture-gyro"}) {
    SCOPED_TRACE(name);
    const RunResult exact = run(beginning(name, 40, Precision::bits113));
    for (const Precision precision : {Precision::bits53, Precision::bits64}) {
      const RunResult result = run(beginning(name, 40, precision));
      ASSERT_EQ(result.rows.size(), exact.rows.size());
      for (std::size_t i = 0; i < exact.rows.size(); ++i) {
        const ExtendedDriftRow& truth = exact.extended_rows[i];
        const auto miss = [&](double value, const float128* in_full, float128 of) {
          return static_cast<double>(real::abs((in_full ? *in_full : static_cast<float128>(value)) - of));
        };
        const DriftRow& row = result.rows[i];
        const ExtendedDriftRow* full = precision == Precision::bits53 ? nullptr : &result.extended_rows[i];
        EXPECT_LE(miss(row.drift_axis_rad, full ? &full->drift_axis_rad : nullptr, truth.drift_axis_rad),
                  row.drift_axis_bound_rad);
        EXPECT_LE(miss(row.drift_attitude_rad, full ? &full->drift_attitude_rad : nullptr, truth.drift_attitude_rad),
                  row.drift_attitude_bound_rad);
      }
    }
  }
}

TEST(Precision, ResidualsAreOfTheScalarsSize) {
  // 300 rad: their rounding adds up to some hundred eps, and the bound of a step's error to less.
  const std::pair<Precision, double> cases[] = {
      {Precision::bits53, 2.2e-16}, {Precision::bits64, 1.1e-19}, {Precision::bits113, 1.9e-34}};
  for (const auto& [precision, eps] : cases) {
    SCOPED_TRACE(to_string(precision));
    Scenario scenario = beginning("toy-top", 50, precision);
    scenario.ledger = LedgerObserver::laboratory;
    const RunResult result = run(scenario);
    const double tolerance = Scene(scenario).choice().options.relative_tolerance;
    ASSERT_EQ(result.invariants.size(), 3u);
    for (const InvariantReport& invariant : result.invariants)
      EXPECT_LT(invariant.largest_change, (100 * eps + 50 * tolerance) * invariant.scale) << invariant.name;
    ASSERT_TRUE(result.ledger.has_value());
    EXPECT_LT(result.ledger->largest.relative_residual(), 100 * eps);
    EXPECT_EQ(result.ledger->extended_entries.size(), precision == Precision::bits53 ? 0 : result.rows.size());
    EXPECT_EQ(result.extended_rows.size(), precision == Precision::bits53 ? 0 : result.rows.size());
  }
}

TEST(Precision, WithoutTheEarthsRateTheDriftIsExactlyZero) {
  for (const Precision precision : {Precision::bits53, Precision::bits64, Precision::bits113})
    for (const Observer observer : {Observer::laboratory, Observer::body, Observer::inertial}) {
      Scenario scenario = testing::non_rotating(beginning("asymmetric-top", 10, precision));
      scenario.numerics.observer = observer;
      const RunResult result = run(scenario);
      ASSERT_EQ(result.rows.size(), 11u);
      for (const DriftRow& row : result.rows)
        for (const double drift : {row.drift_axis_rad, row.drift_axis_bound_rad, row.drift_azimuth_rad.value(),
                                   row.drift_tilt_rad, row.drift_attitude_rad, row.drift_spin_rad}) {
          EXPECT_EQ(drift, 0);
          EXPECT_FALSE(std::signbit(drift));
        }
    }
}

TEST(Precision, ATinyRateKeepsItsDigits) {
  // First order in the rate: the drift over the rate does not depend on it.
  const auto drift_over_rate = [](double rate, Precision precision) {
    Scenario scenario = beginning("toy-top", 10, precision);
    scenario.rotation_rate_rad_s = rate;
    const RunResult result = run(scenario);
    return result.drift.axis_final_rad / rate;
  };
  for (const Precision precision : {Precision::bits64, Precision::bits113})
    EXPECT_NEAR(drift_over_rate(1e-290, precision) / drift_over_rate(1e-20, precision), 1, 1e-14);
}

}  // namespace
}  // namespace earthtop
