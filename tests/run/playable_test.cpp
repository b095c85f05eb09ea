// SPDX-License-Identifier: GPL-3.0-or-later
// Which scenes the page to play with runs. tests/play/engine_test.mjs asks the engine itself.
#include "run/playable.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "earthtop/error.hpp"
#include "earthtop/run.hpp"
#include "earthtop/scenario/scenario.hpp"

namespace earthtop {
namespace {

std::string refusal_of(const std::function<void(Scenario&)>& change) {
  Scenario scenario = parse_scenario(read_scenario_source(EARTHTOP_SCENARIOS "/toy-top.json"));
  change(scenario);
  return unplayable(resolve(scenario));
}

TEST(Playable, AToyTopIs) {
  EXPECT_EQ(refusal_of([](Scenario&) {}), "");
}

TEST(Playable, WhatAPageLacksIsNamed) {
  EXPECT_EQ(refusal_of([](Scenario& s) { s.precision = Precision::bits113; }),
            "a page computes in double alone; run it with the program, earthtop run");
  EXPECT_EQ(refusal_of([](Scenario& s) { s.start_utc = "2026-11-22T12:00:00Z"; }),
            "a page has no places of the Sun and the Moon; run it with the program, earthtop run");
  EXPECT_EQ(refusal_of([](Scenario& s) { s.effects.automatic = true; }),
            "a page has no places of the Sun and the Moon; run it with the program, earthtop run");
  EXPECT_EQ(refusal_of([](Scenario& s) { s.travel = TravelSpec{.speed_m_s = 10}; }),
            "a page shows a laboratory at rest, and this one travels; run it with the program, earthtop run");
  EXPECT_EQ(refusal_of([](Scenario& s) { s.output_step_s = s.duration_s / 2e5 / 0.999; }), "");
  EXPECT_EQ(refusal_of([](Scenario& s) { s.output_step_s = s.duration_s / 250000; }),
            "this run has 250000 rows, and a page takes 200000; lengthen /motion/output_step_s, or run it with the program, "
            "earthtop run");
}

// Above and below ten seconds of the library's own estimate, which grows with the duration.
TEST(Playable, ALongRunIsNot) {
  Scenario scenario = parse_scenario(read_scenario_source(EARTHTOP_SCENARIOS "/caged-gyroscope.json"));
  const double seconds = estimated_run_seconds(resolve(scenario));
  ASSERT_GT(seconds, 0);
  const double whole_s = scenario.duration_s;
  for (const double wanted : {8.0, 12.0}) {
    scenario.duration_s = whole_s * wanted / seconds;
    scenario.output_step_s = scenario.duration_s / 100;
    const Scene scene = resolve(scenario);
    const bool is_long = estimated_run_seconds(scene) > 10;
    EXPECT_EQ(unplayable(scene).starts_with("this run would take "), is_long) << wanted;
  }
}

}  // namespace
}  // namespace earthtop
