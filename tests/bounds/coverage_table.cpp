// SPDX-License-Identifier: GPL-3.0-or-later
/// earthtop-bound-coverage [COUNT [LEAST_PHASE LARGEST_PHASE [FIRST]]] [--by-hand | --survey] [--only=WORD] [--scenes] [random-STRATUM-INDEX]
/// earthtop-bound-coverage --on-table [COUNT [LONGEST_S LARGEST_PHASE]] [--agreement | --growth | --truth] [--scenes] [on-table-STRATUM-INDEX]
/// Counts how often the true error is below the stated bound, over COUNT random scenes in each stratum (46 by default), and
/// prints a Markdown table by stratum. --by-hand: the scenes' method, tolerance, observer and form are chosen at random among
/// those a user may name, and the table is by method. --survey: lengths, numbers of rows, precisions and tolerances are drawn, too; both are compared
/// with 64 bits, and with 113 where those have to decide.
/// --only: strata whose name contains this word. FIRST: index of the first scene of a stratum. --on-table: tops on a table, in strata by the law of friction (30 scenes in
/// each), compared with the equations of the other observer in 113 bits.
/// --agreement: in double, how far laboratory and inertial equations are apart. --growth: how the growth of disturbances that the
/// verdict estimates compares with that of a small change of the start. --truth: writes tests/data/contact/bounds.json. --scenes: lists every scene first. --json: only writes
/// the scenarios, one a line. random-STRATUM-INDEX: only this scene.
/// A scene whose error exceeds its bound is printed with all its input.

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <map>

#include "bounds/coverage.hpp"
#include "bounds/strata.hpp"
#include "bounds/table_checks.hpp"
#include "bounds/table_strata.hpp"
#include "results/digits.hpp"

namespace {

using namespace earthtop;
using namespace earthtop::testing;

struct Row {
  int scenes = 0, reliable = 0, beyond = 0, close = 0;
  double worst = 0;
  std::vector<double> drift_ratios, state_ratios, tip_ratios;  ///< bound divided by error
};

void include(const Coverage& coverage, Row& row) {
  ++row.scenes;
  row.reliable += coverage.verdict.verdict == Verdict::reliable;
  row.beyond += !(coverage.used <= 1);
  row.close += coverage.close();
  row.worst = std::max(row.worst, coverage.used);
  const auto ratio = [](const BoundedError& e, std::vector<double>& ratios) {
    if (e.error > 0) ratios.push_back(e.bound / e.error);
  };
  ratio(coverage.attitude, row.drift_ratios), ratio(coverage.states, row.state_ratios);
  ratio(coverage.tip, row.tip_ratios);
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void print(std::string_view name, const Row& row) {
  fmt::print("| {} | {} | {} | {} | {:.2g} | {:.1f} % | {:.2g}, {:.2g}, {:.2g} |\n", name, row.scenes, row.reliable, row.beyond,
             row.worst, row.scenes > 0 ? 100.0 * row.close / row.scenes : 100, median(row.drift_ratios),
             median(row.state_ratios), median(row.tip_ratios));
}

void print_scene(std::string_view stratum, const Scenario& scenario, const Coverage& c) {
  fmt::print(
      "{:24} {:14} {:13} {:7.1e} {:11} {:9.3g} drift {:.2e} axis {:.1e} of {:.1e}, attitude {:.1e} of {:.1e}, attitudes "
      "themselves {:.1e} of {:.1e}, tip {:.1e} of {:.1e}, event {:.1e} of {:.1e}, used {:.2g}{}\n",
      stratum, scenario.name, to_string(c.method), scenario.numerics.relative_tolerance, to_string(c.verdict.verdict),
      Scene(scenario).fastest_rate_rad_s() * scenario.duration_s, c.drift, c.axis.error, c.axis.bound, c.attitude.error,
      c.attitude.bound, c.states.error, c.states.bound, c.tip.error, c.tip.bound, c.event.error, c.event.bound, c.used,
      c.close() ? "" : " LOOSE");
}

std::string decimal(float128 number) { return digits(number, Precision::bits113); }

/// Writes tests/data/contact/bounds.json: scenes on a table, and their drifts in 113 bits.
void write_truths(std::uint64_t count, double longest_s, double largest_phase) {
  constexpr std::uint64_t kFirst = 1000;  // scenes that no survey has
  fmt::print(
      "{{\n \"generator\": \"earthtop-bound-coverage --on-table {} {} {} --truth: in inertial axes, relative tolerance 1e-22; "
      "drift of axis and "
      "attitude (rad), of the tip toward East and North of the table (m)\",\n \"precision\": \"float128\",\n \"scenes\": [",
      count, longest_s, largest_phase);
  bool first = true;
  for (const Stratum& stratum : table_strata())
    for (std::uint64_t i = 0; i < count; ++i) {
      const Scenario scenario = random_scene_on_table(stratum, kFirst + i, longest_s, largest_phase);
      const TrueRun truth = truth_on_table(scenario, true);
      fmt::print("{}\n  {{\"scenario\": {},\n   \"rows\": [", first ? "" : ",", canonical_json(scenario));
      first = false;
      for (std::size_t k = 0; k < truth.rows.size(); ++k) {
        const ExtendedDriftRow& row = truth.rows[k];
        fmt::print("{}\n    [\"{}\", \"{}\", \"{}\", \"{}\"]", k == 0 ? "" : ",", decimal(row.drift_axis_rad),
                   decimal(row.drift_attitude_rad), decimal(row.contact->drift_tip_xy_m[0]),
                   decimal(row.contact->drift_tip_xy_m[1]));
      }
      fmt::print("]}}");
    }
  fmt::print("\n ]\n}}\n");
}

/// Prints what a check finds in each scene on a table. @param check  returns a line, and whether the scene is as it should be
template <class Check>
void check_on_table(std::uint64_t count, double longest_s, double largest_phase, std::string_view only, const Check& check) {
  int scenes = 0, failed = 0;
  for (const Stratum& stratum : table_strata())
    for (std::uint64_t i = 0; i < count; ++i) {
      const Scenario scenario = random_scene_on_table(stratum, i, longest_s, largest_phase);
      if (!only.empty() && scenario.name != only) continue;
      try {
        const auto [line, right] = check(scenario);
        ++scenes, failed += !right;
        fmt::print("{:20} {:14} {}{}\n", stratum.name, scenario.name, line, right ? "" : " !");
      } catch (const std::exception& error) {
        fmt::print("{:20} {:14} {}\n", stratum.name, scenario.name, error.what());
      }
    }
  fmt::print("{} scenes, {} not as they should be\n", scenes, failed);
}

std::pair<std::string, bool> agreement_line(const Scenario& scenario) {
  const Agreement a = agreement(scenario);
  return {
      fmt::format("{} rows, share of the bound: axis {:.2g}, attitude {:.2g}, tip {:.2g}", a.rows, a.axis, a.attitude, a.tip),
      a.largest() <= 1};
}

std::pair<std::string, bool> growth_line(const Scenario& scenario) {
  if (scenario.contact->law == ContactLaw::coulomb && scenario.contact->regularisation_m_s == 0) return {"not followed", true};
  const GrowthCheck check = growth_check(scenario);
  const ContactGrowth& g = check.estimate;
  // A change of the start changes the slip as well, which the estimate leaves.
  constexpr double kLeft = 2.2;
  return {
      fmt::format("l {:+.3f} to {:.3g} s: growth {:.3g} ({:.2g} of the path), followed {:.3g} ({:.2g}); {}",
                  scenario.body.center_of_mass_m[2], g.end_s, g.largest, g.largest_ratio, check.largest, check.largest_ratio,
                  g.exponential_s ? fmt::format("exponential from {:.3g} s", *g.exponential_s) : "regular"),
      check.largest <= kLeft * g.largest && g.completed};
}

}  // namespace

int main(int argc, char** argv) {
  std::setvbuf(stdout, nullptr, _IOLBF, 1 << 12);  // a survey takes minutes
  bool scenes = false, by_hand = false, survey = false, on_table = false, json = false, agree = false, grow = false,
       truth = false;
  std::string only, word;
  std::vector<double> numbers;
  for (int i = 1; i < argc; ++i) {
    if (std::strncmp(argv[i], "random-", 7) == 0 || std::strncmp(argv[i], "by-hand-", 8) == 0 ||
        std::strncmp(argv[i], "on-table-", 9) == 0 || std::strncmp(argv[i], "survey-", 7) == 0)
      only = argv[i];
    else if (std::strncmp(argv[i], "--only=", 7) == 0)
      word = argv[i] + 7;
    else if (std::strcmp(argv[i], "--survey") == 0)
      survey = true;
    else if (std::strcmp(argv[i], "--scenes") == 0)
      scenes = true;
    else if (std::strcmp(argv[i], "--by-hand") == 0)
      by_hand = true;
    else if (std::strcmp(argv[i], "--agreement") == 0)
      agree = true;
    else if (std::strcmp(argv[i], "--truth") == 0)
      truth = true;
    else if (std::strcmp(argv[i], "--growth") == 0)
      grow = true;
    else if (std::strcmp(argv[i], "--json") == 0)
      json = true;
    else if (std::strcmp(argv[i], "--on-table") == 0)
      on_table = true;
    else
      numbers.push_back(std::atof(argv[i]));
  }
  const auto count = static_cast<std::uint64_t>(!numbers.empty() ? numbers[0] : on_table ? 30 : 46);
  const bool given = numbers.size() > 2;
  const double least = given ? numbers[1] : on_table ? 20 : 3, largest = given ? numbers[2] : 1500;
  if (truth) return write_truths(count, least, largest), 0;
  if (agree) return check_on_table(count, least, largest, only, agreement_line), 0;
  if (grow) return check_on_table(count, least, largest, only, growth_line), 0;
  std::vector<std::pair<std::string, Row>> table;
  std::map<std::string, int> verdicts, methods;
  Row all;
  int failed = 0;
  const auto first = static_cast<std::uint64_t>(numbers.size() > 3 ? numbers[3] : 0);
  for (const Stratum& stratum : on_table ? table_strata() : strata()) {
    if (stratum.name.find(word) == std::string_view::npos) continue;
    for (std::uint64_t i = first; i < first + count; ++i) {
      const bool long_run = !by_hand && stratum.name == "long horizon";
      const auto make = on_table  ? random_scene_on_table
                        : by_hand ? random_scene_by_hand
                        : survey  ? random_survey_scene
                                  : random_scene_of;
      const Scenario scenario = make(stratum, i, long_run ? 2e4 : least, long_run ? 1e6 : largest);
      if (!only.empty() && scenario.name != only) continue;
      if (json) {
        fmt::print("{}\n", canonical_json(scenario));
        continue;
      }
      const std::string name(by_hand ? to_string(scenario.numerics.method) : stratum.name);
      auto row = std::find_if(table.begin(), table.end(), [&](const auto& entry) { return entry.first == name; });
      if (row == table.end()) row = table.insert(row, {name, {}});
      try {
        const Coverage c = bound_coverage(scenario, by_hand || survey ? Truth::bits64 : Truth::bits113);
        include(c, row->second);
        include(c, all);
        ++verdicts[std::string(to_string(c.verdict.verdict))];
        ++methods[std::string(to_string(c.method))];
        if (scenes || !(c.used <= 0.5)) print_scene(stratum.name, scenario, c);
        if (!(c.used <= 1)) fmt::print("beyond its bound: {}\n", canonical_json(scenario));
      } catch (const std::exception& error) {
        ++failed;
        fmt::print(stderr, "{}: {}\n", scenario.name, error.what());
      }
    }
  }
  if (json) return 0;
  fmt::print(
      "| {} | scenes | reliable | beyond the bound | largest error / bound | bound within 100 times | median bound / error: "
      "drift, "
      "attitudes, tip |\n",
      by_hand ? "method" : "stratum");
  fmt::print("| --- | ---: | ---: | ---: | ---: | ---: | ---: |\n");
  for (const auto& [name, row] : table) print(name, row);
  print("all", all);
  fmt::print("\nverdicts:");
  for (const auto& [verdict, number] : verdicts) fmt::print(" {} {}", verdict, number);
  fmt::print("\nmethods:");
  for (const auto& [method, number] : methods) fmt::print(" {} {}", method, number);
  fmt::print("\nnot completed: {}\n", failed);
}
