// SPDX-License-Identifier: GPL-3.0-or-later
/// Whatever says how far a run's drift is to be trusted says the same: the verdict, its intervals, the rows' marks, the times of
/// summary.json, the threshold, the headline figure, the terminal, the page and the picture.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "earthtop/report/report.hpp"
#include "earthtop/results/headline.hpp"
#include "earthtop/results/results.hpp"
#include "number_text.hpp"
#include "results/made_up_run.hpp"
#include "run/verdict.hpp"
#include "screen.hpp"
#include "summary_text.hpp"
#include "support/count.hpp"
#include "support/effect_scenes.hpp"
#include "support/json.hpp"
#include "support/temporary_directory.hpp"
#include "text/number_words.hpp"

namespace earthtop {
namespace {

using nlohmann::json;
using testing::count;

bool has(const std::string& text, std::string_view what) { return text.find(what) != std::string::npos; }

std::string page_of(const RunResult& result) {
  const testing::TemporaryDirectory directory;
  write_results(result, directory.path() / "run", false);
  return make_report(directory.path() / "run").html;
}

/// Whether any interval of a summary contains a time.
bool doubts(const json& intervals, double t_s) {
  return std::ranges::any_of(intervals, [&](const json& interval) {
    const bool over = interval.at("until_s").is_number() && t_s >= interval.at("until_s").get<double>();
    return t_s >= interval.at("from_s").get<double>() && !over;
  });
}
bool is_of_verdict(const json& interval) {
  const auto type = std::ranges::find(kDoubts, interval.at("why").get<std::string>(), &DoubtType::name);
  EXPECT_EQ(interval.at("text"), type->words);
  return type->of_verdict;
}

void expect_one_word(const RunResult& result) {
  const json summary = testing::parse_json(summary_json(result)), drift = summary.at("drift");
  const json intervals = drift.at("verdict_intervals"), reliable = drift.at("reliable");
  const std::string verdict = drift.at("verdict");

  // The verdict and its times.
  const auto first_of_verdict = std::ranges::find_if(intervals, is_of_verdict);
  const bool has_own = first_of_verdict != intervals.end();
  if (verdict == "reliable") EXPECT_FALSE(has_own);
  if (verdict == "noise_floor" || verdict == "marginal" || verdict == "unassessed") EXPECT_TRUE(has_own);
  EXPECT_EQ(drift.at("verdict_from_s"), has_own ? first_of_verdict->at("from_s") : json());
  EXPECT_EQ(reliable.at("until_s").get<double>(),
            intervals.empty() ? result.reached_s : intervals.at(0).at("from_s").get<double>());

  // The rows.
  bool all = true;
  const DriftRow* last = nullptr;
  for (const DriftRow& row : result.rows) {
    EXPECT_EQ(row.drift_reliable, !doubts(intervals, row.t_s)) << row.t_s;
    EXPECT_FALSE(row.drift_reliable && row.contact && row.contact->state == ContactState::mixed) << row.t_s;
    all = all && row.drift_reliable;
    if (row.drift_reliable) last = &row;
  }
  const bool to_the_end = last == &result.rows.back();
  const bool known = last && last->t_s > 0;
  EXPECT_EQ(reliable.at("at_s"), last ? json(last->t_s) : json());
  EXPECT_EQ(reliable.at("axis_rad"), last ? json(last->drift_axis_rad) : json());

  // A threshold is said to be passed only where the drift is trusted, and so is a headline figure.
  if (result.drift.threshold_crossing == ThresholdCrossing::clear)
    EXPECT_TRUE(result.verdict.trusts(*result.drift.threshold_time_s));
  RunResult stated = result;
  Scenario scenario = result.scene.scenario();
  scenario.headline = HeadlineSpec{"drift_axis_rad", result.rows.back().t_s, 0, 1, "anything"};
  stated.scene = Scene(scenario);
  if (!is_partial(result)) EXPECT_EQ(check_headline(stated)->computed.has_value(), to_the_end);

  // The terminal.
  const std::string text = tool::summary_text(result, {"nowhere", ""}, false, {200, false});
  EXPECT_EQ(has(text, known ? "Drift after " + time_text(last->t_s) : "none that can be trusted"), true) << text;
  EXPECT_EQ(has(text, "marked as not reliable"), !all) << text;
  EXPECT_EQ(has(text, "later rows are written"), known && !to_the_end) << text;
  EXPECT_EQ(has(text, "at most "), known && result.verdict.trusts(result.drift.axis_max_at_s)) << text;
  if (has_own && verdict != "unassessed")
    EXPECT_TRUE(has(text, fmt::format("from {:.6g} ", first_of_verdict->at("from_s").get<double>()))) << text;
  for (const json& interval : intervals)
    if (!is_of_verdict(interval)) EXPECT_TRUE(has(text, interval.at("text").get<std::string>())) << text;

  // The page and the picture.
  const std::string page = page_of(result);
  EXPECT_EQ(has(page, "No row of this run can be trusted."), !known);
  if (known) EXPECT_TRUE(has(page, fmt::format("<strong><data value=\"{}\"", last->drift_axis_rad)));
  EXPECT_EQ(count(page, ", the drift cannot be trusted: "), intervals.size());
  EXPECT_EQ(has(svg(drift_figure(result)), "not reliable"), !all);
}

/// The shipped scenario or hard case, changed.
RunResult run_of(const std::string& file, const Overrides& changes = {}) {
  return run(parse_scenario(read_scenario_source(EARTHTOP_SCENARIOS "/" + file + ".json"), changes));
}

TEST(Trust, IsOneInReliableRuns) {
  expect_one_word(run_of("toy-top", {{"/motion/duration_s", "2"}}));
  const RunResult tippe = run_of("tippe-top");
  EXPECT_EQ(tippe.verdict.verdict, Verdict::reliable) << tippe.verdict.reason;
  EXPECT_TRUE(is_all_reliable(tippe));
  expect_one_word(tippe);
}

TEST(Trust, IsOneWhereDisturbancesGrow) {
  for (const char* name : {"dzhanibekov", "sleeping-top-below-critical", "hard/h11-chaotic"}) {
    SCOPED_TRACE(name);
    const RunResult result = run_of(name, {{"/report/threshold_rad", "1"}});
    EXPECT_TRUE(result.verdict.verdict == Verdict::unstable || result.verdict.verdict == Verdict::chaotic);
    EXPECT_EQ(result.verdict.from_s.has_value(), name != std::string_view("sleeping-top-below-critical"));
    expect_one_word(result);
  }
}

/// The scenario of a top that stands upright at a multiple of its critical spin, and may be braked.
Scenario upright_top(double share_of_critical_spin, double viscous_N_m_s) {
  constexpr double kI1 = 5e-4, kI3 = 8e-4, kMgl = 5 * 9.80665 * 0.004;
  Scenario s = testing::toy_top();
  s.body.mass_kg = 5;
  s.body.center_of_mass_m = {0, 0, 0.004};
  testing::set_principal(s.body, kI1, kI1, kI3);
  s.release.tilt_deg = 0;
  s.release.spin_rad_s = share_of_critical_spin * 2 * std::sqrt(kI1 * kMgl) / kI3;
  s.effects.applied.viscous_N_m_s = viscous_N_m_s;
  s.duration_s = 2.5;
  s.output_step_s = 0.1;
  s.threshold_rad = 1e-4;
  return s;
}

TEST(Trust, IsOneAtTheCriticalSpin) {
  const RunResult marginal = run(upright_top(1, 0));
  EXPECT_EQ(marginal.verdict.verdict, Verdict::marginal);
  EXPECT_EQ(marginal.drift.threshold_crossing, ThresholdCrossing::uncertain);
  expect_one_word(marginal);
  const RunResult braked = run(upright_top(1.5, 2e-4));
  EXPECT_EQ(braked.verdict.verdict, Verdict::unstable);
  expect_one_word(braked);
}

TEST(Trust, IsOneBelowTheNoise) {
  const RunResult noise =
      run_of("toy-top", {{"/motion/duration_s", "2"},
                         {"/motion/output_step_s", "0.05"},
                         {"/numerics", R"({"method": "dopri5", "model": "general", "relative_tolerance": 0.1})"}});
  EXPECT_EQ(noise.verdict.verdict, Verdict::noise_floor) << noise.verdict.reason;
  expect_one_word(noise);
}

TEST(Trust, IsOneBetweenTheStopsOfTheMotions) {
  Scenario s = testing::stopping_top(90, 0, 0.5);
  s.duration_s = 2.2;
  for (const bool both : {true, false}) {
    SCOPED_TRACE(both);
    if (!both) {
      // To a moment between the two stops.
      const RunResult whole = run(s);
      ASSERT_EQ(whole.stops.size(), 2U);
      s.duration_s = (whole.stops[0].t_s + whole.stops[1].t_s) / 2;
      s.output_step_s = s.duration_s / 1000;
    }
    const RunResult result = run(s);
    ASSERT_EQ(result.stops.size(), both ? 2U : 1U);
    ASSERT_EQ(result.verdict.intervals.size(), 1U);
    EXPECT_EQ(result.verdict.intervals[0].why, Doubt::one_at_rest);
    EXPECT_EQ(result.verdict.intervals[0].from_s, result.stops[0].t_s);
    EXPECT_FALSE(is_all_reliable(result));
    EXPECT_EQ(result.rows.back().drift_reliable, both);
    EXPECT_FALSE(result.verdict.from_s);
    expect_one_word(result);
  }
}

TEST(Trust, IsOneOnATable) {
  const RunResult stops = run_of("hard/k12-toy-top-stops", {{"/earth/rotation_rate_rad_s", "0.01"}});
  expect_one_word(stops);
  const RunResult slips = run_of("hard/k18-slip-starts");
  EXPECT_EQ(slips.verdict.verdict, Verdict::marginal);
  expect_one_word(slips);
}

// A release that differs from the upright one by 1e-6 degrees: rounding grows with it while the top turns over, and dies out.
TEST(Trust, ComesBackWhereGrowthDies) {
  const RunResult result =
      run_of("tippe-top", {{"/release/tilt_deg", "1e-6"},
                           {"/contact", R"({"tip_radius_m": 0.015, "law": "viscous_load", "sliding_viscosity_s_m": 1})"},
                           {"/motion", R"({"duration_s": 20, "output_step_s": 0.1})"}});
  EXPECT_EQ(result.verdict.verdict, Verdict::unstable) << result.verdict.reason;
  ASSERT_TRUE(result.verdict.from_s && result.verdict.until_s);
  EXPECT_LT(*result.verdict.from_s, *result.verdict.until_s);
  ASSERT_EQ(result.verdict.intervals.size(), 1U);
  EXPECT_EQ(result.verdict.intervals[0].why, Doubt::rounding_grown);
  EXPECT_EQ(result.verdict.round_off_grown_s, result.verdict.from_s);
  EXPECT_TRUE(result.rows.back().drift_reliable);
  EXPECT_FALSE(is_all_reliable(result));
  expect_one_word(result);
}

TEST(Trust, IsNoneInRunsThatWereNotJudged) {
  RunResult result = run_of("toy-top", {{"/motion/duration_s", "2"}});
  result.status = RunStatus::interrupted;
  result.verdict = not_judged("interrupted before the verdict was computed");
  mark_rows(result);
  EXPECT_EQ(last_reliable_row(result), nullptr);
  expect_one_word(result);
}

TEST(SummaryText, AnUnknownBoundAndSwingsWithinTheirErrorAreSaidSo) {
  EXPECT_EQ(tool::with_bound(1.5e-3, std::numeric_limits<double>::quiet_NaN(), "rad"), "1.500000e-03 rad, bound not known");
  RunResult result = test::made_up_run(2);
  result.drift.secular.emplace();
  result.drift.secular->azimuth_rate_rad_s = 1e-5;
  result.drift.secular->azimuth_oscillation_rad = 1e-17;
  result.drift.secular->azimuth_oscillation_bound_rad = 2e-16;
  const auto text = [&] { return tool::summary_text(result, {"nowhere", ""}, false, {200, false}); };
  EXPECT_NE(text().find("none beyond the error of 2.0e-16 rad"), std::string::npos) << text();
  result.drift.secular->azimuth_oscillation_rad = 1e-3;
  EXPECT_EQ(text().find("none beyond the error of"), std::string::npos) << text();
}

}  // namespace
}  // namespace earthtop
