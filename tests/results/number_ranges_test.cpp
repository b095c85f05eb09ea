// SPDX-License-Identifier: GPL-3.0-or-later
// The ranges of numbers in the program's own files.
#include "results/number_ranges.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "compare/comparand.hpp"
#include "earthtop/error.hpp"
#include "earthtop/results/results.hpp"
#include "results/figures.hpp"
#include "results/made_up_run.hpp"
#include "support/json.hpp"
#include "support/temporary_directory.hpp"

namespace earthtop {
namespace {

TEST(NumberRanges, GoByTheName) {
  using enum NumberRange;
  EXPECT_EQ(range_of("p_value"), probability);
  EXPECT_EQ(range_of("least_p_value"), probability);
  EXPECT_EQ(range_of("correlation"), correlation);
  EXPECT_EQ(range_of("correlation_time_s"), not_negative);
  EXPECT_EQ(range_of("drift_axis_bound_rad"), not_negative);
  EXPECT_EQ(range_of("azimuth_rate_bound_95_rad_s"), not_negative);
  EXPECT_EQ(range_of("standard_error_scaled"), not_negative);
  EXPECT_EQ(range_of("steps_accepted"), count);
  EXPECT_EQ(range_of("rows"), count);
  EXPECT_EQ(range_of("value"), any);
  EXPECT_EQ(range_of("value", "fitted"), not_negative);
  EXPECT_EQ(range_of("axis_rad", "error"), not_negative);
  EXPECT_EQ(range_of("drift_reliable"), flag);
  for (const char* name : {"boundary", "growth", "arrows", "errors_of", "drift_tilt_rad", "residual_rad", "new"})
    EXPECT_EQ(range_of(name), name == std::string("errors_of") ? not_negative : any) << name;
}

TEST(NumberRanges, HoldWhatIsWithinAndSayWhatWouldBe) {
  using enum NumberRange;
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const NumberRange range : {any, not_negative, count, probability, correlation, flag}) {
    EXPECT_EQ(fault_of(range, 0), "");
    EXPECT_EQ(fault_of(range, 1), "");
    EXPECT_EQ(fault_of(range, kNan), "");
    if (range != any) EXPECT_NE(fault_of(range, -2), "");
  }
  EXPECT_EQ(fault_of(not_negative, -1e-300), "0 or positive");
  EXPECT_EQ(fault_of(count, 0.5), "a whole number, 0 or positive");
  EXPECT_EQ(fault_of(probability, 1.1757), "a probability, from 0 to 1");
  EXPECT_EQ(fault_of(correlation, -1), "");
  EXPECT_EQ(fault_of(correlation, 1 + 1e-15), "") << "rounding";
  EXPECT_EQ(fault_of(correlation, 1.00001), "a correlation, from -1 to 1");
  EXPECT_EQ(fault_of(flag, 2), "0 or 1");
}

std::string refusal(const char* document) {
  try {
    check_ranges(testing::parse_json(document), "plan.json");
    return "";
  } catch (const ScenarioError& error) {
    return error.what();
  }
}

TEST(NumberRanges, AreHeldEverywhereInADocument) {
  EXPECT_EQ(refusal(R"({"chi_squared": {"as_given": {"value": 3, "p_value": 0.5}}, "rows": 3, "correlation": [[1, -1]]})"), "");
  const std::string text =
      refusal(R"({"chi_squared": {"as_given": {"value": -3, "p_value": 1.1757}}, "correlation": [[1, 0.2], [3, 1]]})");
  EXPECT_NE(text.find("/chi_squared/as_given/p_value: is 1.1757, but must be a probability, from 0 to 1: the file is not as "
                      "earthtop wrote it; write it anew"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("/chi_squared/as_given/value: is -3, but must be 0 or positive"), std::string::npos) << text;
  EXPECT_NE(text.find("/correlation/1/0: is 3, but must be a correlation, from -1 to 1"), std::string::npos) << text;
  EXPECT_EQ(refusal(R"({"scenario": {"tolerance": -1}})"), "") << "a scenario is checked elsewhere";
  EXPECT_EQ(refusal(R"({"rows": [[0, 0.5], [1, -0.5]]})"), "") << "rows of a reference are held to the ranges of their columns";
}

/// Every bound and every count of the table of summary.json has a range: their names tell.
TEST(NumberRanges, AreThoseOfTheSummarysFigures) {
  for (const SummaryMember& member : summary_members()) {
    const std::size_t dot = member.path.rfind('.');
    const std::string_view name = member.path.substr(dot + 1),
                           parent = dot == member.path.npos ? "" : member.path.substr(0, dot);
    const bool is_bound = member.kind == FigureKind::error && !name.ends_with("_from_s") && !name.ends_with("_grown_s") &&
                          !name.starts_with("reached") && !name.starts_with("residual") && !name.starts_with("balance");
    const bool is_bound_by_name = name.find("bound") != name.npos;
    if (is_bound || is_bound_by_name) EXPECT_EQ(range_of(name, parent), NumberRange::not_negative) << member.path;
    if (name.starts_with("steps_") || name.ends_with("_evaluations"))
      EXPECT_EQ(range_of(name), NumberRange::count) << member.path;
  }
}

/// Rows without checksums are held to their ranges, too, whoever reads them.
TEST(NumberRanges, AreHeldInRows) {
  const testing::TemporaryDirectory temporary;
  const std::filesystem::path dir = temporary.path() / "results";
  write_results(test::made_up_run(), dir, false);
  write_file(dir / "summary.json", summary_json(test::made_up_run()));
  ResultTexts texts = read_result_texts(dir);
  std::string& rows = texts.at("trajectory.csv");
  const std::size_t header_end = rows.find('\n');
  const std::string header = rows.substr(0, header_end);
  const auto column =
      std::count(header.begin(), header.begin() + static_cast<std::ptrdiff_t>(header.find("drift_axis_bound_rad")), ',');
  std::size_t at = header_end + 1;
  for (auto i = column; i > 0; --i) at = rows.find(',', at) + 1;
  rows.insert(at, "-");
  write_file(dir / "trajectory.csv", rows);
  const auto refusal_of = [](const auto& read) {
    try {
      read();
      return std::string("accepted");
    } catch (const ScenarioError& error) {
      return std::string(error.what());
    }
  };
  const std::string of_texts = refusal_of([&] { read_result_texts(dir); });
  EXPECT_NE(of_texts.find("has a drift_axis_bound_rad of -"), std::string::npos) << of_texts;
  EXPECT_NE(of_texts.find("in line 2, which must be 0 or positive; run the scenario again"), std::string::npos) << of_texts;
  const std::string of_rows = refusal_of([&] {
    compare::Row row;
    compare::open_comparand(dir, nullptr).open_rows()->next(row);
  });
  EXPECT_NE(of_rows.find("drift_axis_bound_rad is -"), std::string::npos) << of_rows;
  EXPECT_NE(of_rows.find("but must be 0 or positive"), std::string::npos) << of_rows;
}

}  // namespace
}  // namespace earthtop
