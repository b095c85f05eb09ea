// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/results/headline.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "earthtop/results/results.hpp"
#include "results/columns.hpp"
#include "results/made_up_run.hpp"
#include "scenario/fields.hpp"
#include "support/json.hpp"

namespace earthtop {
namespace {

using nlohmann::json;

RunResult run_with(HeadlineSpec headline, RunResult result = test::made_up_run()) {
  result.drift.threshold_time_s = 12.5;
  result.scene = testing::changed(result.scene, [&](Scenario& s) { s.headline = std::move(headline); });
  return result;
}

json headline_of(const RunResult& result) { return testing::parse_json(summary_json(result)).at("headline"); }

TEST(Headline, NoneWithoutOne) {
  EXPECT_FALSE(check_headline(test::made_up_run()));
  EXPECT_TRUE(headline_of(test::made_up_run()).is_null());
}

TEST(Headline, HoldsTheRowOfItsTime) {
  const RunResult result = run_with({"drift_tilt_rad", 30.0, 1e-4, 1e-3, "closed form"});
  const auto check = check_headline(result);
  ASSERT_TRUE(check);
  EXPECT_EQ(check->at_s, 30.0);
  EXPECT_EQ(check->computed, result.rows.at(100).drift_tilt_rad);
  EXPECT_EQ(check->difference, result.rows.at(100).drift_tilt_rad - 1e-4);
  EXPECT_TRUE(check->met);
}

TEST(Headline, RowIsTheLastOneByDefault) {
  const RunResult result = run_with({"drift_axis_rad", {}, 0, 1, "closed form"});
  EXPECT_EQ(check_headline(result)->computed, result.rows.back().drift_axis_rad);
  EXPECT_EQ(check_headline(result)->at_s, 60.0);
}

TEST(Headline, ToleranceIsTheLargestDifference) {
  const double value = test::made_up_run().rows.back().drift_spin_rad;
  EXPECT_TRUE(check_headline(run_with({"drift_spin_rad", {}, value - 0.125, 0.125, ""}))->met);
  EXPECT_TRUE(check_headline(run_with({"drift_spin_rad", {}, value + 0.125, 0.125, ""}))->met);
  EXPECT_FALSE(check_headline(run_with({"drift_spin_rad", {}, value - 0.125, 0.1249, ""}))->met);
}

TEST(Headline, RunThatStoppedEarlyHasNotMetIt) {
  RunResult result = run_with({"drift_axis_rad", 30.0, 0, 1, ""});
  ASSERT_TRUE(check_headline(result)->met);
  result.status = RunStatus::step_underflow;
  EXPECT_FALSE(check_headline(result)->met);
  result.rows.resize(50);
  const auto check = check_headline(result);
  EXPECT_FALSE(check->computed || check->difference || check->met);
}

TEST(Headline, WhatIsMissingOrNotFiniteIsNotMet) {
  RunResult result = run_with({"drift_azimuth_rad", {}, 0, 1, "closed form"});
  for (const std::optional<double> value : {std::optional<double>(), std::optional(std::numeric_limits<double>::quiet_NaN()),
                                            std::optional(std::numeric_limits<double>::infinity())}) {
    result.rows.back().drift_azimuth_rad = value;
    const auto check = check_headline(result);
    EXPECT_FALSE(check->computed || check->difference || check->met);
    const json written = headline_of(result);
    EXPECT_TRUE(written.at("computed").is_null() && written.at("difference").is_null());
    EXPECT_EQ(written.at("met"), false);
  }
  result.rows.clear();
  EXPECT_FALSE(check_headline(result)->met);
}

TEST(Headline, IsInTheSummary) {
  const json written = headline_of(run_with({"drift_spin_rad", {}, -6e-4, 1e-9, "theory [F]"}));
  EXPECT_EQ(written.at("quantity"), "drift_spin_rad");
  EXPECT_EQ(written.at("at_s"), 60.0);
  EXPECT_EQ(written.at("stated"), -6e-4);
  EXPECT_EQ(written.at("tolerance"), 1e-9);
  EXPECT_NEAR(written.at("computed").get<double>(), -6e-4, 1e-18);
  EXPECT_NEAR(written.at("difference").get<double>(), 0, 1e-18);
  EXPECT_EQ(written.at("met"), true);
  EXPECT_EQ(written.at("origin"), "theory [F]");
}

// A scenario may name every quantity that can be looked up, and no other.
TEST(Headline, EveryQuantityIsAColumnOrAFigureOfTheSummary) {
  const auto words = input::split_words(scenario::fields().find("/headline/quantity")->words);
  for (const Column& column : trajectory_columns()) {
    const bool is_a_figure_of_merit =
        column.name == "drift_reliable" || column.name == "contact_state" || column.name.find("_bound_") != std::string::npos;
    EXPECT_NE(std::find(words.begin(), words.end(), column.name) != words.end(), is_a_figure_of_merit) << column.name;
  }
  for (const std::string_view word : words) {
    RunResult on_table = test::made_up_contact_run();
    on_table.contact->events.resize(4, on_table.contact->events.back());
    const auto names = [&](std::string_view part) { return word.find(part) != std::string_view::npos; };
    const bool of_journey = names("latitude") || names("longitude") || names("height") || names("course") ||
                            names("speed_m_s") || names("w_IL_L") || names("G_L_") || word.starts_with("travel.");
    RunResult made = of_journey       ? test::made_up_journey_run()
                     : names("rotor") ? test::made_up_rotor_run()
                     : names("outer_angle") || names("outer_rate") || names("inner_angle") || names("inner_rate")
                         ? test::made_up_gimbals_run()
                         : std::move(on_table);
    const RunResult result = run_with({std::string(word), {}, 0, 1, "closed form"}, std::move(made));
    const auto check = check_headline(result);
    ASSERT_TRUE(check->computed) << word;
    const bool is_path = word.find('.') != std::string_view::npos;
    EXPECT_EQ(check->at_s.has_value(), !is_path) << word;
    if (!is_path) continue;
    std::string pointer = fmt::format("/{}", word);
    std::replace(pointer.begin(), pointer.end(), '.', '/');
    EXPECT_EQ(testing::parse_json(summary_json(result)).at(json::json_pointer(pointer)).get<double>(), *check->computed)
        << word;
  }
}

}  // namespace
}  // namespace earthtop
