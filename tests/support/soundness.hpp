// SPDX-License-Identifier: GPL-3.0-or-later
/// The accuracy that a run's drift and bound must have, judged by 113-bit arithmetic in another observer's equations.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "support/reference.hpp"
#include "support/scenes.hpp"

namespace earthtop::testing {

/// The accuracy asked of the defaults: an error below 1e-8 of the largest drift so far, and a bound that holds at every row and
/// is never more than 100 times max(true error, 1e-13 rad, 1e-10 of the largest drift so far).
inline void expect_sound(const Scenario& scenario, Observer reference_observer) {
  SCOPED_TRACE(scenario.name);
  const RunResult result = run(scenario);
  ASSERT_EQ(result.status, RunStatus::completed);
  const auto reference = reference_run(scenario, reference_observer);
  ASSERT_EQ(reference.status, RunStatus::completed);
  ASSERT_GT(result.drift.axis_max_rad, 0);
  const Comparison c = compare(result, reference);
  EXPECT_LT(c.worst_axis_error, 1e-8);
  EXPECT_LT(c.worst_attitude_error, 1e-8);
  EXPECT_GE(c.least_margin, 1);
  EXPECT_LE(c.worst_excess, 100);
}

/// The same for a random scene of 100 rad, with the reference in the equations of one of two observers.
inline void expect_random_scene_sound(std::uint64_t seed) {
  const Scenario scenario = random_scene(seed, 100);
  ASSERT_TRUE(body_violations(scenario.body).empty());
  expect_sound(scenario, seed % 2 == 0 ? Observer::inertial : Observer::body);
}

inline Scenario shipped(const std::string& name) {
  return parse_scenario(read_scenario_source(std::string(EARTHTOP_SCENARIOS) + "/" + name + ".json"));
}

}  // namespace earthtop::testing
