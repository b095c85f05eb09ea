// SPDX-License-Identifier: GPL-3.0-or-later
/// A batch gives the results of its single runs: scenes that fit are integrated side by side in SIMD lanes, the others one by
/// one.

#include <gtest/gtest.h>

#include <cmath>

#include "earthtop/run_batch.hpp"
#include "lanes/driven_tops.hpp"
#include "lanes/lane_bits.hpp"
#include "support/changed_scene.hpp"
#include "support/scenes.hpp"

namespace earthtop {
namespace {

/// Symmetric and asymmetric tops by turns.
std::vector<Scenario> tops(std::size_t count, double radians) {
  std::vector<Scenario> scenes;
  scenes.reserve(count);
  for (std::uint64_t i = 0; i < count; ++i) {
    scenes.push_back(testing::random_scene(i, radians));
    scenes.back().numerics.method = Method::taylor;
  }
  return scenes;
}

bool in_lanes(const RunResult& result) { return result.solution.reason.ends_with("in SIMD lanes"); }

std::vector<std::uint64_t> bits_of(const RunResult& result) {
  testing::Bits bits;
  bits.add(result.status);
  bits.add(result.solution.counters), bits.add(result.certificate.counters);
  for (const DriftRow& row : result.rows) {
    bits.add(row.t_s), bits.add(row.drift_axis_rad), bits.add(row.drift_axis_bound_rad);
    bits.add(row.drift_attitude_rad), bits.add(row.drift_attitude_bound_rad), bits.add(row.drift_spin_rad);
    for (const double q : row.q_LB) bits.add(q);
    for (const double w : row.w_LB_B) bits.add(w);
  }
  bits.add(result.drift.axis_final_rad), bits.add(result.verdict.reliable_until_s);
  return bits.all();
}

/// Batch and single runs agree, within their bounds, with a third run: more digits, another method, other equations.
void expect_agreement_within_bounds(const std::vector<Scenario>& scenes) {
  const std::vector<BatchOutcome> outcomes = run_batch(testing::resolved(scenes));
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    SCOPED_TRACE(i);
    ASSERT_TRUE(outcomes[i].result) << outcomes[i].refusal;
    const RunResult& batch = *outcomes[i].result;
    const RunResult alone = run(scenes[i]);
    Scenario extended = scenes[i];
    extended.precision = Precision::bits64;
    extended.numerics.method = Method::extrapolation;
    extended.numerics.observer = Observer::body;
    extended.numerics.relative_tolerance = default_tolerance(extended.precision);
    const RunResult truth = run(extended);
    EXPECT_TRUE(in_lanes(batch));
    EXPECT_FALSE(in_lanes(alone));
    ASSERT_EQ(batch.status, alone.status);
    ASSERT_EQ(batch.rows.size(), alone.rows.size());
    for (std::size_t row = 0; row < batch.rows.size(); ++row) {
      const DriftRow &got = batch.rows[row], &scalar = alone.rows[row], &exact = truth.rows[row];
      ASSERT_EQ(got.t_s, scalar.t_s);
      ASSERT_LE(std::abs(got.drift_axis_rad - scalar.drift_axis_rad), got.drift_axis_bound_rad + scalar.drift_axis_bound_rad);
      ASSERT_LE(std::abs(got.drift_axis_rad - exact.drift_axis_rad), got.drift_axis_bound_rad + exact.drift_axis_bound_rad);
      ASSERT_LE(std::abs(got.drift_attitude_rad - exact.drift_attitude_rad),
                got.drift_attitude_bound_rad + exact.drift_attitude_bound_rad);
    }
    EXPECT_EQ(batch.verdict.verdict, alone.verdict.verdict);
    EXPECT_EQ(batch.theory.size(), alone.theory.size());
    EXPECT_EQ(batch.invariants.size(), alone.invariants.size());
    EXPECT_EQ(batch.solution.method, Method::taylor);
    EXPECT_EQ(batch.solution.observer, alone.solution.observer);
    EXPECT_EQ(batch.solution.form, alone.solution.form);
    EXPECT_EQ(batch.certificate.method, Method::taylor);
    EXPECT_EQ(batch.certificate.observer, Observer::inertial);
    EXPECT_NE(batch.certificate.relative_tolerance, batch.solution.relative_tolerance);
    EXPECT_GT(batch.solution.counters.accepted, 0);
    EXPECT_EQ(batch.scene.scenario().name, scenes[i].name);
    EXPECT_EQ(batch.modelled.scenario().name, scenes[i].name);
  }
}

TEST(RunBatch, AgreesWithRunsWithinTheBounds) { expect_agreement_within_bounds(tops(36, 60)); }
TEST(RunBatch, AgreesWithRunsWithinTheBoundsWhereEquationsAreRecorded) {
  expect_agreement_within_bounds(testing::driven_tops(32, 60));
}

/// Whether the second integration is the looser or the finer one, the bounds contain the error against more digits.
TEST(RunBatch, BoundsHoldAtEveryTolerance) {
  const std::vector<Scenario> scenes = tops(12, 120);
  std::vector<RunResult> truths;
  truths.reserve(scenes.size());
  for (Scenario extended : scenes) {
    extended.precision = Precision::bits64;
    extended.numerics.relative_tolerance = 1e-17;
    truths.push_back(run(extended));
  }
  for (const double tolerance : {1e-11, 1e-10, 1e-9, 1e-6}) {
    std::vector<Scenario> loose = scenes;
    for (Scenario& scene : loose) scene.numerics.relative_tolerance = tolerance;
    const std::vector<BatchOutcome> outcomes = run_batch(testing::resolved(loose));
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      SCOPED_TRACE(i);
      ASSERT_TRUE(outcomes[i].result) << outcomes[i].refusal;
      const RunResult& batch = *outcomes[i].result;
      if (batch.verdict.verdict != Verdict::reliable) continue;
      for (std::size_t row = 0; row < batch.rows.size(); ++row) {
        const DriftRow &got = batch.rows[row], &exact = truths[i].rows[row];
        ASSERT_LE(std::abs(got.drift_axis_rad - exact.drift_axis_rad), got.drift_axis_bound_rad + exact.drift_axis_bound_rad);
        ASSERT_LE(std::abs(got.drift_attitude_rad - exact.drift_attitude_rad),
                  got.drift_attitude_bound_rad + exact.drift_attitude_bound_rad);
      }
    }
  }
}

TEST(RunBatch, OutcomesAreTheirOwn) {
  for (std::vector<Scenario> scenes : {tops(70, 20), testing::driven_tops(70, 20)}) {
    for (std::size_t i = 0; i < scenes.size(); i += 5) scenes[i].numerics.relative_tolerance = 1e-9;
    const auto all = run_batch(testing::resolved(scenes));
    for (const std::size_t i : {0U, 1U, 5U, 33U, 69U}) {
      const auto one = run_batch(testing::resolved({scenes[i]}));
      EXPECT_EQ(bits_of(*one[0].result), bits_of(*all[i].result)) << i;
    }
  }
}

TEST(RunBatch, RunsWhatDoesNotFitByItself) {
  std::vector<Scenario> scenes;
  scenes.push_back(testing::asymmetric_top());
  scenes.back().effects.applied.coulomb_N_m = 1e-5;
  scenes.push_back(testing::toy_top());
  scenes.back().precision = Precision::bits64;
  scenes.back().numerics.relative_tolerance = default_tolerance(Precision::bits64);
  scenes.push_back(testing::toy_top());
  scenes.back().accuracy_rad = 1e-6;
  scenes.push_back(testing::toy_top());
  scenes.back().numerics.method = Method::rkf78;
  scenes.push_back(testing::toy_top());
  scenes.back().effects.centrifugal = false;
  scenes.push_back(testing::asymmetric_top());
  scenes.back().numerics.observer = Observer::inertial;
  for (Scenario& scene : scenes) scene.duration_s = 0.3;
  const auto outcomes = run_batch(testing::resolved(scenes));
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    ASSERT_TRUE(outcomes[i].result);
    EXPECT_FALSE(in_lanes(*outcomes[i].result)) << i;
    EXPECT_EQ(bits_of(*outcomes[i].result), bits_of(run(scenes[i]))) << i;
  }
}

/// A refused scene, and one that runs into its step limit, do not affect the sound ones beside them.
TEST(RunBatch, LeavesTroubleWhereItIs) {
  std::vector<Scenario> scenes = tops(9, 20);
  const auto expected = run_batch(testing::resolved(scenes));
  scenes[3] = testing::asymmetric_top();
  scenes[3].numerics.method = Method::long_horizon;
  scenes[6] = testing::random_scene(5, 200);
  scenes[6].numerics.method = Method::taylor;
  scenes[6].numerics.step_limit =
      static_cast<std::int64_t>(Scene(scenes[6]).estimate().solution.steps) + 1;  // fewer than it takes
  const auto got = run_batch(testing::resolved(scenes));
  for (std::size_t i = 0; i < scenes.size(); ++i)
    if (i != 3 && i != 6) {
      EXPECT_EQ(bits_of(*got[i].result), bits_of(*expected[i].result)) << i;
    }
  EXPECT_FALSE(got[3].result);
  EXPECT_NE(got[3].refusal.find("/numerics/method"), std::string::npos) << got[3].refusal;
  ASSERT_TRUE(got[6].result);
  EXPECT_TRUE(in_lanes(*got[6].result));
  EXPECT_EQ(got[6].result->status, RunStatus::step_limit);
  EXPECT_GT(got[6].result->rows.size(), 3U);
  EXPECT_LT(got[6].result->reached_s, scenes[6].duration_s);
}

}  // namespace
}  // namespace earthtop
