// SPDX-License-Identifier: GPL-3.0-or-later
/// Two runs of one scenario that end at different times are compared in what both have: all of it lies before the earlier end.
#include <gtest/gtest.h>

#include <atomic>
#include <map>
#include <set>

#include "compare/results_copy.hpp"
#include "support/json.hpp"

namespace earthtop {
namespace {

using namespace testing;  // of earthtop: results_copy.hpp
using Ordered = nlohmann::ordered_json;

constexpr std::string_view kOfWholeRun = "a figure of a whole run has no common meaning for runs of unlike lengths",
                           kNoRow = "no row of the longer run tells it at the common end",
                           kNoEvent = "no event before the common end tells it";

using Set = std::vector<std::pair<std::string, std::string>>;

/// Results of a shipped scenario with other keys, to be changed.
class Lengths {
 public:
  explicit Lengths(std::string scenario) : file_(EARTHTOP_SCENARIOS "/" + scenario + ".json") {}
  fs::path lasting(const std::string& duration_s, const std::string& step_s, Set set = {}) {
    set.emplace_back("/motion/duration_s", duration_s);
    set.emplace_back("/motion/output_step_s", step_s);
    const fs::path path = directory_.path() / std::to_string(count_++);
    write_results_to_be_changed(run(parse_scenario(read_scenario_source(file_), set)), path);
    return path;
  }
  fs::path file(const std::string& name) const { return directory_.path() / name; }

 private:
  TemporaryDirectory directory_;
  std::string file_;
  int count_ = 0;
};

CompareOptions of_other_length(Profile profile = Profile::regression) {
  CompareOptions options = with_profile(profile);
  options.may_change = {"/motion"};
  options.may_lack_rows = true;
  return options;
}

PairReport compared_up_to_end(const fs::path& reference, const fs::path& candidate, Profile profile = Profile::regression) {
  return compare_results(reference, candidate, of_other_length(profile)).pairs.at(0);
}

std::map<std::string, std::string_view> left_out(const PairReport& pair) {
  std::map<std::string, std::string_view> all;
  for (const LeftOut& one : pair.left_out) all[one.name] = one.why;
  return all;
}

std::set<std::string> names(const PairReport& pair, bool failed_only) {
  std::set<std::string> all;
  for (const QuantityVerdict& one : pair.quantities)
    if (!failed_only || !one.passed) all.insert(one.name);
  return all;
}

void change_summary(const fs::path& results, const std::function<void(Ordered&)>& change) {
  Ordered summary = parse_ordered_json(read_text(results / "summary.json"));
  change(summary);
  write_text(results / "summary.json", text_of(summary));
}

void change_rows(const fs::path& results, const std::function<void(Csv&)>& change) {
  Csv csv(results / "trajectory.csv");
  change(csv);
  write_text(results / "trajectory.csv", csv.text());
}

std::string conclusion(const fs::path& reference, const fs::path& candidate) {
  return comparison_conclusion(compare_results(reference, candidate, of_other_length())).at(0);
}

TEST(UnlikeLengths, AgreeInWhatBothHave) {
  Lengths top("toy-top");
  const fs::path brief = top.lasting("2", "0.1"), longer = top.lasting("5", "0.1");
  for (const bool reference_goes_on : {false, true}) {
    const fs::path &reference = reference_goes_on ? longer : brief, &candidate = reference_goes_on ? brief : longer;
    for (const Profile profile : {Profile::regression, Profile::physics, Profile::bitwise}) {
      const PairReport pair = compared_up_to_end(reference, candidate, profile);
      // Bounds of rows depend on the whole run, so that their last digits may be others.
      EXPECT_EQ(names(pair, true), profile == Profile::bitwise
                                       ? (std::set<std::string>{"drift_axis_bound_rad", "drift_attitude_bound_rad"})
                                       : std::set<std::string>{})
          << reference_goes_on << to_string(profile);
      EXPECT_EQ(pair.passed(), profile != Profile::bitwise);
      EXPECT_EQ(pair.rows, 21u);
      ASSERT_TRUE(pair.common_end);
      EXPECT_EQ(pair.common_end->t_s, 2);
      EXPECT_EQ(pair.common_end->longer_t_s, 5);
      EXPECT_EQ(pair.common_end->reference_goes_on, reference_goes_on);
    }
    const PairReport pair = compared_up_to_end(reference, candidate);
    const auto out = left_out(pair);
    for (const char* name : {"outcome.reached_s", "drift.axis_max_rad", "drift.tilt_max_rad", "drift.azimuth_max_rad",
                             "drift.verdict", "drift.secular.azimuth_rate_rad_s", "drift.secular.turns_seen",
                             "motion.axis_mean_L.0", "invariants.jacobi_integral.largest_change"})
      EXPECT_EQ(out.contains(name) ? out.at(name) : "", kOfWholeRun) << name;
    EXPECT_EQ(out.at("drift.axis_final_over_earth_angle"), kNoRow);
    const auto held = names(pair, false);
    for (const char* name :
         {"drift.axis_final_rad", "drift.attitude_final_rad", "drift.spin_final_rad", "drift.azimuth_final_rad",
          "drift.tilt_final_rad", "motion.axis_final_L.0", "motion.axis_final_L.2", "motion.reference_axis_final_L.1",
          "top.mass_kg", "top.mean_precession_rad_s", "invariants.jacobi_integral.initial", "outcome.status",
          "effects.modelled.0"})
      EXPECT_TRUE(held.contains(name)) << name;
    for (const auto& [name, why] : out) EXPECT_FALSE(held.contains(name)) << name;
    const std::string words = conclusion(reference, candidate);
    EXPECT_NE(
        words.find(reference_goes_on
                       ? "Both were compared up to t = 2 s, where the new result ends; the reference goes on to t = 5 s."
                       : "Both were compared up to t = 2 s, where the reference ends; the new result goes on to t = 5 s."),
        words.npos)
        << words;
    EXPECT_NE(words.find("What does not belong to that time is left out: " + std::to_string(out.size()) + " figure"),
              words.npos)
        << words;
    EXPECT_TRUE(mentions(pair.notes, "not compared: outcome.reached_s, drift.axis_max_rad,"));
    EXPECT_TRUE(mentions(pair.notes, ": " + std::string(kOfWholeRun)));
    EXPECT_TRUE(mentions(pair.notes, "not compared: drift.axis_final_over_earth_angle: " + std::string(kNoRow)));
  }
}

// Compared figures are still held to their tolerances, on either side.
TEST(UnlikeLengths, DifferInWhatBothHave) {
  Lengths top("toy-top");
  const fs::path brief = top.lasting("2", "0.1"), longer = top.lasting("5", "0.1");
  const auto fails_alone = [&](const std::string& name, const fs::path& changed, const std::function<void(Ordered&)>& change) {
    const std::string kept = read_text(changed / "summary.json");
    change_summary(changed, change);
    for (const auto& [reference, candidate] : {std::pair(brief, longer), std::pair(longer, brief)})
      EXPECT_EQ(names(compared_up_to_end(reference, candidate), true), std::set{name});
    write_text(changed / "summary.json", kept);
  };
  fails_alone("drift.axis_final_rad", brief, [](Ordered& s) { s["drift"]["axis_final_rad"] = 1e-4; });
  fails_alone("motion.axis_final_L.1", brief, [](Ordered& s) { s["motion"]["axis_final_L"][1] = 0.5; });
  for (const fs::path& changed : {brief, longer}) {
    fails_alone("top.mass_kg", changed, [](Ordered& s) { s["top"]["mass_kg"] = 0.2; });
    fails_alone("invariants.jacobi_integral.initial", changed, [](Ordered& s) {
      for (Ordered& one : s["invariants"])
        if (one["name"] == "jacobi_integral") one["initial"] = 1;
    });
  }
  // The longer run's summary says nothing of the common end; its row there does.
  change_rows(longer, [](Csv& csv) { csv.set(20, "drift_tilt_rad", csv.get(20, "drift_tilt_rad") + 1e-9); });
  for (const auto& [reference, candidate] : {std::pair(brief, longer), std::pair(longer, brief)})
    EXPECT_EQ(names(compared_up_to_end(reference, candidate), true),
              (std::set<std::string>{"drift_tilt_rad", "drift.tilt_final_rad"}));
  change_rows(longer, [](Csv& csv) { csv.set(20, "drift_tilt_rad", csv.get(20, "drift_tilt_rad") - 1e-9); });
  change_rows(longer, [](Csv& csv) { csv.set(21, "drift_tilt_rad", 1); });  // after the common end
  for (const auto& [reference, candidate] : {std::pair(brief, longer), std::pair(longer, brief)})
    EXPECT_TRUE(compared_up_to_end(reference, candidate).passed());
}

// Other lengths count as before where nobody has allowed them.
TEST(UnlikeLengths, AreADifferenceUnlessAllowed) {
  Lengths top("toy-top");
  const fs::path brief = top.lasting("2", "0.1"), longer = top.lasting("5", "0.1");
  CompareOptions options;
  options.may_lack_rows = true;
  for (const auto& [reference, candidate] : {std::pair(brief, longer), std::pair(longer, brief)}) {
    const PairReport pair = compare_results(reference, candidate, options).pairs.at(0);
    EXPECT_TRUE(has_finding(pair, "other scenario"));
    EXPECT_FALSE(pair.common_end);
    EXPECT_TRUE(pair.left_out.empty());
    EXPECT_TRUE(names(pair, true).contains("outcome.reached_s"));
  }
  options.may_lack_rows = false;
  options.may_change = {"/motion/duration_s"};
  EXPECT_TRUE(compare_results(brief, longer, options).passed());
  EXPECT_TRUE(has_finding(compare_results(longer, brief, options).pairs.at(0), "missing rows"));
}

// The words for runs of one length have not changed.
TEST(UnlikeLengths, AreNotSeenWhereThereAreNone) {
  Lengths top("toy-top");
  const fs::path one = top.lasting("2", "0.1"), other = top.lasting("2", "0.05");
  const PairReport pair = compared_up_to_end(other, one);
  EXPECT_TRUE(pair.passed());
  EXPECT_FALSE(pair.common_end);
  EXPECT_TRUE(mentions(pair.notes, "not compared: means over the rows, since the rows are different now"));
  EXPECT_TRUE(names(pair, false).contains("drift.axis_max_rad"));
}

// The later motion of a chaotic run, and what its verdict says of that, do not count against the part before it.
TEST(UnlikeLengths, AReferenceCutBeforeChaosAgrees) {
  Lengths top("hard/h11-chaotic");
  const fs::path brief = top.lasting("4", "0.5"), longer = top.lasting("20", "0.5");
  EXPECT_EQ(parse_ordered_json(read_text(longer / "summary.json"))["drift"]["verdict"], "chaotic");
  EXPECT_EQ(parse_ordered_json(read_text(brief / "summary.json"))["drift"]["verdict"], "reliable");
  for (const auto& [reference, candidate] : {std::pair(brief, longer), std::pair(longer, brief)}) {
    const PairReport pair = compared_up_to_end(reference, candidate);
    EXPECT_TRUE(pair.passed());
    EXPECT_EQ(pair.rows, 9u);
    EXPECT_FALSE(pair.until_s);
    EXPECT_TRUE(names(pair, false).contains("motion.axis_final_L.0"));
    EXPECT_TRUE(left_out(pair).contains("growth_of_disturbances.lyapunov_exponent_1_s"));
    // The longer run's attitudes are in error by radians at its end; that does not widen the tolerance before it.
    EXPECT_LT(quantity(pair, "attitude_rad").tolerance, 1e-8);
  }
  // A verdict that trusts less than the other one until the common end is another verdict.
  change_summary(longer, [](Ordered& s) { s["drift"]["verdict_intervals"][0]["from_s"] = 0.2; });
  const PairReport doubted = compared_up_to_end(brief, longer);
  ASSERT_TRUE(has_finding(doubted, "other verdict"));
  EXPECT_EQ(doubted.findings[0].text, "trusted to the end in the reference, until t = 0.2 s now");
}

TEST(UnlikeLengths, EventsCountUpToTheCommonEnd) {
  Lengths top("hard/k12-toy-top-stops");
  const fs::path brief = top.lasting("0.05", "0.01"), longer = top.lasting("0.1", "0.01");
  for (const auto& [reference, candidate] : {std::pair(brief, longer), std::pair(longer, brief)}) {
    const PairReport pair = compared_up_to_end(reference, candidate);
    EXPECT_TRUE(pair.passed());
    const auto held = names(pair, false);
    const auto out = left_out(pair);
    for (const char* event : {"contact.events.0.", "contact.events.1."})
      for (const char* figure : {"event", "t_s", "time_difference_s"}) EXPECT_TRUE(held.contains(std::string(event) + figure));
    for (const char* event : {"contact.events.2.", "contact.events.3."})
      for (const char* figure : {"event", "t_s", "time_difference_s"}) EXPECT_EQ(out.at(std::string(event) + figure), kNoEvent);
    EXPECT_TRUE(held.contains("drift.tip_final_m") && held.contains("contact.work.rotating.jacobi_first_J"));
    EXPECT_EQ(out.at("contact.work.rotating.jacobi_last_J"), kNoRow);
  }
  change_summary(longer, [](Ordered& s) { s["contact"]["events"][1]["t_s"] = 0.042; });
  EXPECT_EQ(names(compared_up_to_end(brief, longer), true), std::set<std::string>{"contact.events.1.t_s"});
  change_summary(longer,
                 [](Ordered& s) { s["contact"]["events"][1]["t_s"] = 0.07; });  // no such event in the longer run any more
  EXPECT_TRUE(names(compared_up_to_end(brief, longer), true).contains("contact.events.1.t_s"));
}

TEST(UnlikeLengths, AThresholdPassedLaterIsLeftOut) {
  Lengths top("toy-top");
  const Set early = {{"/report/threshold_rad", "1e-6"}}, late = {{"/report/threshold_rad", "5e-5"}};
  for (const Set& threshold : {early, late}) {
    const fs::path brief = top.lasting("2", "0.1", threshold), longer = top.lasting("5", "0.1", threshold);
    const bool in_both = threshold == early;
    for (const auto& [reference, candidate] : {std::pair(brief, longer), std::pair(longer, brief)}) {
      const PairReport pair = compared_up_to_end(reference, candidate);
      EXPECT_TRUE(pair.passed());
      EXPECT_EQ(names(pair, false).contains("drift.threshold_time_s"), in_both);
      EXPECT_EQ(left_out(pair).contains("drift.threshold_crossing"), !in_both);
    }
    if (!in_both) continue;
    change_summary(longer, [](Ordered& s) { s["drift"]["threshold_time_s"] = nullptr; });
    EXPECT_TRUE(names(compared_up_to_end(brief, longer), true).contains("drift.threshold_time_s"));
  }
}

// A compact reference has eleven rows: the end of a shorter run need not be among them.
TEST(UnlikeLengths, ACompactReferenceMayBeEither) {
  Lengths top("toy-top");
  const fs::path brief = top.lasting("2", "0.1"), between = top.lasting("2.2", "0.1"), longer = top.lasting("5", "0.1");
  update_reference(top.file("brief.json"), brief, "for a test");
  update_reference(top.file("longer.json"), longer, "for a test");
  for (const auto& [reference, candidate] :
       {std::pair(top.file("brief.json"), longer), std::pair(top.file("longer.json"), brief),
        std::pair(top.file("brief.json"), top.file("longer.json"))}) {
    const PairReport pair = compared_up_to_end(reference, candidate);
    EXPECT_TRUE(pair.passed()) << reference;
    EXPECT_TRUE(names(pair, false).contains("drift.axis_final_rad")) << reference;
  }
  const PairReport pair = compared_up_to_end(top.file("longer.json"), between);
  EXPECT_TRUE(pair.passed());
  EXPECT_EQ(left_out(pair).at("drift.axis_final_rad"), kNoRow);
  EXPECT_EQ(pair.rows, 5u);
}

// Where the longer run has no row at the common end, its rows are interpolated if they are close enough.
TEST(UnlikeLengths, TheEndMayLieBetweenRows) {
  Lengths top("asymmetric-top");
  const Set slow = {{"/release/spin_rad_s", "10"}};
  const fs::path brief = top.lasting("0.50005", "0.0001", slow), longer = top.lasting("1", "0.0001", slow),
                 coarse = top.lasting("1", "0.05", slow);
  for (const auto& [reference, candidate] : {std::pair(brief, longer), std::pair(longer, brief)}) {
    const PairReport pair = compared_up_to_end(reference, candidate, Profile::physics);
    EXPECT_TRUE(pair.passed());
    const QuantityVerdict& end = quantity(pair, "drift.axis_final_rad");
    ASSERT_TRUE(end.interpolation_error);
    EXPECT_NE(end.origin.find(" + interpolation "), std::string::npos) << end.origin;
    EXPECT_LT(end.largest, *end.interpolation_error);
  }
  change_summary(brief, [](Ordered& s) { s["drift"]["axis_final_rad"] = 1.01 * s["drift"]["axis_final_rad"].get<double>(); });
  EXPECT_EQ(names(compared_up_to_end(brief, longer, Profile::physics), true), std::set<std::string>{"drift.axis_final_rad"});
  EXPECT_EQ(left_out(compared_up_to_end(brief, coarse, Profile::physics)).at("drift.axis_final_rad"), kNoRow);
}

// Whatever the motion and its verdict, the beginning of a run agrees with a run that ends there.
TEST(UnlikeLengths, EveryKindOfRunAgreesWithItsBeginning) {
  struct Case {
    const char* scenario;
    const char* brief_s;
    const char* longer_s;
    const char* step_s;
  };
  for (const Case& one : {Case{"dzhanibekov", "1", "3", "0.1"},
                          {"sleeping-top-below-critical", "1", "4", "0.1"},
                          {"tippe-top", "0.4", "1", "0.1"},
                          {"free-gyro", "10", "40", "1"},
                          {"hard/h24-poles", "0.1", "0.3", "0.01"},
                          {"hard/spin-down", "2", "5", "0.5"},
                          {"hard/k18-slip-starts", "0.02", "0.04", "0.005"}}) {
    Lengths top(one.scenario);
    const fs::path brief = top.lasting(one.brief_s, one.step_s), longer = top.lasting(one.longer_s, one.step_s);
    for (const auto& [reference, candidate] : {std::pair(brief, longer), std::pair(longer, brief)}) {
      const PairReport pair = compared_up_to_end(reference, candidate);
      EXPECT_TRUE(pair.passed()) << one.scenario << ": " << conclusion(reference, candidate);
      EXPECT_TRUE(names(pair, false).contains("motion.axis_final_L.0")) << one.scenario;
      EXPECT_TRUE(names(pair, false).contains("top.mass_kg")) << one.scenario;
    }
  }
}

TEST(UnlikeLengths, AWatchMayStopTheSearchForTheEnd) {
  Lengths top("toy-top");
  const fs::path brief = top.lasting("2", "0.1"), longer = top.lasting("5", "0.1");
  CompareOptions options = of_other_length();
  const std::atomic<bool> stop = true;
  options.watch = Watch(&stop);
  EXPECT_THROW(compare_results(brief, longer, options), Interrupted);
}

TEST(UnlikeLengths, TheDocumentsSayWhatWasLeftOut) {
  Lengths top("toy-top");
  const fs::path brief = top.lasting("2", "0.1"), longer = top.lasting("5", "0.1");
  const CompareReport report = compare_results(brief, longer, of_other_length());
  const auto document = testing::parse_json(comparison_json(report)).at("pairs")[0];
  EXPECT_EQ(document.at("common_end_s"), 2);
  EXPECT_EQ(document.at("left_out").size(), report.pairs[0].left_out.size());
  EXPECT_EQ(document.at("left_out")[0].at("name"), "outcome.reached_s");
  EXPECT_EQ(document.at("left_out")[0].at("why"), kOfWholeRun);
  const std::string junit = comparison_junit(report);
  EXPECT_NE(junit.find("name=\"drift.axis_max_rad\">\n      <skipped message=\"" + std::string(kOfWholeRun) + "\"/>"),
            junit.npos);
  EXPECT_NE(junit.find(" skipped=\"" + std::to_string(report.pairs[0].left_out.size()) + "\""), junit.npos);
  const CompareReport same = compare_results(brief, brief, {});
  EXPECT_TRUE(testing::parse_json(comparison_json(same)).at("pairs")[0].at("common_end_s").is_null());
  EXPECT_EQ(comparison_junit(same).find("skipped"), std::string::npos);
}

/// Two copies of the short run's results, whose verdict doubts the motion in some times, and one row of the second is another.
PairReport with_doubts(const Ordered& intervals, std::size_t row, bool change_reference_too = true) {
  const auto doubt = [&](Ordered& s) {
    s["drift"]["verdict"] = "unstable";
    s["drift"]["verdict_intervals"] = intervals;
  };
  const ChangedCopy reference, candidate([&](Csv&csv) {
    if (row > 0) csv.set(row, "drift_axis_rad", 1e-3);
  });
  if (change_reference_too) change_summary(reference.path(), doubt);
  change_summary(candidate.path(), doubt);
  return compare_results(reference.path(), candidate.path(), {}).pairs.at(0);
}

Ordered doubted(double from_s, const Ordered& until_s) {
  return {{"from_s", from_s}, {"until_s", until_s}, {"why", "rounding_grown"}, {"text", ""}};
}

// A comparison does not stop at the first doubt where the verdict trusts the motion again.
TEST(Trust, RowsAfterADoubtThatEndsAreCompared) {
  const Ordered closed = Ordered::array({doubted(2, 3)});
  const PairReport same = with_doubts(closed, 0);
  EXPECT_TRUE(same.passed());
  EXPECT_EQ(same.rows, 52u);  // of 61: 2.1 to 2.9 s are left out
  EXPECT_FALSE(same.until_s);
  EXPECT_TRUE(
      mentions(same.notes, "9 rows between t = 2 s and t = 3 s were not compared, since a verdict does not trust them"));
  EXPECT_TRUE(names(same, false).contains("drift.axis_final_rad"));
  EXPECT_FALSE(names(same, false).contains("drift.axis_max_rad"));
  EXPECT_TRUE(with_doubts(closed, 25).passed());
  EXPECT_EQ(names(with_doubts(closed, 45), true), std::set<std::string>{"drift_axis_rad"});

  const PairReport open = with_doubts(Ordered::array({doubted(1, 1.5), doubted(4, nullptr)}), 0);
  EXPECT_TRUE(open.passed());
  EXPECT_EQ(open.until_s, 4);
  EXPECT_EQ(open.rows, 61u - 4 - 20);
  EXPECT_TRUE(mentions(open.notes, "20 rows after t = 4 s were not compared, since a verdict does not trust them"));
  EXPECT_FALSE(names(open, false).contains("drift.axis_final_rad"));
}

// One side's doubts cannot leave out what the other one trusts.
TEST(Trust, ADoubtOfOneSideAloneIsAnotherVerdict) {
  const PairReport pair = with_doubts(Ordered::array({doubted(1, 5)}), 30, false);
  ASSERT_TRUE(has_finding(pair, "other verdict"));
  EXPECT_EQ(pair.findings[0].text, "trusted to the end in the reference, for 2 s now");
}

// A figure that is zero in truth is made of rounding: what its error is stated to be says how large it may be.
TEST(Zeros, AreJudgedByWhatIsStatedBesideThem) {
  const auto passes = [](double before, double now, const char* figure) {
    const ChangedCopy reference, candidate;
    for (const auto& [copy, value] : {std::pair(&reference, before), std::pair(&candidate, now)})
      change_summary(copy->path(), [&, value = value](Ordered& s) {
        Ordered& theory = s["theory"][0];
        theory[figure] = value;
        theory["predicted_error"] = 4e-9;
        theory["computed_error"] = 4e-15;
      });
    return compare_results(reference.path(), candidate.path(), {}).pairs.at(0);
  };
  EXPECT_TRUE(passes(3.15e-19, 1.2e-21, "predicted").passed());
  EXPECT_EQ(quantity(passes(3.15e-19, 1.2e-21, "predicted"), "theory.precession_rate_change.predicted").origin,
            "1e-06 x predicted_error 4e-09 (profile regression)");
  EXPECT_FALSE(passes(5e-15, 1.2e-21, "predicted").passed());  // more than a millionth of the error
  EXPECT_FALSE(passes(5e-5, 5.000001e-5, "predicted").passed());
  EXPECT_TRUE(passes(3e-21, -1e-21, "computed").passed());
  EXPECT_FALSE(passes(5e-19, -1e-21, "computed").passed());

  const auto with_initial = [](double value, const ChangedCopy& copy) {
    change_summary(copy.path(),
                   [&](Ordered& s) { s["invariants"][0]["initial"] = value * s["invariants"][0]["scale"].get<double>(); });
    return copy.path();
  };
  const ChangedCopy one, other;
  EXPECT_TRUE(compare_results(with_initial(2e-17, one), with_initial(-1e-18, other), {}).passed());
  EXPECT_FALSE(compare_results(with_initial(2e-17, one), with_initial(2e-12, other), {}).passed());
}

}  // namespace
}  // namespace earthtop
