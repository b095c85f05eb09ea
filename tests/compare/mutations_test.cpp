// SPDX-License-Identifier: GPL-3.0-or-later
/// Changes single things in a result; each change must get the right verdict.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "compare/results_copy.hpp"
#include "support/json.hpp"
#include "support/tolerances.hpp"

namespace earthtop {
namespace {

using namespace testing;  // of earthtop: results_copy.hpp

/// The message with which an input is refused; empty if it is not.
std::string refusal_of(const fs::path& candidate, const CompareOptions& options = {}) {
  try {
    compared(candidate, options);
  } catch (const ScenarioError& error) {
    return error.what();
  }
  return "";
}

TEST(Mutation, NothingChangedIsTheSameInEveryProfile) {
  const ChangedCopy copy;
  for (const Profile profile : {Profile::bitwise, Profile::regression, Profile::physics}) {
    const PairReport pair = compared(copy.path(), with_profile(profile));
    EXPECT_TRUE(pair.passed()) << to_string(profile);
    EXPECT_EQ(pair.rows, 61u);
    for (const QuantityVerdict& verdict : pair.quantities) {
      EXPECT_EQ(verdict.change, Change::none) << verdict.name;
      EXPECT_EQ(verdict.largest, 0) << verdict.name;
    }
  }
}

TEST(Mutation, ARowMissingIsRefusedWhereTheSummaryKnowsOfIt) {
  const ChangedCopy copy([](Csv& csv) { csv.rows.erase(csv.rows.begin() + kSome); });
  const std::string refusal = refusal_of(copy.path());
  EXPECT_NE(refusal.find("has 60 rows where its summary states 61"), refusal.npos) << refusal;
  EXPECT_NE(refusal.find("gap after t = 2.9 s"), refusal.npos) << refusal;
}

TEST(Mutation, ARowMissingInATableByItselfIsADifference) {
  const ChangedCopy copy([](Csv& csv) { csv.rows.erase(csv.rows.begin() + kSome); });
  const auto compare_tables = [&](const CompareOptions& options) {
    return compare_results(ShortRun::get().path() / "trajectory.csv", copy.path() / "trajectory.csv", options).pairs.at(0);
  };
  const PairReport pair = compare_tables({});
  EXPECT_FALSE(pair.passed());
  ASSERT_TRUE(has_finding(pair, "missing rows"));
  EXPECT_NE(pair.findings[0].text.find("t = 3 s"), std::string::npos) << pair.findings[0].text;
  CompareOptions allowed;
  allowed.may_lack_rows = true;
  EXPECT_TRUE(compare_tables(allowed).passed());
}

TEST(Mutation, AQuaternionOfTheOtherSignIsTheSameAttitude) {
  const ChangedCopy copy([](Csv& csv) {
    for (const char* column : {"q_LB_w", "q_LB_x", "q_LB_y", "q_LB_z"}) csv.set(kSome, column, -csv.get(kSome, column));
  });
  const PairReport pair = compared(copy.path());
  EXPECT_TRUE(pair.passed());
  EXPECT_LT(quantity(pair, "attitude_rad").largest, 1e-15);
  EXPECT_TRUE(mentions(pair.notes, "1 quaternions have the opposite sign"));
}

/// Turns the results into those of a simulator with axes North, East, Down: R_NE = [0 1 0; 1 0 0; 0 0 -1].
void turn_to_ned(Csv& csv) {
  const double s = std::numbers::sqrt2 / 2;
  for (std::size_t i = 0; i < csv.rows.size(); ++i)
    for (const std::string motion : {"", "ref_"}) {
      const double east = csv.get(i, motion + "axis_L_x"), north = csv.get(i, motion + "axis_L_y");
      csv.set(i, motion + "axis_L_x", north);
      csv.set(i, motion + "axis_L_y", east);
      csv.set(i, motion + "axis_L_z", -csv.get(i, motion + "axis_L_z"));
      const double w = csv.get(i, motion + "q_LB_w"), x = csv.get(i, motion + "q_LB_x"), y = csv.get(i, motion + "q_LB_y"),
                   z = csv.get(i, motion + "q_LB_z");
      csv.set(i, motion + "q_LB_w", -s * (x + y));
      csv.set(i, motion + "q_LB_x", s * (w + z));
      csv.set(i, motion + "q_LB_y", s * (w - z));
      csv.set(i, motion + "q_LB_z", s * (y - x));
    }
}

TEST(Mutation, NorthEastDownDiffersAndIsRecognised) {
  const ChangedCopy copy(turn_to_ned);
  const PairReport pair = compared(copy.path());
  EXPECT_FALSE(pair.passed());
  EXPECT_FALSE(quantity(pair, "attitude_rad").passed);
  EXPECT_FALSE(quantity(pair, "axis_rad").passed);
  EXPECT_TRUE(mentions(pair.hints, "the new result agrees to"));
  EXPECT_TRUE(mentions(pair.hints, "North, East, Down"));
}

TEST(Mutation, NotANumberDiffersWhereverItStands) {
  for (const std::string column : {"q_LB_x", "axis_L_z", "drift_axis_rad", "drift_azimuth_rad", "drift_reliable", "t_s"})
    for (const std::string text : {"nan", "inf", "-NaN", "1e999"}) {
      const ChangedCopy copy([&](Csv& csv) { csv.rows[kSome][csv.column(column)] = text; });
      const PairReport pair = compared(copy.path());
      EXPECT_FALSE(pair.passed()) << column << " " << text;
      if (column == "drift_axis_rad") {
        EXPECT_EQ(quantity(pair, column).first_violation_s, 3.0);
        EXPECT_NE(quantity(pair, column).reason.find("not a finite number in the new rows at t = 3 s"), std::string::npos);
      }
    }
}

TEST(Mutation, NotANumberInBothIsStillNone) {
  const ChangedCopy copy([](Csv& csv) { csv.rows[kSome][csv.column("drift_axis_rad")] = "nan"; });
  EXPECT_FALSE(compare_results(copy.path(), copy.path(), {}).passed());
}

TEST(Mutation, AnEmptyCellDiffers) {
  const ChangedCopy copy([](Csv& csv) { csv.rows[kSome][csv.column("drift_azimuth_rad")].clear(); });
  EXPECT_FALSE(compared(copy.path()).passed());
}

// In each column one number is changed by 1e-9 of its unit; the columns of bounds are judged only by their order of magnitude.
TEST(Mutation, OneDigitAt1eMinus9IsFoundInEveryColumn) {
  const Csv original(ShortRun::get().path() / "trajectory.csv");
  for (const std::string& column : original.header) {
    if (column == "t_s" || column == "drift_reliable") continue;
    const ChangedCopy copy([&](Csv& csv) { csv.set(kSome, column, csv.get(kSome, column) + 1e-9); });
    const PairReport pair = compared(copy.path());
    EXPECT_FALSE(pair.passed()) << column;
    for (const QuantityVerdict& verdict : pair.quantities)
      if (!verdict.passed) {
        EXPECT_EQ(verdict.first_violation_s, 3.0) << verdict.name;
      }
  }
}

// The length of an axis or quaternion may not change, although no angle would show it.
TEST(Mutation, ALengthThatIsNotOneIsFound) {
  for (const std::vector<std::string>& columns : {std::vector<std::string>{"axis_L_x", "axis_L_y", "axis_L_z"},
                                                  std::vector<std::string>{"q_LB_w", "q_LB_x", "q_LB_y", "q_LB_z"}}) {
    const ChangedCopy copy([&](Csv& csv) {
      for (const std::string& column : columns) csv.set(kSome, column, csv.get(kSome, column) * (1 + 1e-9));
    });
    EXPECT_FALSE(compared(copy.path()).passed()) << columns.front();
  }
}

TEST(Mutation, ANinthDigitOfTheDriftIsFound) {
  const ChangedCopy copy([](Csv& csv) { csv.set(kSome, "drift_axis_rad", csv.get(kSome, "drift_axis_rad") * (1 + 1e-9)); });
  const PairReport pair = compared(copy.path());
  const QuantityVerdict& drift = quantity(pair, "drift_axis_rad");
  EXPECT_FALSE(drift.passed);
  EXPECT_EQ(drift.violations, 1u);
  EXPECT_NEAR(drift.largest / (1e-9 * Csv(copy.path() / "trajectory.csv").get(kSome, "drift_axis_rad")), 1,
              testing::rounding(4) / 1e-9);  // of both numbers
  EXPECT_EQ(drift.where, "t = 3 s");
  EXPECT_NEAR(drift.share, drift.largest / drift.tolerance, 1e-9 * drift.share);
}

TEST(Mutation, ANinthDigitOfTheSummaryIsFound) {
  const ChangedCopy copy;
  auto summary = testing::parse_ordered_json(read_text(copy.path() / "summary.json"));
  double& final_rad = summary["/drift/axis_final_rad"_json_pointer].get_ref<double&>();
  final_rad *= 1 + 1e-9;
  write_text(copy.path() / "summary.json", testing::text_of(summary));
  const PairReport pair = compared(copy.path());
  EXPECT_FALSE(pair.passed());
  EXPECT_FALSE(quantity(pair, "drift.axis_final_rad").passed);
}

TEST(Mutation, TheLastBitIsFoundBitwise) {
  const ChangedCopy copy([](Csv& csv) { csv.set(kSome, "axis_L_x", std::nextafter(csv.get(kSome, "axis_L_x"), 2)); });
  EXPECT_TRUE(compared(copy.path()).passed());
  EXPECT_FALSE(compared(copy.path(), with_profile(Profile::bitwise)).passed());
}

TEST(Mutation, ADigitThatNoDoubleHoldsIsFoundBitwise) {
  const TemporaryDirectory dir;
  const std::string header = "t_s,drift_axis_rad\n0,0\n1,";
  const auto compare_in = [&](Profile profile) {
    return compare_results(dir.path() / "a.csv", dir.path() / "b.csv", with_profile(profile)).passed();
  };
  // 34 digits of float128, and 21 of long double in a text no longer than one of a double may be.
  for (const std::string digits : {"0.123456789012345678901234567890123", "1.14022802861751123"}) {
    const std::string exponent = digits.size() < 20 ? "e-3" : "";
    write_text(dir.path() / "a.csv", header + digits + "14" + exponent + "\n");
    write_text(dir.path() / "b.csv", header + digits + "15" + exponent + "\n");
    EXPECT_FALSE(compare_in(Profile::bitwise)) << digits;
    EXPECT_TRUE(compare_in(Profile::regression)) << digits;
  }
}

TEST(Mutation, StatesOneSampleLateDifferAndAreRecognised) {
  const ChangedCopy copy([](Csv& csv) {
    for (std::size_t i = csv.rows.size() - 1; i > 0; --i)
      std::copy(csv.rows[i - 1].begin() + 1, csv.rows[i - 1].end(), csv.rows[i].begin() + 1);
  });
  const PairReport pair = compared(copy.path());
  EXPECT_FALSE(pair.passed());
  EXPECT_TRUE(mentions(pair.hints, "shifted by a sample"));
}

TEST(Mutation, TimesOneSampleLateDifferAndAreRecognised) {
  const ChangedCopy copy([](Csv& csv) {
    for (std::size_t i = 0; i < csv.rows.size(); ++i) csv.set(i, "t_s", 0.1 * static_cast<double>(i + 1));
  });
  const PairReport pair = compared(copy.path());
  EXPECT_FALSE(pair.passed());
  EXPECT_TRUE(has_finding(pair, "missing rows"));
  EXPECT_TRUE(mentions(pair.hints, "shifted by a sample"));
}

TEST(Mutation, TimesHalfASampleLateAreNoTimesOfTheScenario) {
  const ChangedCopy copy([](Csv& csv) {
    for (std::size_t i = 0; i < csv.rows.size(); ++i) csv.set(i, "t_s", 0.1 * (static_cast<double>(i) + 0.5));
  });
  EXPECT_TRUE(has_finding(compared(copy.path()), "other times"));
}

TEST(Mutation, DegreesForRadiansDifferAndAreRecognised) {
  const ChangedCopy copy([](Csv& csv) {
    for (std::size_t i = 0; i < csv.rows.size(); ++i)
      for (const char* column : {"drift_axis_rad", "drift_azimuth_rad"})
        csv.set(i, column, csv.get(i, column) * 180 / std::numbers::pi);
  });
  const PairReport pair = compared(copy.path());
  EXPECT_FALSE(pair.passed());
  EXPECT_TRUE(
      mentions(pair.hints, "drift_axis_rad: new values are 57.2958 times the reference's, as with degrees instead of radians"));
}

TEST(Mutation, AColumnOfAnotherUnitIsNotTakenForTheFirst) {
  const ChangedCopy copy([](Csv& csv) { csv.header[csv.column("drift_axis_rad")] = "drift_axis_deg"; });
  const PairReport pair = compared(copy.path());
  ASSERT_TRUE(has_finding(pair, "missing column"));
  EXPECT_NE(pair.findings[0].text.find("drift_axis_deg"), std::string::npos);
}

TEST(Mutation, AMissingColumnDiffers) {
  const ChangedCopy copy([](Csv& csv) {
    const auto at = static_cast<std::ptrdiff_t>(csv.column("drift_tilt_rad"));
    csv.header.erase(csv.header.begin() + at);
    for (auto& row : csv.rows) row.erase(row.begin() + at);
  });
  EXPECT_TRUE(has_finding(compared(copy.path()), "missing column"));
}

TEST(Mutation, ATruncatedFileIsRefused) {
  const ChangedCopy in_a_line, between_lines;
  const std::string text = read_text(in_a_line.path() / "trajectory.csv");
  write_text(in_a_line.path() / "trajectory.csv", text.substr(0, text.size() / 2));
  EXPECT_NE(refusal_of(in_a_line.path()).find("the last line is incomplete"), std::string::npos);
  write_text(between_lines.path() / "trajectory.csv", text.substr(0, text.find('\n', text.size() / 2) + 1));
  EXPECT_NE(refusal_of(between_lines.path()).find("where its summary states 61"), std::string::npos);
}

TEST(Mutation, AnEmptyFileIsRefused) {
  for (const char* file : {"trajectory.csv", "summary.json"}) {
    const ChangedCopy copy;
    write_text(copy.path() / file, "");
    EXPECT_NE(refusal_of(copy.path()).find("is empty"), std::string::npos) << file;
  }
  const ChangedCopy header_only([](Csv& csv) { csv.rows.clear(); });
  EXPECT_NE(refusal_of(header_only.path()).find("has no rows"), std::string::npos);
}

TEST(Mutation, WhatIsNoNumberIsRefusedWithItsPlace) {
  const ChangedCopy copy([](Csv& csv) { csv.rows[kSome][csv.column("q_LB_w")] = "0.5x"; });
  const std::string refusal = refusal_of(copy.path());
  EXPECT_NE(refusal.find("trajectory.csv:32:3: error: column q_LB_w: \"0.5x\" is not a number"), refusal.npos) << refusal;
}

TEST(Mutation, RowsOutOfOrderAreRefused) {
  const ChangedCopy copy([](Csv& csv) { std::swap(csv.rows[kSome], csv.rows[kSome + 1]); });
  EXPECT_NE(refusal_of(copy.path()).find("is not later than"), std::string::npos);
}

using SummaryChange = std::function<void(nlohmann::ordered_json&)>;

void change_summary(const ChangedCopy& copy, const SummaryChange& change) {
  auto summary = testing::parse_ordered_json(read_text(copy.path() / "summary.json"));
  change(summary);
  write_text(copy.path() / "summary.json", testing::text_of(summary));
}

// Neither the reference's summary nor the candidate's may decide, by what it says about itself, how much of it is compared.
TEST(Mutation, ASummaryCannotTalkItsWayThrough) {
  const SummaryChange changes[] = {
      [](auto& s) { s["attitude_bound_rad"] = 1e3; },
      [](auto& s) { s["drift"]["axis_bound_rad"] = 1e-30; },
      [](auto& s) { s["drift"]["axis_bound_rad"] = -1; },
      [](auto& s) { s["drift"]["axis_final_rad"] = nullptr; },
      [](auto& s) { s["drift"]["azimuth_final_rad"] = 1e300; },
      [](auto& s) { s["drift"]["verdict"] = "chaotic"; },
      [](auto& s) { s["drift"].erase("tilt_max_rad"); },
      [](auto& s) { s["outcome"]["status"] = "step_underflow"; },
      [](auto& s) { s["scenario"]["site"]["latitude_deg"] = 12; },
      [](auto& s) { s["scenario"] = "x"; },
      [](auto& s) { s["provenance"].erase("scenario_sha256"); },
      [](auto& s) { s["invariants"][0]["scale"] = "x"; },
      [](auto& s) { s["outcome"]["rows"] = 61.5; },
  };
  for (std::size_t i = 0; i < std::size(changes); ++i) {
    const ChangedCopy copy;
    change_summary(copy, changes[i]);
    const auto passes = [](const fs::path& a, const fs::path& b) {
      try {
        return compare_results(a, b, {}).passed();
      } catch (const ScenarioError&) {
        return false;
      }
    };
    EXPECT_FALSE(passes(ShortRun::get().path(), copy.path())) << i;
    EXPECT_FALSE(passes(copy.path(), ShortRun::get().path())) << i;
  }
}

// However large the stated bounds are, a body at rest is not accepted as the top's motion.
TEST(Mutation, InflatedBoundsDoNotHideTheMotion) {
  const ChangedCopy copy;
  change_summary(copy, [](auto& s) {
    s["attitude_bound_rad"] = 1e3;
    s["scenario"]["numerics"]["method"] = "rkf78";
    s["provenance"]["scenario_sha256"] = "another";
  });
  Csv csv(copy.path() / "trajectory.csv");
  for (std::size_t i = 2; i < csv.rows.size(); ++i)
    for (const char* column : {"q_LB_w", "q_LB_x", "q_LB_y", "q_LB_z", "axis_L_x", "axis_L_y", "axis_L_z"})
      csv.set(i, column, csv.get(1, column));
  write_text(copy.path() / "trajectory.csv", csv.text());
  for (const Profile profile : {Profile::regression, Profile::physics}) {
    CompareOptions options = with_profile(profile);
    options.may_change = {"/numerics"};
    const PairReport pair = compared(copy.path(), options);
    EXPECT_FALSE(quantity(pair, "attitude_rad").passed) << to_string(profile);
    EXPECT_FALSE(quantity(pair, "axis_rad").passed) << to_string(profile);
  }
}

TEST(Mutation, AnAbsurdCellOfTheReferenceHidesNothing) {
  for (const char* column : {"drift_axis_rad", "w_LB_B_x_rad_s", "drift_azimuth_rad", "drift_axis_bound_rad"})
    for (const double absurd : {1e200, 1e308, -1e200}) {
      const ChangedCopy reference([&](Csv& csv) { csv.set(kSome, column, absurd); });
      const auto passes = [&] { return compare_results(reference.path(), ShortRun::get().path(), {}).passed(); };
      if (absurd < 0 && std::string(column).ends_with("bound_rad"))
        EXPECT_THROW(passes(), ScenarioError) << "a bound below 0";
      else
        EXPECT_FALSE(passes()) << column << absurd;
    }
}

TEST(Mutation, AColumnThatTheReferenceLacksDiffers) {
  const ChangedCopy reference([](Csv& csv) { csv.header[csv.column("q_LB_z")] = "q_z"; });
  EXPECT_TRUE(has_finding(compare_results(reference.path(), ShortRun::get().path(), {}).pairs.at(0), "missing column"));
}

TEST(Mutation, ATimeOfTheReferenceThatIsNoNumberDiffers) {
  for (const std::size_t row : {std::size_t{0}, kSome, std::size_t{60}}) {
    const ChangedCopy reference([&](Csv& csv) { csv.rows[row][0] = "nan"; });
    EXPECT_TRUE(has_finding(compare_results(reference.path(), ShortRun::get().path(), {}).pairs.at(0), "not finite")) << row;
  }
}

TEST(Mutation, EveryLastBitIsFoundBitwise) {
  const Csv original(ShortRun::get().path() / "trajectory.csv");
  for (const std::string& column : original.header) {
    if (column == "t_s" || column == "drift_reliable") continue;
    for (std::size_t row = 7; row < 60; row += 13) {
      const ChangedCopy copy([&](Csv& csv) { csv.set(row, column, std::nextafter(csv.get(row, column), 1e9)); });
      EXPECT_FALSE(compared(copy.path(), with_profile(Profile::bitwise)).passed()) << column << row;
    }
  }
}

TEST(Mutation, ACompactReferenceWithPartsRemovedIsRefused) {
  const TemporaryDirectory dir;
  const fs::path file = dir.path() / "toy.json";
  update_reference(file, ShortRun::get().path(), "for a test");
  const auto whole = testing::parse_ordered_json(read_text(file));
  const SummaryChange changes[] = {
      [](auto& r) { r["summary"] = nullptr; },
      [](auto& r) { r["summary"].erase("drift"); },
      [](auto& r) { r["summary"]["provenance"].erase("scenario_sha256"); },
      [](auto& r) { r["rows"].erase(3); },
      [](auto& r) { r["columns"][2] = r["columns"][1]; },
      [](auto& r) { r["columns"][0] = "time"; },
      [](auto& r) {
        r["columns"] = {{"a", 1}};
      },
      [](auto& r) { r["rows"][2].erase(0); },
  };
  for (const SummaryChange& change : changes) {
    auto changed = whole;
    change(changed);
    write_text(file, testing::text_of(changed));
    EXPECT_THROW(compare_results(file, ShortRun::get().path(), {}), ScenarioError);
  }
}

}  // namespace
}  // namespace earthtop
