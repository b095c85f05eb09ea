// SPDX-License-Identifier: GPL-3.0-or-later
/// Rows that are made when they are written are those of a run that holds all of them.
#include "earthtop/run/each_row.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include "earthtop/results/results.hpp"
#include "earthtop/scenario/scenario.hpp"
#include "run/later_rows.hpp"

namespace earthtop {
namespace {

constexpr int kRows = 20'500;

Scenario long_table(const std::string& name, double duration_s) {
  Scenario s = parse_scenario(read_scenario_source(EARTHTOP_SCENARIOS "/" + name + ".json"));
  s.duration_s = duration_s, s.output_step_s = duration_s / (kRows - 0.7);  // the last row is nearer than the others
  s.headline.reset();
  return s;
}
Scenario by(Method method, Scenario s) {
  s.numerics.method = method;
  return s;
}
/// The drift goes round several times: a count of turns, or a sign of an attitude, that is lost between two parts of the rows shows.
Scenario many_turns() {
  Scenario s = by(Method::taylor, long_table("toy-top", 30));
  s.rotation_rate_rad_s = 1;
  return s;
}
Scenario in_a_viscous_pivot() {
  Scenario s = long_table("toy-top", 5);
  s.effects.applied.viscous_N_m_s = 1e-6;
  return s;
}

std::vector<DriftRow> all_rows(const RunResult& result) {
  std::vector<DriftRow> rows;
  each_row(result, [&](const DriftRow& row) { rows.push_back(row); });
  return rows;
}

template <std::size_t n>
double apart(const std::array<double, n>& a, const std::array<double, n>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

TEST(EachRow, IsThatOfARunThatHoldsAllRows) {
  for (const Scenario& scenario :
       {long_table("toy-top", 5), many_turns(), by(Method::long_horizon, long_table("fast-gyro", 200)),
        by(Method::closed_form, long_table("free-gyro", 60)), long_table("asymmetric-top", 3), in_a_viscous_pivot(),
        by(Method::taylor, long_table("steady-precession-90-degrees", 5))}) {
    SCOPED_TRACE(scenario.name);
    const Scene scene(scenario);
    ASSERT_TRUE(is_made_row_by_row(scene));
    const RunResult whole = run(scene), few = run(scene, {.jobs = 2, .row_by_row = true});
    EXPECT_EQ(whole.later_rows, nullptr);
    ASSERT_NE(few.later_rows, nullptr);
    EXPECT_LE(few.rows.size(), 1002U);
    ASSERT_EQ(row_count(few), whole.rows.size());
    EXPECT_EQ(few.solution.method, whole.solution.method);
    const std::vector<DriftRow> rows = all_rows(few);
    ASSERT_EQ(rows.size(), whole.rows.size());
    double largest = 0, bound_rad = 0, farthest = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const DriftRow &a = rows[i], &b = whole.rows[i];
      ASSERT_EQ(a.t_s, b.t_s);
      ASSERT_EQ(a.drift_reliable, b.drift_reliable);
      ASSERT_GE(a.drift_axis_bound_rad, bound_rad) << a.t_s;  // bounds only grow
      bound_rad = a.drift_axis_bound_rad;
      const double both = a.drift_attitude_bound_rad + b.drift_attitude_bound_rad;
      largest = std::max({largest, std::abs(a.drift_axis_rad - b.drift_axis_rad) - both,
                          std::abs(a.drift_tilt_rad - b.drift_tilt_rad) - both,
                          std::abs(a.drift_attitude_rad - b.drift_attitude_rad) - both,
                          (std::abs(a.drift_spin_rad - b.drift_spin_rad) * horizontal(b) - 4 * both)});
      ASSERT_EQ(a.drift_azimuth_rad.has_value(), b.drift_azimuth_rad.has_value());
      if (b.drift_azimuth_rad)
        largest = std::max(largest, std::abs(*a.drift_azimuth_rad - *b.drift_azimuth_rad) * horizontal(b) - 2 * both);
      farthest = std::max({farthest, apart(a.q_LB, b.q_LB), apart(a.ref_q_LB, b.ref_q_LB), apart(a.axis_L, b.axis_L)});
    }
    EXPECT_LE(largest, 0);
    EXPECT_LE(farthest, few.attitude_bound_rad + whole.attitude_bound_rad);
    const AxisMeans mean = axis_means(few), all = axis_means(whole);
    EXPECT_LE(apart(mean.axis_L, all.axis_L), whole.attitude_bound_rad);
    EXPECT_LE(apart(mean.ref_axis_L, all.ref_axis_L), whole.attitude_bound_rad);
    // The summary speaks of the same last row, and of as many rows.
    EXPECT_EQ(rows.back().drift_axis_rad, few.drift.axis_final_rad);
    EXPECT_EQ(rows.back().drift_axis_bound_rad, few.drift.axis_bound_rad);
    // One thread or two, now or later: the same text.
    const RunResult alone = run(scene, {.jobs = 1, .row_by_row = true});
    EXPECT_TRUE(trajectory_csv(alone) == trajectory_csv(few));
    EXPECT_TRUE(summary_json(alone) == summary_json(few));
  }
}

TEST(EachRow, IsHeldWhereMoreIsToldOfIt) {
  const Scenario plain = long_table("toy-top", 5);
  Scenario s = plain;
  s.ledger = LedgerObserver::laboratory;
  EXPECT_FALSE(is_made_row_by_row(Scene(s)));
  s = plain, s.headline = HeadlineSpec{"drift_axis_rad", 0, 1, 2.5, {}};
  EXPECT_FALSE(is_made_row_by_row(Scene(s)));
  s = plain, s.precision = Precision::bits64;
  EXPECT_FALSE(is_made_row_by_row(Scene(s)));
  s = plain, s.effects.applied.coulomb_N_m = 1e-5;
  EXPECT_FALSE(is_made_row_by_row(Scene(s)));
  EXPECT_FALSE(is_made_row_by_row(Scene(by(Method::rkf78, plain))));
  s = plain, s.output_step_s = s.duration_s / static_cast<double>(kLongTable);
  EXPECT_FALSE(is_made_row_by_row(Scene(s)));
  EXPECT_EQ(run(Scene(s), {.row_by_row = true}).rows.size(), kLongTable + 1);
  EXPECT_EQ(run(Scene(plain)).rows.size(), kRows + 1U);
}

// A row that is doubtful need not be among the few that the result holds.
TEST(EachRow, IsAskedWhetherAllAreReliable) {
  RunResult result = run(Scene(long_table("toy-top", 5)), {.row_by_row = true});
  EXPECT_TRUE(is_all_reliable(result));
  const double step_s = result.scene.scenario().output_step_s;
  result.verdict.intervals.push_back({0.9 * step_s, 1.1 * step_s, Doubt::noise});
  EXPECT_FALSE(is_all_reliable(result));
  EXPECT_EQ(std::ranges::count_if(all_rows(result), [](const DriftRow& row) { return !row.drift_reliable; }), 1);
  result.verdict.intervals.back() = {0.1 * step_s, 0.9 * step_s, Doubt::noise};  // between two rows
  EXPECT_TRUE(is_all_reliable(result));
}

TEST(EachRow, EndsEarlyWhereItIsAskedTo) {
  const RunResult result = run(Scene(long_table("toy-top", 5)), {.row_by_row = true});
  std::atomic<bool> stop = false;
  std::size_t seen = 0;
  each_row(
      result,
      [&](const DriftRow&) {
        if (++seen == 3000) stop = true;
      },
      Watch(&stop, nullptr));
  EXPECT_GE(seen, 3000U);
  EXPECT_LT(seen, row_count(result) / 2);
}

TEST(EachRow, SaysThatTheMotionCannotBeIntegratedOnceMore) {
  const Scene scene(long_table("toy-top", 5));
  RunResult result = run(scene, {.row_by_row = true});
  IntegrationOptions options = scene.choice().options;
  options.step_limit = 1;
  result.later_rows = std::make_shared<const LaterRows>(with_few_rows(scene), OutputTimes(5, scene.scenario().output_step_s),
                                                        options, LookMemory(), std::vector<JudgedLook>(1), false);
  try {
    all_rows(result);
    FAIL() << "rows were made of nothing";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "the motion between two rows could not be integrated once more");
  }
}

}  // namespace
}  // namespace earthtop
