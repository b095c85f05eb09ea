// SPDX-License-Identifier: GPL-3.0-or-later
// The sentence on top of a study's page, for documents whose numbers are simple enough to be read off.
#include "report/study_finding.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace earthtop::report {
namespace {

constexpr double kArcsecond = 4.84813681109536e-06;  // rad

/// A study with one axis of latitudes and the drift of the axis at each, in arcseconds.
Json over_latitude(const std::vector<double>& latitudes, const std::vector<double>& drifts) {
  Json study = {
      {"design", {{"kind", "grid"}}},
      {"points_planned", latitudes.size()},
      {"points_computed", latitudes.size()},
      {"points_failed", 0U},
      {"axes", Json::array({{{"name", "latitude_deg"}, {"pointers", {"/site/latitude_deg"}}, {"values", latitudes}}})},
      {"quantities", Json::array({{{"name", "drift.axis_final_rad"}, {"path", "drift.axis_final_rad"}}})}};
  Json rows = Json::array(), points = Json::array();
  double least = drifts[0], most = drifts[0];
  for (std::size_t i = 0; i < drifts.size(); ++i) {
    rows.push_back(
        {{"value", Json(latitudes[i]).dump()}, {"drift.axis_final_rad", {{"count", 1}, {"mean", drifts[i] * kArcsecond}}}});
    points.push_back({{"point", i},
                      {"latitude_deg", latitudes[i]},
                      {"drift.axis_final_rad", drifts[i] * kArcsecond},
                      {"status", "completed"}});
    least = std::min(least, drifts[i]), most = std::max(most, drifts[i]);
  }
  study["marginals"] = {{"latitude_deg", rows}};
  study["points"] = points;
  study["statistics"] = {
      {"drift.axis_final_rad", {{"count", drifts.size()}, {"min", least * kArcsecond}, {"max", most * kArcsecond}}}};
  return study;
}

TEST(StudyFinding, SaysFromWhatToWhat) {
  EXPECT_EQ(study_finding(over_latitude({10, 40, 80}, {320, 100, 40})),
            "With the latitude, the drift of the axis at the end falls from 320″ at 10° to 40″ at 80°");
  EXPECT_EQ(study_finding(over_latitude({-80, 10}, {2, 320})),
            "With the latitude, the drift of the axis at the end rises from 2″ at −80° to 320″ at 10°");
}

TEST(StudyFinding, NamesTheExtremesOfWhatTurnsBack) {
  EXPECT_EQ(study_finding(over_latitude({10, 40, 80}, {320, 400, 50})),
            "With the latitude, the drift of the axis at the end is least, 50″, at 80° and largest, 400″, at 40°");
}

TEST(StudyFinding, SaysWhereNothingChanges) {
  EXPECT_EQ(study_finding(over_latitude({10, 40}, {320, 320})),
            "The drift of the axis at the end is 320″ at all 2 points that have it");
  Json within = over_latitude({10, 40}, {320, 320.001});
  within["quantities"].push_back({{"name", "bound"}, {"path", "drift.axis_bound_rad"}});
  within["statistics"]["bound"] = {{"count", 2}, {"min", 0}, {"max", 0.01 * kArcsecond}};
  EXPECT_EQ(study_finding(within), "The drift of the axis at the end is 320″ at all 2 points, as far as its error bound tells");
  EXPECT_NE(study_certainty(within).find("the error is at most 10 milliarcsec"), std::string::npos) << study_certainty(within);
}

TEST(StudyFinding, TellsCloseNumbersApart) {
  EXPECT_EQ(study_finding(over_latitude({10, 40}, {320.0001, 320.0002})),
            "With the latitude, the drift of the axis at the end rises from 320.0001″ at 10° to 320.0002″ at 40°");
}

TEST(StudyFinding, HasWordsForSettingsThatAreNoNumbers) {
  Json study = over_latitude({10, 40}, {320, 100});
  study["axes"][0] = {{"name", "frame"}, {"pointers", {"/release/rates_relative_to"}}, {"values", {"laboratory", "inertial"}}};
  study["marginals"] = {{"frame", study["marginals"]["latitude_deg"]}};
  study["marginals"]["frame"][0]["value"] = "laboratory";
  study["marginals"]["frame"][1]["value"] = "inertial";
  EXPECT_EQ(study_finding(study),
            "With the frame, the drift of the axis at the end is least, 100″, at inertial and largest, 320″, at laboratory");
}

TEST(StudyFinding, CountsWhatFailed) {
  Json study = over_latitude({10, 40, 80}, {320, 100, 40});
  study["points_failed"] = 1U, study["points_computed"] = 4U, study["points_planned"] = 6U;
  EXPECT_EQ(study_certainty(study), "4 of 6 points are computed so far; 1 of them failed and is left out.");
  study["points_computed"] = 1U;
  EXPECT_EQ(study_finding(study), "The only point failed: there is nothing to tell");
  study["points_computed"] = 0U, study["points_failed"] = 0U;
  EXPECT_EQ(study_finding(study), "No point of this study has been computed yet");
  study["points_computed"] = 3U;
  study["statistics"] = Json::object();
  EXPECT_EQ(study_finding(study), "No point has a number of what this study collects");
}

TEST(StudyFinding, CountsReliablePoints) {
  Json study = over_latitude({10, 40, 80}, {320, 100, 40});
  study["quantities"].push_back({{"name", "drift.verdict"}, {"path", "drift.verdict"}});
  for (Json& point : study["points"]) point["drift.verdict"] = "reliable";
  EXPECT_EQ(study_certainty(study), "All 3 points are computed; the drift is reliable at all of them.");
  study["points"][1]["drift.verdict"] = "marginal";
  EXPECT_EQ(study_certainty(study), "All 3 points are computed; the drift is reliable at 2 of 3.");
}

/// The latitude moves the mean by 200, the other setting by 4.
TEST(StudyFinding, ChoosesTheSettingThatMovesMost) {
  Json study = over_latitude({10, 40}, {100, 300});
  study["axes"].push_back({{"name", "spin_rad_s"}, {"pointers", {"/release/spin_rad_s"}}, {"values", {100, 200}}});
  study["marginals"]["spin_rad_s"] =
      Json::array({{{"value", "100"}, {"drift.axis_final_rad", {{"count", 2}, {"mean", 198 * kArcsecond}}}},
                   {{"value", "200"}, {"drift.axis_final_rad", {{"count", 2}, {"mean", 202 * kArcsecond}}}}});
  EXPECT_EQ(
      study_finding(study),
      "The drift of the axis at the end depends most on the latitude: on average over the other settings it rises from 100″ at "
      "10° to 300″ at 40°");
}

TEST(StudyFinding, ComparesSettingsChangedOneAtATime) {
  Json study = over_latitude({10, 40}, {100, 300});
  study["design"]["kind"] = "one_at_a_time";
  study["axes"].push_back({{"name", "spin_rad_s"}, {"pointers", {"/release/spin_rad_s"}}, {"values", {202}}});
  const auto point = [](Json latitude, Json spin, double drift) {
    return Json{
        {"latitude_deg", std::move(latitude)}, {"spin_rad_s", std::move(spin)}, {"drift.axis_final_rad", drift * kArcsecond}};
  };
  study["points"] = Json::array({point(nullptr, nullptr, 110), point(10, nullptr, 100), point(nullptr, 202, 300)});
  EXPECT_EQ(study_finding(study),
            "Of 2 settings changed one at a time, the spin moves the drift of the axis at the end most: from 110″ to 300″, at "
            "202 rad/s");
  study["points"] = nullptr;  // more than a document lists
  EXPECT_EQ(study_finding(study),
            "With one setting changed at a time, the drift of the axis at the end lies between 100″ and 300″");
}

TEST(StudyFinding, TellsTheSpreadOfDrawnPoints) {
  Json study = over_latitude({10, 40}, {100, 300});
  study["design"]["kind"] = "sobol";
  study["axes"].push_back({{"name", "spin_rad_s"}, {"pointers", {"/release/spin_rad_s"}}});
  Json& statistics = study["statistics"]["drift.axis_final_rad"];
  statistics["quantile_05"] = 110 * kArcsecond, statistics["median"] = 200 * kArcsecond,
  statistics["quantile_95"] = 290 * kArcsecond;
  const auto index = [](double total, double error) {
    return Json{{"total_order", total}, {"total_order_standard_error", error}};
  };
  study["indices"]["drift.axis_final_rad"] = {{"latitude_deg", index(0.2, 0.02)}, {"spin_rad_s", index(0.8, 0.02)}};
  const std::string spread =
      "The drift of the axis at the end has a median of 200″, and nine tenths of it lie between 110″ and 290″; ";
  EXPECT_EQ(study_finding(study), spread + "most of that comes from the spin");
  study["indices"]["drift.axis_final_rad"] = {{"latitude_deg", index(0.2, 0.5)}, {"spin_rad_s", index(0.8, 0.5)}};
  EXPECT_EQ(study_finding(study), spread + "the points do not tell which setting that comes from");
}

}  // namespace
}  // namespace earthtop::report
