// SPDX-License-Identifier: GPL-3.0-or-later
/// Verdicts depend on more than the numbers: on the scenario, the tolerances, the cost, and which quantities are compared.
#include "earthtop/compare/compare.hpp"

#include <gtest/gtest.h>

#include <atomic>

#include "compare/results_copy.hpp"
#include "support/json.hpp"

namespace earthtop {
namespace {

using namespace testing;  // of earthtop: results_copy.hpp

using Set = std::vector<std::pair<std::string, std::string>>;

/// Results of the short run's scene with some keys changed.
class OtherRun {
 public:
  explicit OtherRun(const Set& set, const std::string& scene = "toy-top") {
    auto all = set;
    all.emplace_back("/motion/duration_s", "6");
    testing::write_results_to_be_changed(
        run(parse_scenario(read_scenario_source(std::string(EARTHTOP_SCENARIOS) + "/" + scene + ".json"), all)), path());
  }
  fs::path path() const { return directory_.path() / "other"; }

 private:
  TemporaryDirectory directory_;
};

TEST(Compare, AnotherScenarioIsNamedAndAllowedOnRequest) {
  const OtherRun other(Set{{"/numerics/method", "rkf78"}});
  const PairReport pair = compared(other.path());
  ASSERT_TRUE(has_finding(pair, "other scenario"));
  EXPECT_NE(pair.findings[0].text.find("/numerics/method: \"auto\" in the reference, \"rkf78\" now"), std::string::npos);

  CompareOptions allowed;
  allowed.may_change = {"/numerics"};
  const PairReport now = compared(other.path(), allowed);
  EXPECT_TRUE(now.passed());
  // Another method has other errors: the numbers moved, but by no more than both bounds allow.
  EXPECT_GT(quantity(now, "drift_axis_rad").largest, 0);
  EXPECT_EQ(quantity(now, "drift_axis_rad").change, Change::within_errors);
  EXPECT_NE(quantity(now, "drift_axis_rad").origin.find("both error bounds"), std::string::npos);

  allowed.may_change = {"/num", "/numerics/methods"};  // no step of the path
  const PairReport mistyped = compared(other.path(), allowed);
  EXPECT_FALSE(mistyped.passed());
  EXPECT_TRUE(mentions(mistyped.notes, "--allow-change /num: neither scenario has such a key"));
}

TEST(Compare, AWatchMayStopIt) {
  const OtherRun other(Set{{"/motion/output_step_s", "0.004"}});  // 1501 rows
  CompareOptions options;
  EXPECT_TRUE(compare_results(other.path(), other.path(), options).passed());
  const std::atomic<bool> stop = true;
  options.watch = Watch(&stop);
  EXPECT_THROW(compare_results(other.path(), other.path(), options), Interrupted);
}

TEST(Compare, AnotherPhysicsIsAboveBothErrors) {
  const OtherRun other(Set{{"/site/latitude_deg", "45.0001"}});
  CompareOptions allowed;
  allowed.may_change = {"/site"};
  const PairReport pair = compared(other.path(), allowed);
  EXPECT_FALSE(pair.passed());
  EXPECT_EQ(quantity(pair, "drift_axis_rad").change, Change::above_errors);
  allowed.tolerances.profile = Profile::physics;  // two millionths of the effect
  EXPECT_TRUE(compared(other.path(), allowed).passed());
  const OtherRun further(Set{{"/site/latitude_deg", "45.1"}});  // two thousandths
  EXPECT_FALSE(compared(further.path(), allowed).passed());
}

TEST(Compare, AnUnstableRunIsComparedUpToItsVerdictsTime) {
  const Set coarse = {{"/numerics/method", "dopri5"}, {"/numerics/relative_tolerance", "1e-6"}};
  const OtherRun reference(Set{}, "sleeping-top-below-critical"), other(coarse, "sleeping-top-below-critical");
  CompareOptions allowed;
  allowed.may_change = {"/numerics"};
  const PairReport pair = compare_results(reference.path(), other.path(), allowed).pairs.at(0);
  ASSERT_TRUE(pair.until_s);
  EXPECT_LT(*pair.until_s, 6);
  EXPECT_LT(pair.rows, Csv(other.path() / "trajectory.csv").rows.size());
  EXPECT_TRUE(mentions(pair.notes, "a verdict does not trust them"));
  for (const QuantityVerdict& verdict : pair.quantities) EXPECT_LE(verdict.at_s.value_or(0), *pair.until_s) << verdict.name;
}

TEST(Compare, CostFailsOnlyOnRequest) {
  const OtherRun other(Set{{"/numerics/relative_tolerance", "1e-13"}});
  CompareOptions options;
  options.may_change = {"/numerics"};
  const PairReport pair = compared(other.path(), options);
  EXPECT_TRUE(pair.passed());
  ASSERT_EQ(pair.cost.size(), 3u);
  double ratio = 0;  // of what a limit on steps looks at
  for (std::size_t i = 0; i < 2; ++i) ratio = std::max(ratio, pair.cost[i].candidate / pair.cost[i].reference);
  EXPECT_NE(ratio, 1);
  options.tolerances.steps_ratio = 0.999 * ratio;
  EXPECT_FALSE(compared(other.path(), options).passed());
  options.tolerances.steps_ratio = 1.001 * ratio;
  EXPECT_TRUE(compared(other.path(), options).passed());
}

TEST(Compare, TolerancesComeFromAFile) {
  const ChangedCopy copy([](Csv& csv) { csv.set(kSome, "drift_axis_rad", csv.get(kSome, "drift_axis_rad") + 1e-8); });
  const TemporaryDirectory dir;
  const auto passes = [&](const std::string& rule) {
    write_text(dir.path() / "t.json", R"({"quantities": {"drift_axis_rad": )" + rule + "}}");
    CompareOptions options;
    options.tolerances = read_tolerances((dir.path() / "t.json").string());
    const PairReport pair = compared(copy.path(), options);
    EXPECT_NE(quantity(pair, "drift_axis_rad").origin.find("t.json"), std::string::npos);
    return pair.passed();
  };
  EXPECT_FALSE(passes(R"({"absolute": 0.99e-8})"));
  EXPECT_TRUE(passes(R"({"absolute": 1.01e-8})"));
  EXPECT_TRUE(passes(R"({"relative": 0.01})"));
  EXPECT_FALSE(passes(R"({"relative": 1e-6, "bounds": 2})"));
  EXPECT_TRUE(passes(R"({"bounds": 1e9})"));
}

TEST(Compare, ATolerancesFileIsRefusedWithAllItsErrors) {
  const TemporaryDirectory dir;
  const std::string file = (dir.path() / "t.json").string();
  write_text(file, R"({"profil": 1, "quantities": {"drift_axis": {}, "drift_axis_rad": {"absolut": 1, "relative": -1}}})");
  try {
    read_tolerances(file);
    ADD_FAILURE() << "accepted";
  } catch (const ScenarioError& error) {
    ASSERT_EQ(error.diagnostics().size(), 4u) << error.what();
    EXPECT_EQ(error.diagnostics()[0].pointer, "/profil");
    EXPECT_EQ(error.diagnostics()[1].pointer, "/quantities/drift_axis");
    EXPECT_EQ(error.diagnostics()[2].pointer, "/quantities/drift_axis_rad/absolut");
    EXPECT_EQ(error.diagnostics()[3].pointer, "/quantities/drift_axis_rad/relative");
  }
}

TEST(Compare, DirectoriesOfManyAreMatchedByName) {
  const TemporaryDirectory dir;
  for (const char* side : {"old", "new"})
    for (const char* name : {"a", "b", "deep/c"}) {
      fs::create_directories((dir.path() / side / name).parent_path());
      fs::copy(ShortRun::get().path(), dir.path() / side / name);
    }
  EXPECT_TRUE(compare_results(dir.path() / "old", dir.path() / "new", {}).passed());
  fs::remove_all(dir.path() / "new" / "b");
  fs::copy(ShortRun::get().path(), dir.path() / "new" / "d");
  write_text(dir.path() / "new" / "deep" / "c" / "trajectory.csv", "t_s");
  const CompareReport report = compare_results(dir.path() / "old", dir.path() / "new", {});
  ASSERT_EQ(report.pairs.size(), 4u);
  EXPECT_TRUE(report.pairs[0].passed());
  EXPECT_TRUE(has_finding(report.pairs[1], "missing result"));
  EXPECT_EQ(report.pairs[2].name, "deep/c");
  EXPECT_NE(report.pairs[2].refusal.find("is damaged"), std::string::npos);
  EXPECT_TRUE(has_finding(report.pairs[3], "extra result"));
  EXPECT_TRUE(report.refused());
}

TEST(Compare, AReferenceIsUpdatedWithAReasonOnly) {
  const TemporaryDirectory dir;
  const fs::path compact = dir.path() / "toy.json", directory = dir.path() / "results";
  EXPECT_THROW(update_reference(compact, ShortRun::get().path(), " "), ScenarioError);
  EXPECT_FALSE(fs::exists(compact));
  const ChangedCopy moved([](Csv& csv) { csv.set(kSome, "drift_axis_rad", 1e-3); });
  for (const fs::path& reference : {compact, directory}) {
    update_reference(reference, ShortRun::get().path(), "first");
    EXPECT_TRUE(compare_results(reference, ShortRun::get().path(), {}).passed());
    update_reference(reference, moved.path(), "the drift is another one");
    EXPECT_TRUE(compare_results(reference, moved.path(), {}).passed());
    EXPECT_FALSE(compare_results(reference, ShortRun::get().path(), {}).passed());
    const auto kept = testing::parse_json(read_text(reference == compact ? compact : directory / "reference.json"));
    ASSERT_EQ(kept.at("history").size(), 2u);
    EXPECT_EQ(kept.at("history")[1].at("reason"), "the drift is another one");
  }
  const auto kept = testing::parse_json(read_text(compact));
  EXPECT_EQ(kept.at("rows").size(), 11u);
  EXPECT_EQ(kept.at("rows")[10][0], 6.0);
  EXPECT_EQ(kept.at("precision"), "double");
  EXPECT_GE(kept.at("digits").get<int>(), 6);

  const ChangedCopy broken([](Csv& csv) { csv.rows[kSome][3] = "nan"; });
  EXPECT_THROW(update_reference(compact, broken.path(), "no"), ScenarioError);
  EXPECT_EQ(testing::parse_json(read_text(compact)), kept);
}

TEST(Compare, DocumentsHoldEveryVerdictAndHostileNames) {
  const TemporaryDirectory dir;
  const fs::path hostile = dir.path() / "a<b>&\"'\x01";
  fs::copy(ShortRun::get().path(), hostile);
  CompareOptions options;
  options.with_curves = true;
  const CompareReport report = compare_results(ShortRun::get().path(), hostile, options);
  const auto json = testing::parse_json(comparison_json(report));
  EXPECT_EQ(json.at("verdict"), "same");
  EXPECT_EQ(json.at("pairs")[0].at("quantities").size(), report.pairs[0].quantities.size());
  const std::string junit = comparison_junit(report);
  EXPECT_NE(junit.find("a&lt;b&gt;&amp;"), junit.npos);
  EXPECT_EQ(junit.find('\x01'), junit.npos);
  EXPECT_NE(svg(comparison_figure(report)).find("</svg>"), std::string::npos);
}

}  // namespace
}  // namespace earthtop
