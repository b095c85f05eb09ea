// SPDX-License-Identifier: GPL-3.0-or-later
// The bounds of runs on a table, over a few random scenes; earthtop-bound-coverage --on-table makes the complete tables.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bounds/table_checks.hpp"
#include "bounds/table_strata.hpp"
#include "support/contact_references.hpp"
#include "support/json.hpp"

namespace earthtop::testing {
namespace {

double median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
  return values.at(values.size() / 2);
}

/// Against drifts in 113 bits, in the equations of the other observer. A bound that leaves out the tip or the round-off fails, and
/// so does one that is safe because it is useless.
TEST(TableBounds, HoldOverScenesOfEveryLawAndAreClose) {
  const nlohmann::json data = parse_json(read_file(EARTHTOP_TESTS "/data/contact/bounds.json"));
  int scenes = 0, reliable = 0;
  std::vector<double> axis_ratios, tip_ratios;
  for (const nlohmann::json& known : data["scenes"]) {
    const Scenario scenario = parse_scenario({"bounds.json", known["scenario"].dump(), false});
    SCOPED_TRACE(scenario.name);
    const RunResult result = run(scenario);
    ASSERT_EQ(result.status, RunStatus::completed);
    ++scenes, reliable += result.verdict.verdict == Verdict::reliable;
    ASSERT_LE(result.rows.size(), known["rows"].size());
    double axis_error = 0, axis_bound = 0, tip_error = 0, tip_bound = 0;
    for (std::size_t i = 1; i < result.rows.size(); ++i) {
      const DriftRow& row = result.rows[i];
      if (!row.drift_reliable) continue;
      const auto value = [&](std::size_t k) { return parsed<float128>(known["rows"][i][k].get<std::string>()); };
      const auto apart = [](double found, float128 exact) { return static_cast<double>(float128(found) - exact); };
      const double axis = std::abs(apart(row.drift_axis_rad, value(0)));
      const double tip =
          std::hypot(apart(row.contact->drift_tip_xy_m[0], value(2)), apart(row.contact->drift_tip_xy_m[1], value(3)));
      EXPECT_LE(axis, row.drift_axis_bound_rad) << row.t_s;
      EXPECT_LE(std::abs(apart(row.drift_attitude_rad, value(1))), row.drift_attitude_bound_rad) << row.t_s;
      EXPECT_LE(tip, row.contact->drift_tip_bound_m) << row.t_s;
      axis_error = std::max(axis_error, axis), axis_bound = row.drift_axis_bound_rad;
      tip_error = std::max(tip_error, tip), tip_bound = row.contact->drift_tip_bound_m;
    }
    if (axis_error > 0) axis_ratios.push_back(axis_bound / axis_error);
    if (tip_error > 0) tip_ratios.push_back(tip_bound / tip_error);
  }
  EXPECT_GE(scenes, 10);
  EXPECT_GE(reliable, 0.8 * scenes);
  // The median over some 200 scenes is 65; over so few it scatters.
  EXPECT_LE(median(axis_ratios), 200);
  EXPECT_LE(median(tip_ratios), 200);
}

TEST(TableBounds, LaboratoryAndInertialEquationsAgreeToTheBound) {
  int rows = 0;
  for (const Stratum& stratum : table_strata()) {
    const Scenario scenario = random_scene_on_table(stratum, 2000, 2, 200);
    SCOPED_TRACE(scenario.name);
    const Agreement found = agreement(scenario);
    EXPECT_LE(found.largest(), 1);
    rows += found.rows;
  }
  EXPECT_GE(rows, 50);
}

}  // namespace
}  // namespace earthtop::testing
