// SPDX-License-Identifier: GPL-3.0-or-later
// What studies tell of their inputs, and which of their points they show.
#include "study/influence.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "earthtop/study/indices_note.hpp"
#include "earthtop/study/run_study.hpp"
#include "earthtop/study/selection.hpp"
#include "earthtop/study/timing.hpp"
#include "support/temporary_directory.hpp"

namespace earthtop {
namespace {

using study::IndexBasis, study::InputIndex, study::influence_sentence;
using testing::TemporaryDirectory;
namespace fs = std::filesystem;

constexpr IndexBasis kWhole{64, 64, 64, 320, 0};

/// An input without interactions: both indices are the same.
InputIndex alone(const char* name, double index, double error) { return {name, {index, error, index, error}}; }

TEST(InfluenceSentence, NamesTheInputThatDecidesAndHowManyPointsTheSecondPlaceWants) {
  // 0.05 - 0.02 is 0.03, and two errors of the difference are 0.0849: eight times as many points; with smaller errors 3.6 times.
  EXPECT_EQ(influence_sentence("drift", {alone("spin", 0.02, 0.03), alone("tilt", 0.91, 0.02), alone("latitude", 0.05, 0.03)},
                               kWhole),
            "tilt decides drift (0.91 +- 0.02 of its variance); for second place 64 base points are too few: 512 would do");
  EXPECT_EQ(influence_sentence("drift", {alone("spin", 0.02, 0.02), alone("tilt", 0.91, 0.02), alone("latitude", 0.05, 0.02)},
                               kWhole),
            "tilt decides drift (0.91 +- 0.02 of its variance); for second place 64 base points are too few: 256 would do");
}

TEST(InfluenceSentence, RoundsTheBasePointsUpToAPowerOfTwoAndBeyondTheirNumber) {
  const auto second = [](double gap, double error, std::uint64_t base_points) {
    IndexBasis basis = kWhole;
    basis.used = basis.planned = basis.computed = base_points;
    const std::string text =
        influence_sentence("f", {alone("a", 0.8, 0.01), alone("b", 0.1 + gap, error), alone("c", 0.1, 0)}, basis);
    return text.substr(text.find(": ") + 2);
  };
  EXPECT_EQ(second(0.02, 0.02, 64), "256 would do");     // 64 * (2 * 0.02/0.02)^2 = 256 is a power of two itself
  EXPECT_EQ(second(0.0199, 0.02, 64), "512 would do");   // a little more
  EXPECT_EQ(second(0.02, 0.0101, 64), "128 would do");   // 65.3
  EXPECT_EQ(second(0.02, 0.0101, 100), "128 would do");  // 102
  EXPECT_EQ(second(1e-5, 0.02, 64), "and how many would do, they do not tell");
  EXPECT_EQ(second(0, 0.02, 64), "and how many would do, they do not tell");
  // 0.25 is two errors, and no more: not told by 64, and so by more than 64.
  EXPECT_EQ(influence_sentence("f", {alone("a", 2, 0.01), alone("b", 0.5, 0.125), alone("c", 0.25, 0)}, kWhole),
            "a decides f (2.00 +- 0.01 of its variance); for second place 64 base points are too few: 128 would do");
}

TEST(InfluenceSentence, NamesTheSecondWhereTheErrorsTell) {
  EXPECT_EQ(
      influence_sentence("drift", {alone("spin", 0.02, 0.01), alone("tilt", 0.8, 0.02), alone("latitude", 0.2, 0.03)}, kWhole),
      "tilt decides drift (0.80 +- 0.02 of its variance); second is latitude (total index 0.20 +- 0.03)");
}

TEST(InfluenceSentence, AsksForNoPointsForInputsThatDoNotMatter) {
  EXPECT_EQ(influence_sentence(
                "drift", {alone("spin", 0.001, 0.001), alone("tilt", 0.99, 0.02), alone("latitude", 0.002, 0.003)}, kWhole),
            "tilt decides drift (0.99 +- 0.02 of its variance); no other input has 0.01 of it");
  EXPECT_EQ(influence_sentence("drift", {alone("tilt", 0.9, 0.02), alone("latitude", 0.1, 0.02)}, kWhole),
            "tilt decides drift (0.90 +- 0.02 of its variance)");
}

/// An input of less than half of the variance, or of half within its error, does not decide.
TEST(InfluenceSentence, SaysThatAnInputMattersMostWithoutDeciding) {
  EXPECT_EQ(influence_sentence("drift", {alone("a", 0.53, 0.02), alone("b", 0.3, 0.02), alone("c", 0.17, 0.02)}, kWhole),
            "a matters most for drift (total index 0.53 +- 0.02); second is b (total index 0.30 +- 0.02)");
  EXPECT_EQ(influence_sentence("drift", {alone("a", 0.55, 0.02), alone("b", 0.3, 0.02), alone("c", 0.17, 0.02)}, kWhole),
            "a decides drift (0.55 +- 0.02 of its variance); second is b (total index 0.30 +- 0.02)");
}

TEST(InfluenceSentence, LeavesTheFirstPlaceOpenWhereTheErrorsDo) {
  EXPECT_EQ(influence_sentence("drift", {alone("a", 0.5, 0.1), alone("b", 0.4, 0.1)}, kWhole),
            "which of a and b matters most for drift is not decided (total indices 0.50 +- 0.10 and 0.40 +- 0.10): 64 base "
            "points are "
            "too few, 512 would do");
  EXPECT_EQ(influence_sentence("drift", {alone("a", 0.35, 0.1), alone("b", 0.3, 0.1), alone("c", 0.33, 0.1)}, kWhole),
            "which of a, c and b matters most for drift is not decided (total indices 0.35 +- 0.10, 0.33 +- 0.10 and 0.30 +- "
            "0.10): 64 "
            "base points are too few, 16384 would do");
  // The third is told from the first, and is no rival.
  EXPECT_EQ(influence_sentence("drift", {alone("a", 0.5, 0.05), alone("b", 0.4, 0.05), alone("c", 0.1, 0.02)}, kWhole),
            "which of a and b matters most for drift is not decided (total indices 0.50 +- 0.05 and 0.40 +- 0.05): 64 base "
            "points are "
            "too few, 128 would do");
}

TEST(InfluenceSentence, TellsInteractionsBeyondTheirErrorsOnly) {
  const InputIndex a{"a", {0.6, 0.02, 0.8, 0.02}}, b{"b", {0.2, 0.02, 0.4, 0.03}}, seen{"c", {0, 0.01, 0.05, 0.01}},
      unseen{"c", {0.04, 0.02, 0.05, 0.02}};
  EXPECT_EQ(
      influence_sentence("drift", {a, b, unseen}, kWhole),
      "a decides drift (0.60 +- 0.02 of its variance); second is b (total index 0.40 +- 0.03); a and b act together with other "
      "inputs, too: their total indices exceed their first by 0.20 +- 0.03 and 0.20 +- 0.04");
  EXPECT_EQ(influence_sentence("drift", {alone("a", 0.9, 0.02), alone("b", 0.2, 0.02), seen}, kWhole),
            "a decides drift (0.90 +- 0.02 of its variance); second is b (total index 0.20 +- 0.02); c acts together with "
            "other inputs, "
            "too: its total index exceeds its first by 0.05 +- 0.01");
}

TEST(InfluenceSentence, OfOneInputAndOfWhatIsLeft) {
  EXPECT_EQ(influence_sentence("drift", {alone("a", 1, 0.1)}, kWhole), "a is the only input of drift");
  EXPECT_EQ(influence_sentence("drift", {alone("a", 0.9, 0.02), alone("b", 0.1, 0.02)}, {64, 64, 40, 320, 77}),
            "over what is left of the box, a decides drift (0.90 +- 0.02 of its variance)");
}

TEST(IndexBasis, IsTold) {
  EXPECT_EQ(study::basis_text(kWhole), "from 64 base points");
  EXPECT_EQ(study::left_out_warning(kWhole), "");
  const IndexBasis part{64, 64, 40, 320, 77}, under_way{64, 40, 40, 203, 0}, few{64, 64, 20, 320, 160},
      small{16, 16, 16, 80, 0};
  EXPECT_EQ(study::basis_text(part), "from 40 of 64 base points");
  EXPECT_EQ(
      study::left_out_warning(part),
      "24 of 64 base points are left out, as they have points that failed or have no value. The indices are therefore those of "
      "another distribution than the design's: about 24 % of the box of the axes cannot exist (77 of 320 points)");
  EXPECT_NE(study::left_out_warning({64, 64, 63, 320, 1}).find("about 0.31 % of the box"), std::string::npos);
  EXPECT_EQ(study::basis_text(under_way), "from 40 of 64 base points");
  EXPECT_EQ(study::left_out_warning(under_way), "");
  EXPECT_EQ(
      study::no_indices_reason(few),
      "only 20 of 64 base points have all their values, and Sobol indices need at least 32; about 50 % of the box of the axes "
      "cannot exist (160 of 320 points)");
  EXPECT_EQ(study::no_indices_reason(small), "16 base points are too few for Sobol indices: at least 32 are needed");
  EXPECT_EQ(study::no_indices_reason(kWhole), "its values do not vary, or those of one base point only");
}

/// A study of two inputs and a constant whose point has no value beyond the pole.
Study sobol_study(const std::string& ends, std::uint64_t base_points, const std::string& collect, const std::string& more = "",
                  const std::string& kind = "sobol") {
  return parse_study({"sobol.json", R"({"base": ")" + std::string(EARTHTOP_SCENARIOS) +
                                        R"(/toy-top.json", "set": {"/motion/duration_s": 0.5)" + more + R"(},
    "axes": [{"pointer": "/site/latitude_deg", "range": {)" +
                                        ends + R"(}}, {"pointer": "/release/tilt_deg", "range": {"from": 10, "to": 40}}],
    "design": {"kind": ")" + kind + R"(", "points": )" +
                                        std::to_string(base_points) + R"(, "indices": true}, "collect": [)" + collect + "]}"});
}

study::Json results_of(const Study& study, const TemporaryDirectory& dir, fs::path* store = nullptr) {
  StudyRunOptions options;
  options.dir = dir.path() / "study";
  options.jobs = 2;
  options.keep_going = true;
  const fs::path file = run_study(study, options).store;
  if (store) *store = file;
  return study::Json::parse(study_json(file));
}

/// The cells of a study's table, row by row, by the names of its columns.
std::vector<std::map<std::string, std::string>> table_of(const fs::path& store) {
  std::string text;
  study_csv(store, [&](std::string_view piece) { text += piece; });
  std::istringstream lines(text);
  std::vector<std::map<std::string, std::string>> rows;
  std::vector<std::string> names;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    std::vector<std::string> row;
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
    if (names.empty()) {
      names = row;
      continue;
    }
    std::map<std::string, std::string>& named = rows.emplace_back();
    for (std::size_t i = 0; i < names.size(); ++i) named[names[i]] = i < row.size() ? row[i] : "";
  }
  return rows;
}

TEST(SobolStudy, TellsOfPointsThatCannotExist) {
  const TemporaryDirectory dir;
  fs::path store;
  const auto document =
      results_of(sobol_study(R"("from": -60, "to": 120)", 64, R"("drift.axis_final_rad", "drift.verdict")"), dir, &store);
  std::map<int, int> completed;
  int failed = 0;
  for (const auto& row : table_of(store)) {
    completed[std::stoi(row.at("point")) / 4] += row.at("status") == "completed";
    failed += row.at("status") != "completed";
  }
  const auto whole = std::count_if(completed.begin(), completed.end(), [](const auto& block) { return block.second == 4; });
  const auto& basis = document.at("indices_basis").at("drift.axis_final_rad");
  EXPECT_FALSE(document.at("indices_basis").contains("drift.verdict"));  // words have no indices
  EXPECT_EQ(basis.at("base_points"), 64);
  EXPECT_EQ(basis.at("base_points_computed"), 64);
  EXPECT_EQ(basis.at("base_points_used"), whole);
  EXPECT_LT(whole, 64);
  EXPECT_GE(whole, 32);
  EXPECT_EQ(basis.at("points"), 256);
  EXPECT_EQ(basis.at("points_without_value"), failed);
  constexpr double kOfBox = 1.0 / 6, kSequence = 0.03;  // 30 of 180 degrees; 128 places of a Sobol sequence
  EXPECT_NEAR(basis.at("share_without_value").get<double>(), kOfBox, kSequence);
  EXPECT_EQ(basis.at("basis"), "from " + std::to_string(whole) + " of 64 base points");
  EXPECT_NE(basis.at("warning").get<std::string>().find("another distribution"), std::string::npos);
  EXPECT_TRUE(basis.at("sentence").get<std::string>().starts_with("over what is left of the box, "));
  EXPECT_TRUE(document.at("indices").contains("drift.axis_final_rad"));
}

TEST(SobolStudy, SaysWhyItHasNoIndices) {
  const TemporaryDirectory dir, other;
  const Study few = sobol_study(R"("from": -60, "to": 60)", 31, R"("drift.axis_final_rad")");
  EXPECT_EQ(indices_note(few), "31 base points are too few for Sobol indices: at least 32 are needed");
  const auto document = results_of(few, dir);
  EXPECT_EQ(document.at("indices_note"), indices_note(few));
  EXPECT_TRUE(document.at("indices").empty());
  EXPECT_EQ(document.at("indices_basis").at("drift.axis_final_rad").at("no_indices"), indices_note(few));

  const Study enough = sobol_study(R"("from": 60, "to": 120)", 32, R"("drift.axis_final_rad")");
  EXPECT_EQ(indices_note(enough), "");
  const auto half = results_of(enough, other);
  EXPECT_FALSE(half.contains("indices_note"));
  EXPECT_TRUE(half.at("indices").empty());
  EXPECT_NE(half.at("indices_basis")
                .at("drift.axis_final_rad")
                .at("no_indices")
                .get<std::string>()
                .find("of 32 base points have all"),
            std::string::npos);
}

TEST(SobolStudy, TakesIndependentPointsToo) {
  const TemporaryDirectory dir;
  const auto document = results_of(sobol_study(R"("from": -60, "to": 60)", 40, R"("drift.axis_final_rad")", "", "random"), dir);
  EXPECT_EQ(document.at("points_computed"), 160);
  EXPECT_EQ(document.at("indices_basis").at("drift.axis_final_rad").at("basis"), "from 40 base points");
  EXPECT_EQ(document.at("indices").at("drift.axis_final_rad").size(), 2U);
}

TEST(DerivativeIndices, BoundTheTotalIndicesOfAStudy) {
  const TemporaryDirectory dir;
  const auto document = results_of(sobol_study(R"("from": -60, "to": 60)", 64,
                                               R"("drift.axis_final_rad", "drift.azimuth_final_rad", "drift.verdict",
                     {"name": "by_latitude", "path": "sensitivities.inputs.0.d_axis_rad"}, "sensitivities.inputs.2.d_axis_rad",
                     {"name": "by_tilt", "path": "sensitivities.inputs.3.d_axis_rad"},
                     {"name": "azimuth_by_tilt", "path": "sensitivities.inputs.3.d_azimuth_rad"},
                     {"name": "tilt_by_tilt", "path": "sensitivities.inputs.3.d_tilt_rad"})",
                                               R"(, "/report": {"sensitivities": true})"),
                                   dir);
  const auto& derivatives = document.at("derivative_indices");
  ASSERT_EQ(derivatives.size(), 2U);
  ASSERT_EQ(derivatives.at("drift.axis_final_rad").size(), 2U);  // the spin does not vary
  for (const auto& [quantity, axes] : derivatives.items())
    for (const auto& [axis, index] : axes.items()) {
      const double bound = index.at("total_order_bound"),
                   total = document.at("indices").at(quantity).at(axis).at("total_order");
      EXPECT_GE(bound, total) << quantity << " by " << axis;
      EXPECT_EQ(index.at("points"), 256);
    }
  // From the points that the document lists: by tilt over 30 degrees.
  double squares = 0, sum = 0, sum_of_squares = 0;
  for (const auto& point : document.at("points")) {
    squares += std::pow(point.at("by_tilt").get<double>(), 2) / 256;
    sum += point.at("drift.axis_final_rad").get<double>() / 256;
    sum_of_squares += std::pow(point.at("drift.axis_final_rad").get<double>(), 2) / 256;
  }
  const auto& by_tilt = derivatives.at("drift.axis_final_rad").at("tilt_deg");
  constexpr double kSums = 1e-9;  // relative; the variance loses some digits to the mean
  EXPECT_NEAR(by_tilt.at("mean_square").get<double>() / squares, 1, kSums);
  const double bound = std::pow(30 / 3.14159265358979323846, 2) * squares / (sum_of_squares - sum * sum);
  EXPECT_NEAR(by_tilt.at("total_order_bound").get<double>() / bound, 1, kSums);
  ASSERT_EQ(document.at("derivative_notes").size(), 1U);
  EXPECT_EQ(document.at("derivative_notes").at(0),
            "tilt_by_tilt gives no derivative-based index, as drift.tilt_final_rad is not collected");
}

/// In an axis of equal ratios the logarithm is what is spread evenly.
TEST(DerivativeIndices, OfAnAxisOfRatiosAreByItsLogarithm) {
  const TemporaryDirectory dir;
  const auto document = results_of(
      parse_study({"ratios.json", R"({"base": ")" + std::string(EARTHTOP_SCENARIOS) +
                                      R"(/toy-top.json", "set": {"/motion/duration_s": 0.5, "/report": {"sensitivities": true}},
        "axes": [{"name": "rate", "pointer": "/earth/rotation_rate_rad_s", "log_range": {"from": 1e-5, "to": 1e-3}}],
        "design": {"kind": "random", "points": 50},
        "collect": ["drift.axis_final_rad", "drift.verdict", {"name": "by_rate", "path": "sensitivities.inputs.4.d_axis_rad"}]})"}),
      dir);
  double squares = 0, sum = 0, sum_of_squares = 0;
  for (const auto& point : document.at("points")) {
    const double f = point.at("drift.axis_final_rad");
    squares += std::pow(point.at("by_rate").get<double>() * point.at("rate").get<double>() * std::log(100), 2) / 50;
    sum += f / 50;
    sum_of_squares += f * f / 50;
  }
  const auto& index = document.at("derivative_indices").at("drift.axis_final_rad").at("rate");
  const double bound = squares / (sum_of_squares - sum * sum) / std::pow(3.14159265358979323846, 2);
  constexpr double kSums = 1e-9;  // relative; the variance loses some digits to the mean
  EXPECT_NEAR(index.at("total_order_bound").get<double>() / bound, 1, kSums);
  EXPECT_EQ(index.at("points"), 50);
  EXPECT_TRUE(document.at("derivative_notes").empty());
}

TEST(DerivativeIndices, AreNotedWhereTheyDoNotHold) {
  const TemporaryDirectory dir, grid, nowhere;
  const auto of_nothing =
      results_of(sobol_study(R"("from": 100, "to": 120)", 32, R"("drift.axis_final_rad", "sensitivities.inputs.0.d_axis_rad")",
                             R"(, "/report": {"sensitivities": true})"),
                 nowhere);
  EXPECT_EQ(of_nothing.at("derivative_notes").at(0),
            "there are no derivative-based indices, as none of the first points has a scenario");
  EXPECT_TRUE(of_nothing.at("derivative_indices").empty());
  EXPECT_EQ(
      of_nothing.at("indices_basis").at("drift.axis_final_rad").at("no_indices"),
      "only 0 of 32 base points have all their values, and Sobol indices need at least 32; about 100 % of the box of the axes "
      "cannot exist (128 of 128 points)");
  const auto document =
      results_of(sobol_study(R"("from": 60, "to": 120)", 32, R"("drift.axis_final_rad", "sensitivities.inputs.0.d_axis_rad")",
                             R"(, "/report": {"sensitivities": true})"),
                 dir);
  std::string notes;
  for (const auto& note : document.at("derivative_notes")) notes += note.get<std::string>() + "\n";
  EXPECT_NE(notes.find("points failed, so the derivatives are those of another distribution"), std::string::npos);
  EXPECT_NE(notes.find("collect drift.verdict"), std::string::npos);
  const auto of_grid = results_of(
      parse_study({"grid.json", R"({"base": ")" + std::string(EARTHTOP_SCENARIOS) +
                                    R"(/toy-top.json", "set": {"/motion/duration_s": 0.5, "/report": {"sensitivities": true}},
        "axes": [{"pointer": "/site/latitude_deg", "values": [10, 20]}],
        "collect": ["drift.axis_final_rad", "sensitivities.inputs.0.d_axis_rad"]})"}),
      grid);
  EXPECT_TRUE(of_grid.at("derivative_indices").empty());
  EXPECT_EQ(of_grid.at("derivative_notes").at(0),
            "sensitivities.inputs.0.d_axis_rad gives no derivative-based index, as latitude_deg is not drawn evenly from the "
            "range of "
            "one key");
}

/// A study with numbers, words, failed points and a bound.
struct Selected : ::testing::Test {
  static const TemporaryDirectory& place() {
    static const TemporaryDirectory dir;
    return dir;
  }
  static const fs::path& store() {
    static const fs::path file = [] {
      StudyRunOptions options;
      options.dir = place().path();
      options.jobs = 2;
      return run_study(parse_study({"points.json", R"({"base": ")" + std::string(EARTHTOP_SCENARIOS) +
                                                       R"(/toy-top.json", "set": {"/motion/duration_s": 0.5},
        "axes": [{"pointer": "/site/latitude_deg", "range": {"from": -90, "to": 90, "points": 13}},
                 {"pointer": "/release/precession", "values": ["none", "steady_slow"]},
                 {"pointer": "/release/tilt_deg", "values": [10, 20, 200]}],
        "collect": ["drift.azimuth_final_rad", "drift.axis_bound_rad", "drift.verdict"]})"}),
                       options)
          .store;
    }();
    return file;
  }
  static study::Json select(const std::vector<std::string>& where, const std::optional<std::string>& worst = std::nullopt) {
    return study::Json::parse(selected_points_json(store(), {where, worst}));
  }
  static std::string refusal(const std::vector<std::string>& where, const std::optional<std::string>& worst = std::nullopt) {
    try {
      select(where, worst);
    } catch (const ScenarioError& error) {
      return error.diagnostics().front().message;
    }
    return "";
  }
  /// How many rows of the table meet a condition that is told anew.
  template <class Condition>
  static std::size_t count(const Condition& condition) {
    const auto rows = table_of(store());
    return static_cast<std::size_t>(std::count_if(rows.begin(), rows.end(), condition));
  }
};
using Row = const std::map<std::string, std::string>&;

TEST_F(Selected, PointsMeetConditions) {
  const auto latitude = [](Row row) { return std::stod(row.at("latitude_deg")); };
  EXPECT_EQ(select({"latitude_deg>15"}).at("matching"), count([&](Row row) { return latitude(row) > 15.001; }));
  EXPECT_EQ(select({"latitude_deg>=15"}).at("matching"), count([&](Row row) { return latitude(row) > 14.999; }));
  EXPECT_EQ(select({"latitude_deg<-30"}).at("matching"), count([&](Row row) { return latitude(row) < -30.001; }));
  EXPECT_EQ(select({"latitude_deg <= -30"}).at("matching"), count([&](Row row) { return latitude(row) < -29.999; }));
  EXPECT_EQ(select({"latitude_deg=60"}).at("matching"), 6);
  EXPECT_EQ(select({"latitude_deg!=60"}).at("matching"), 72);
  EXPECT_EQ(select({"status=refused"}).at("matching"), count([](Row row) { return row.at("status") == "refused"; }));
  EXPECT_EQ(select({"precession=none"}).at("matching"), 39);
  EXPECT_EQ(select({"precession==none", "tilt_deg=20"}).at("matching"), 13);
  EXPECT_EQ(select({"point<5"}).at("matching"), 5);
  const auto far = select({"drift.azimuth_final_rad<-1e-5", "drift.verdict=reliable"});
  EXPECT_EQ(far.at("matching"), count([](Row row) {
              return row.at("status") == "completed" && std::stod(row.at("drift.azimuth_final_rad")) < -1e-5 &&
                     row.at("drift.verdict") == "reliable";
            }));
  EXPECT_GT(far.at("matching"), 0);
  EXPECT_EQ(far.at("points").size(), far.at("matching"));
  for (const auto& point : far.at("points")) EXPECT_LT(point.at("drift.azimuth_final_rad").get<double>(), -1e-5);
  const auto none = select({"latitude_deg>1000"});
  EXPECT_EQ(none.at("matching"), 0);
  EXPECT_TRUE(none.at("points").empty());
}

TEST_F(Selected, WorstPointsAreTheLargestInSize) {
  std::vector<std::pair<double, std::uint64_t>> sizes, bounds;
  for (Row row : table_of(store())) {
    if (row.at("status") != "completed") continue;
    sizes.emplace_back(-std::abs(std::stod(row.at("drift.azimuth_final_rad"))), std::stoull(row.at("point")));
    bounds.emplace_back(-std::stod(row.at("drift.axis_bound_rad")), std::stoull(row.at("point")));
  }
  std::sort(sizes.begin(), sizes.end());
  std::sort(bounds.begin(), bounds.end());
  const auto worst = select({}, "drift.azimuth_final_rad"), loose = select({}, "drift.axis_bound_rad");
  ASSERT_EQ(worst.at("points").size(), 10U);
  ASSERT_EQ(loose.at("points").size(), 10U);
  EXPECT_EQ(worst.at("worst_means"), "largest absolute value");
  EXPECT_EQ(loose.at("worst_means"), "largest bound");
  bool any_negative = false;
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_EQ(worst.at("points").at(i).at("point"), sizes[i].second);
    EXPECT_EQ(loose.at("points").at(i).at("point"), bounds[i].second);
    any_negative = any_negative || worst.at("points").at(i).at("drift.azimuth_final_rad").get<double>() < 0;
    EXPECT_TRUE(worst.at("points").at(i).contains("latitude_deg"));
    EXPECT_FALSE(worst.at("points").at(i).contains("drift.axis_bound_rad"));
  }
  EXPECT_TRUE(any_negative);
  const auto of_few = select({"latitude_deg=60", "tilt_deg=10"}, "drift.azimuth_final_rad");
  EXPECT_EQ(of_few.at("points").size(), 2U);
}

TEST_F(Selected, BadConditionsAreRefused) {
  for (const auto& [condition, part] : std::map<std::string, const char*>{
           {"latitude>3", "did you mean \"latitude_deg\""},
           {"nothing>3", "there are: latitude_deg, precession, tilt_deg, drift.azimuth_final_rad"},
           {"latitude_deg", "must be a column, one of < > <= >= = !=, and a value"},
           {"latitude_deg=<3", "must be a column"},
           {">3", "must be a column"},
           {"", "must be a column"},
           {"latitude_deg>", "gives no value"},
           {"0<latitude_deg<3", "more than one comparison"},
           {"latitude_deg>north", "compares numbers, and \"north\" is none"},
           {"latitude_deg>nan", "is none"},
           {"latitude_deg=north", "latitude_deg holds numbers, and \"north\" is none"},
           {"drift.verdict>3", "drift.verdict holds words"},
           {"status>refused", "compares numbers"},
           {"status=refuse", "did you mean \"refused\""},
           {"status=bad", "there are: completed"},
           {"point=first", "is no number of a point"}})
    EXPECT_NE(refusal({condition}).find(part), std::string::npos) << condition << ": " << refusal({condition});
  EXPECT_NE(refusal({}, "drift.azimuth_rad").find("there is no quantity"), std::string::npos);
  EXPECT_NE(refusal({}, "tilt_deg").find("is an axis, not a quantity"), std::string::npos);
  EXPECT_NE(refusal({}, "drift.verdict").find("it holds words"), std::string::npos);
  EXPECT_NE(refusal({}, "").find("there is no quantity"), std::string::npos);
}

TEST(StudyTiming, IsToldFromPointsThatWereComputed) {
  const Study study = sobol_study(R"("from": -60, "to": 60)", 1000, R"("drift.axis_final_rad")");
  const StudyTiming one = time_study(study, 1), shard = time_study(study, 1, {1, 4});
  EXPECT_TRUE(one.is_timed());
  EXPECT_GT(one.points_timed, 8);
  EXPECT_GT(one.spent_seconds, 0);
  EXPECT_EQ(one.shard_points, 4000U);
  EXPECT_EQ(shard.shard_points, 1000U);
  EXPECT_EQ(one.seconds, one.core_seconds);
  EXPECT_EQ(shard.seconds, shard.core_seconds / 4);
  EXPECT_TRUE(timing_basis(one).starts_with("The times are those of "));
  EXPECT_EQ(timing_basis({9, 9, 10, 1200, 0.5}),
            "The times are those of 1200 points of the design, computed as the study does, which took 0.5 s");
  EXPECT_EQ(timing_basis({9, 9, 10, 1, 2}),
            "The times are those of 1 point of the design, computed as the study does, which took 2 s");
  EXPECT_EQ(timing_basis({9, 9, 10, 0.58, 8}),
            "The times are told from the first 58 % of one point, computed as the study does, which took 8 s");
  EXPECT_EQ(timing_basis({}), "The times are estimated by rules, as no point could be timed");
}

}  // namespace
}  // namespace earthtop
