// SPDX-License-Identifier: GPL-3.0-or-later
/// Nothing that a run writes is silently not compared: every member of a summary is in the table of figures, which says how it
/// is compared or why it is not, and the comparison does what the table says.
#include "results/figures.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include "compare/compact_reference.hpp"
#include "compare/results_copy.hpp"
#include "results/columns.hpp"
#include "results/made_up_run.hpp"
#include "support/json.hpp"
#include "support/temporary_directory.hpp"

namespace earthtop {
namespace {

using namespace testing;  // of earthtop: results_copy.hpp
using OrderedJson = nlohmann::ordered_json;

/// Calls `visit` with the path and the value of every number, word, flag and null of a summary, elements of lists by their
/// names as a comparison calls them.
template <class Value, class Visit>
void for_each_leaf(Value& at, const std::string& path, const Visit& visit) {
  const std::string start = path.empty() ? "" : path + ".";
  if (at.is_array())
    for (std::size_t i = 0; i < at.size(); ++i)
      for_each_leaf(at[i],
                    start + (at[i].is_object() && at[i].contains("name") ? at[i]["name"].template get<std::string>()
                                                                         : fmt::format("{}", i)),
                    visit);
  else if (at.is_object())
    for (auto& [key, value] : at.items()) for_each_leaf(value, start + key, visit);
  else
    visit(path, at);
}

bool is_compared(const SummaryMember& member) {
  return member.kind != FigureKind::not_compared && member.kind != FigureKind::cost;
}

void expect_table_covers(const RunResult& result) {
  OrderedJson summary = parse_ordered_json(summary_json(result));
  int leaves = 0;
  for_each_leaf(summary, "", [&](const std::string& path, const OrderedJson& value) {
    ++leaves;
    const SummaryMember* member = find_member(path);
    ASSERT_TRUE(member) << path << " is in the summary, but not in the table of figures";
    if (value.is_null()) return;  // of an object that this result lacks
    EXPECT_TRUE(member->form != MemberForm::object && member->form != MemberForm::list) << path;
    EXPECT_TRUE(is_compared(*member) || member->kind == FigureKind::cost || !member->why_not.empty()) << path;
    EXPECT_FALSE(value.is_number() && is_compared(*member) && member->kind <= FigureKind::outcome)
        << path << " is a number, compared as a word";
  });
  EXPECT_GT(leaves, 80);
}

/// The first moments of a scenario: which members its summary has does not hang on how long it is.
void expect_table_covers(const fs::path& file) {
  SCOPED_TRACE(file.filename().string());
  const std::vector<std::pair<std::string, std::string>> brief = {{"/motion/duration_s", "0.05"},
                                                                  {"/motion/output_step_s", "0.01"}};
  expect_table_covers(run(parse_scenario(read_scenario_source(file.string()), brief)));
}

TEST(SummaryTable, CoversEverySummary) {
  int files = 0;
  for (const char* folder : {EARTHTOP_SCENARIOS, EARTHTOP_SCENARIOS "/hard"})
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (entry.path().extension() != ".json") continue;
      ++files;
      expect_table_covers(entry.path());
    }
  EXPECT_GT(files, 60);
  expect_table_covers(test::made_up_run());
  expect_table_covers(test::made_up_full_run());
  expect_table_covers(test::made_up_contact_run());
  expect_table_covers(test::made_up_rotor_run());
  expect_table_covers(test::made_up_gimbals_run());
}

TEST(SummaryTable, HasNoMemberThatNoSummaryHas) {
  std::set<const SummaryMember*> written;
  RunResult full = test::made_up_full_run(), other = full;
  other.solution.status = other.certificate.status = RunStatus::step_limit;
  other.sensitivities->unavailable = "a reason";
  other.scene = testing::changed(other.scene, [](Scenario& s) { s.precision = Precision::bits113; });
  other.extended_rows.resize(other.rows.size());
  RunResult braked = test::made_up_run();  // the figures of its top have a note about friction
  braked.scene = testing::changed(braked.scene, [](Scenario& s) { s.effects.applied.viscous_N_m_s = 1e-9; });
  RunResult contact = test::made_up_contact_run();
  for (ContactBalances* balances : {&contact.contact->rotating, &contact.contact->reference})
    *balances = {ContactBalance{1, 3, 1.5, 0.5, 4}, ContactBalance{10, 7, -2, -1, 8}};
  RunResult partly = full;
  partly.sensitivities->inputs[2].unavailable = "a reason";
  for (const RunResult& result : {full, other, braked, partly, contact, test::made_up_rotor_run(), test::made_up_gimbals_run(),
                                  test::made_up_gimbals_run(11, true), test::made_up_journey_run(11)}) {
    OrderedJson summary = parse_ordered_json(summary_json(result));
    for_each_leaf(summary, "", [&](const std::string& path, const OrderedJson&) { written.insert(find_member(path)); });
  }
  for (const SummaryMember& member : summary_members())
    EXPECT_TRUE(written.contains(&member) || member.form == MemberForm::object || member.form == MemberForm::list)
        << member.path;
}

/// The reason that the table gives for each member that is not compared is true of it.
TEST(SummaryTable, SaysTrulyWhyAMemberIsNotCompared) {
  const auto under = [](std::string_view path, std::initializer_list<std::string_view> places) {
    return std::any_of(places.begin(), places.end(), [&](std::string_view place) { return path.starts_with(place); });
  };
  const auto named = [](std::string_view path, std::initializer_list<std::string_view> names) {
    const std::string_view last = path.substr(path.find_last_of('.') + 1);  // the whole where there is no dot
    return std::find(names.begin(), names.end(), last) != names.end();
  };
  /// Whether the member of the same path with another part is compared.
  const auto other_is_compared = [](std::string_view path, std::string_view part, std::string_view other) {
    std::string name(path);
    const std::size_t at = name.find(part);
    if (at == name.npos) return false;
    const SummaryMember* member = find_member(name.replace(at, part.size(), other));
    return member && is_compared(*member);
  };
  using Path = std::string_view;
  const std::map<Path, std::function<bool(Path)>> truths = {
      {"it only names what is next to it",
       [&](Path path) {
         return named(path, {"$schema", "name", "title", "unit", "statement", "per"});
       }},
      {"it repeats the scenario, whose keys are compared",
       [&](Path path) {
         return under(path, {"matching_rule.", "headline.", "provenance.constants.", "provenance.scenario"});
       }},
      {"it says in words what other members say in numbers",
       [&](Path path) {
         return named(path,
                      {"reason", "verdict_reason", "why", "text", "numbers", "notes", "left_out", "applies", "mean_of_window"});
       }},
      {"it belongs to a row, and the rows are compared",
       [&](Path path) {
         return under(path, {"drift.reliable.", "gimbal_events.", "motion.spin_final", "motion.reference_spin_final"});
       }},
      {"it follows from the first and the last row, and the rows are compared",
       [&](Path path) { return under(path, {"motion.swing."}); }},
      {"of two nearly equal values either may be the largest",
       [&](Path path) { return other_is_compared(path, "_at_s", "_rad") || other_is_compared(path, "_at_s", "_m"); }},
      {"the value that it belongs to is compared",
       [&](Path path) { return other_is_compared(path, "_bound", "") || other_is_compared(path, "_is_sure", "_s"); }},
      {"it says which rows are marked, and the marks are compared",
       [&](Path path) {
         return under(path, {"drift.verdict_intervals.", "drift.secular.window_s"});
       }},
      {"missing and extra rows are findings of their own", [&](Path path) { return path == "outcome.rows"; }},
      {"it repeats a figure that is compared", [&](Path path) { return other_is_compared(path, ".digits", ""); }},
      {"it says where the result comes from", [&](Path path) { return under(path, {"provenance."}); }},
      {"it checks a column or a figure, which is compared itself, against the scenario's number",
       [&](Path path) { return under(path, {"headline."}); }},
      {"the effects modelled are compared",
       [&](Path path) {
         return under(path, {"effects.left_out", "selection."});
       }},
      {"it is the error that rounding and the integration leave in numbers that are compared",
       [&](Path path) {
         return named(path, {"balance_J", "balance_kg_m3_s", "balance_over_size"});
       }},
      {"it is the work that the search for a tolerance took", [&](Path path) { return path == "accuracy.attempts"; }},
      {"its keys are compared one by one, before any figure", [&](Path path) { return path == "scenario"; }},
  };
  std::set<Path> used;
  for (const SummaryMember& member : summary_members()) {
    if (member.kind != FigureKind::not_compared) continue;
    if (member.form == MemberForm::object || member.form == MemberForm::list) {
      EXPECT_EQ(member.why_not, "it only holds other members") << member.path;
      continue;
    }
    const auto truth = truths.find(member.why_not);
    if (truth == truths.end())
      ADD_FAILURE() << member.path << ": " << member.why_not;
    else
      EXPECT_TRUE(truth->second(member.path)) << member.path << ": " << member.why_not;
    used.insert(member.why_not);
  }
  EXPECT_EQ(used.size(), truths.size()) << "a reason is no member's";
}

// A study takes a part of the summary, which is what stands there in the whole.
TEST(SummaryTable, APartIsThatOfTheWhole) {
  const RunResult result = test::made_up_full_run();
  OrderedJson summary = parse_ordered_json(summary_json(result));
  for (const std::string path : {"name",
                                 "drift",
                                 "drift.axis_max_rad",
                                 "drift.secular",
                                 "drift.secular.azimuth_rate_rad_s",
                                 "motion.axis_final_L",
                                 "motion.axis_final_L.2",
                                 "stops.1.t_s",
                                 "invariants.0.largest_change",
                                 "invariants.1.largest_change",
                                 "effects.modelled",
                                 "effects.modelled.1",
                                 "sensitivities.inputs.3",
                                 "sensitivities.inputs.3.d_tilt_rad",
                                 "scenario.site.latitude_deg",
                                 "provenance.constants.0.value",
                                 "attitude_bound_rad",
                                 "drift.nothing",
                                 "drift.axis_max_rad.below",
                                 "accuracy.reached"}) {
    const OrderedJson* at = &summary;
    for (std::string rest = path; at && !rest.empty();) {
      const std::string step = rest.substr(0, rest.find('.'));
      rest.erase(0, step.size() + 1);
      if (at->is_array())
        at = std::stoul(step) < at->size() ? &(*at)[std::stoul(step)] : nullptr;
      else
        at = at->contains(step) ? &(*at)[step] : nullptr;
    }
    EXPECT_EQ(summary_part(result, path), at ? *at : OrderedJson()) << path;
  }
}

TEST(SummaryTable, WithoutARowBeyondTheReleaseItHasNoNumbersOfRows) {
  RunResult result = test::made_up_full_run();
  result.rows.resize(1);
  OrderedJson summary = parse_ordered_json(summary_json(result));
  for (const char* section : {"drift", "motion", "growth_of_disturbances", "attitude_bound_rad"})
    for_each_leaf(summary[section], section,
                  [](const std::string& path, const OrderedJson& value) { EXPECT_FALSE(value.is_number()) << path; });
  EXPECT_TRUE(summary["accuracy"]["asked_rad"].is_number());
  EXPECT_TRUE(summary_part(result, "drift.axis_final_rad").is_null());
}

// A study may collect these figures of a run on a table, and a headline may be about them.
TEST(SummaryTable, KnowsThePathsOfAContact) {
  for (const char* path :
       {"drift.tip_final_m", "drift.tip_max_m", "drift.tip_bound_m", "contact.events.0.t_s", "contact.events.3.event",
        "contact.prediction_changes.1.tip_m", "scenario.contact.friction_coefficient", "scenario.contact.static_coefficient",
        "scenario.contact.sliding_viscosity_s_m"})
    EXPECT_FALSE(summary_path_fault(path)) << path;
  EXPECT_EQ(summary_path("/drift/axis_final_rad"), "drift.axis_final_rad");
  EXPECT_EQ(summary_path("axis_final_rad"), "drift.axis_final_rad");
  EXPECT_EQ(summary_path("tilt_deg"), "scenario.release.tilt_deg") << "as --set takes it";
  EXPECT_EQ(summary_path("name"), "name") << "the document's own";
  EXPECT_TRUE(summary_path_fault(summary_path("method"))) << "the solution and the certificate have one";
  EXPECT_TRUE(summary_path_fault("drift.tip_last_m"));
  EXPECT_TRUE(summary_path_fault("contact.events.first.t_s"));
  EXPECT_TRUE(is_known_at_the_end("drift.tip_final_m"));
  EXPECT_FALSE(is_known_at_the_end("drift.tip_max_m"));
  EXPECT_TRUE(is_known_at_the_end("contact.events.0.time_difference_s"));
  const RunResult result = test::made_up_contact_run(11);
  EXPECT_EQ(summary_part(result, "drift.tip_final_m"), OrderedJson(*result.drift.tip_final_m));
  EXPECT_EQ(summary_part(result, "contact.events.1.time_difference_s"), OrderedJson(3e-6));
  EXPECT_TRUE(summary_part(result, "contact.events.2.t_s").is_null());
  EXPECT_TRUE(summary_part(test::made_up_run(), "drift.tip_final_m").is_null());
}

/// Both written to files and held against each other by their bits.
PairReport compared_bitwise(const fs::path& before, const fs::path& now) {
  return compare_results(before, now, with_profile(Profile::bitwise)).pairs.at(0);
}

// Every number that the table says is compared is changed in a copy, and the comparison must complain of each by its name, and
// of nothing else.
void expect_every_change_is_found(const RunResult& result, std::size_t at_least) {
  const TemporaryDirectory directory;
  const fs::path before = directory.path() / "before", now = directory.path() / "now";
  testing::write_results_to_be_changed(result, before);
  testing::write_results_to_be_changed(result, now);
  ASSERT_TRUE(compared_bitwise(before, now).passed());
  OrderedJson summary = parse_ordered_json(read_text(now / "summary.json"));
  std::set<std::string> changed, in_words;
  for_each_leaf(summary, "", [&](const std::string& path, OrderedJson& value) {
    const SummaryMember& member = *find_member(path);
    if (!is_compared(member) || path.ends_with(".name")) return;  // a name is part of the paths beside it
    if (value.is_number()) {
      value = 1.5 * value.get<double>() + 1;
      changed.insert(path);
    } else if (path != "outcome.status" && path != "drift.verdict") {  // which decide what else is looked at
      value = "another";
      changed.insert(path);
    } else {
      in_words.insert(path);
    }
  });
  EXPECT_GE(changed.size(), at_least);
  EXPECT_EQ(in_words.size(), 2u);
  write_text(now / "summary.json", text_of(summary));
  std::set<std::string> found;
  for (const QuantityVerdict& verdict : compared_bitwise(before, now).quantities)
    if (!verdict.passed) found.insert(verdict.name);
  EXPECT_EQ(found, changed);
  for (const std::string& path : in_words) {
    OrderedJson one = parse_ordered_json(read_text(before / "summary.json"));
    one[OrderedJson::json_pointer("/" + path.substr(0, path.find('.')))][path.substr(path.find('.') + 1)] = "another";
    write_text(now / "summary.json", text_of(one));
    EXPECT_FALSE(compared_bitwise(before, now).passed()) << path;
  }
}

TEST(SummaryTable, TheComparisonDoesWhatItSays) { expect_every_change_is_found(test::made_up_full_run(), 91); }

TEST(SummaryTable, TheComparisonOfAContactDoesWhatItSays) {
  const RunResult result = test::made_up_contact_run(11);
  ASSERT_NE(summary_json(result).find("\"tip_bound_m\""), std::string::npos);
  expect_every_change_is_found(result, 50);
}

/// Changes a number in one cell of every column of both files. @returns the numbers of columns
std::map<std::string, std::size_t> expect_every_column_is_compared(const RunResult& result,
                                                                   const std::vector<std::string>& files) {
  const TemporaryDirectory directory;
  const fs::path before = directory.path() / "before", now = directory.path() / "now";
  testing::write_results_to_be_changed(result, before);
  testing::write_results_to_be_changed(result, now);
  std::map<std::string, std::size_t> columns;
  for (const std::string& file : files) {
    const Csv original(before / file);
    for (const std::string& column : original.header) {
      if (column == "t_s") continue;
      ++columns[file];
      Csv csv = original;
      if (column == "contact_state")
        csv.rows[5][csv.column(column)] = "mixed";
      else
        csv.set(5, column, column == "drift_reliable" ? 0 : 1.5 * csv.get(5, column) + 0.25);
      write_text(now / file, csv.text());
      const PairReport pair = compared_bitwise(before, now);
      EXPECT_TRUE(std::any_of(pair.quantities.begin(), pair.quantities.end(),
                              [](const QuantityVerdict& verdict) { return !verdict.passed; }))
          << file << " " << column;
    }
    write_text(now / file, original.text());
  }
  return columns;
}

constexpr std::size_t kContactColumns = 15, kRotorColumns = 16, kGimbalColumns = 14, kJourneyColumns = 11;

TEST(Columns, EachIsCompared) {
  auto columns = expect_every_column_is_compared(test::made_up_full_run(), {"trajectory.csv", "torques.csv"});
  EXPECT_EQ(columns["trajectory.csv"],
            trajectory_columns().size() - kContactColumns - kRotorColumns - kGimbalColumns - kJourneyColumns);
  EXPECT_EQ(columns["torques.csv"],
            3 * (torque_quantities().size() - 6));  // there is no table, there are no gimbals, and no journey
}

TEST(Columns, EachOfARotorIsCompared) {
  auto columns = expect_every_column_is_compared(test::made_up_rotor_run(11), {"trajectory.csv"});
  EXPECT_EQ(columns["trajectory.csv"], trajectory_columns().size() - kContactColumns - kGimbalColumns - kJourneyColumns);
}

TEST(Columns, EachOfGimbalsIsCompared) {
  RunResult result = test::made_up_gimbals_run(11);
  result.ledger = test::made_up_run_with_ledger(11).ledger;
  auto columns = expect_every_column_is_compared(result, {"trajectory.csv", "torques.csv"});
  EXPECT_EQ(columns["trajectory.csv"], trajectory_columns().size() - kContactColumns - kJourneyColumns);
  EXPECT_EQ(columns["torques.csv"], 3U * (6 + 2 + 2));  // six of every ledger, two parts of the Coriolis torque, two bearings
}

TEST(Columns, EachOfAJourneyIsCompared) {
  auto columns = expect_every_column_is_compared(test::made_up_journey_run(11), {"trajectory.csv"});
  EXPECT_EQ(columns["trajectory.csv"], trajectory_columns().size() - kContactColumns);
}

TEST(Columns, EachOfAContactIsCompared) {
  RunResult result = test::made_up_contact_run(11);
  result.ledger = test::made_up_run_with_ledger(11).ledger;
  auto columns = expect_every_column_is_compared(result, {"trajectory.csv", "torques.csv"});
  EXPECT_EQ(columns["trajectory.csv"], trajectory_columns().size() - kRotorColumns - kGimbalColumns - kJourneyColumns);
  // Six of every ledger, friction, and the table's force.
  EXPECT_EQ(columns["torques.csv"], 3U * (6 + 2));
}

// The bounds of the tip's drift decide whether a change of it is within the errors.
TEST(Columns, TheTipsDriftHasItsBound) {
  const TemporaryDirectory directory;
  const RunResult result = test::made_up_contact_run(11);
  testing::write_results_to_be_changed(result, directory.path() / "before");
  const auto change_of = [&](double by_bounds) {
    RunResult moved = result;
    BasicContactRow<double>& contact = *moved.rows[5].contact;
    contact.drift_tip_m += by_bounds * contact.drift_tip_bound_m;
    write_results(moved, directory.path() / "now", true);
    const PairReport pair = compared_bitwise(directory.path() / "before", directory.path() / "now");
    for (const QuantityVerdict& verdict : pair.quantities)
      if (verdict.name == "drift_tip_m") return verdict.change;
    return Change::unknown;
  };
  EXPECT_EQ(change_of(0), Change::none);
  EXPECT_EQ(change_of(1.5), Change::within_errors);
  EXPECT_EQ(change_of(2.5), Change::above_errors);
}

TEST(Columns, AWordThatNoContactHasIsRefused) {
  const TemporaryDirectory directory;
  const fs::path before = directory.path() / "before", now = directory.path() / "now";
  for (const fs::path& path : {before, now}) testing::write_results_to_be_changed(test::made_up_contact_run(11), path);
  Csv csv(now / "trajectory.csv");
  csv.rows[3][csv.column("contact_state")] = "hop";
  write_text(now / "trajectory.csv", csv.text());
  try {
    const PairReport pair = compared_bitwise(before, now);
    EXPECT_NE(pair.refusal.find("\"hop\" is not one of slide, roll, mixed"), std::string::npos) << pair.refusal;
  } catch (const ScenarioError& error) {
    EXPECT_NE(std::string(error.what()).find("\"hop\" is not one of slide, roll, mixed"), std::string::npos) << error.what();
  }
}

// Results with a contact against results without: columns are missing, on either side.
TEST(Columns, OneSideAloneOnATableIsADifference) {
  const TemporaryDirectory directory;
  const fs::path table = directory.path() / "table", pivot = directory.path() / "pivot";
  testing::write_results_to_be_changed(test::made_up_contact_run(11), table);
  testing::write_results_to_be_changed(test::made_up_run(11), pivot);
  EXPECT_FALSE(compared_bitwise(table, pivot).passed());
  EXPECT_FALSE(compared_bitwise(pivot, table).passed());
}

// A reference that keeps a few rows of a run on a table is as good as its results.
TEST(Columns, ACompactReferenceKeepsTheContact) {
  const TemporaryDirectory directory;
  const fs::path results = directory.path() / "results", reference = directory.path() / "reference.json";
  testing::write_results_to_be_changed(test::made_up_contact_run(11), results);
  write_text(reference, compare::compact_reference(compare::open_comparand(results, nullptr), OrderedJson::array(), "made up"));
  EXPECT_TRUE(compared_bitwise(reference, results).passed());
  Csv csv(results / "trajectory.csv");
  csv.rows[10][csv.column("contact_state")] = "mixed";
  write_text(results / "trajectory.csv", csv.text());
  EXPECT_FALSE(compared_bitwise(reference, results).passed());
}

}  // namespace
}  // namespace earthtop
