// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the pairs of results at two paths, and compares each pair.
#include "earthtop/compare/compare.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <initializer_list>
#include <nlohmann/json.hpp>

#include "compare/common_end.hpp"
#include "compare/cost.hpp"
#include "compare/diagnosis.hpp"
#include "compare/figures.hpp"
#include "compare/hints.hpp"
#include "compare/replacement.hpp"
#include "compare/rows.hpp"
#include "compare/scenario_changes.hpp"
#include "compare/snapshot.hpp"
#include "compare/stores.hpp"
#include "compare/trust.hpp"
#include "earthtop/error.hpp"
#include "earthtop/scene/scene.hpp"
#include "results/seal.hpp"
#include "text/json.hpp"

namespace earthtop {
namespace compare {
namespace {

constexpr std::size_t kMaxListedPoints = 20;
// Each result's time of trust must be at least this share of the other's (chosen by judgement). For the same scenario the two
// differ by rounding, which changes the time little; other numerics may begin with errors that are millions of times larger.
constexpr double kSameTrust = 0.9, kOtherTrust = 0.1;

std::string listed(const std::vector<ScenarioChange>& changes) {
  std::string text;
  for (std::size_t i = 0; i < std::min(changes.size(), kMaxListedPoints); ++i)
    text += fmt::format("{}{}: {} in the reference, {} now", i == 0 ? "" : "; ", changes[i].pointer, changes[i].reference,
                        changes[i].candidate);
  return changes.size() > kMaxListedPoints ? text + fmt::format("; and {} more", changes.size() - kMaxListedPoints) : text;
}

/// Reports a difference of the scenarios, whatever else agrees.
void compare_scenarios(const Comparand& reference, const Comparand& candidate, const CompareOptions& options,
                       PairReport& report) {
  if (!reference.has_summary() || !candidate.has_summary()) return;
  const std::string before = reference.word("/provenance/scenario_sha256"), now = candidate.word("/provenance/scenario_sha256");
  const bool same_hash = before == now && !before.empty();
  for (const std::string& pointer : options.may_change) {
    const Json::json_pointer key("/scenario" + (pointer == "/" ? "" : pointer));
    if (pointer != "/name" && !reference.summary->contains(key) && !candidate.summary->contains(key))
      report.notes.push_back(fmt::format("--allow-change {}: neither scenario has such a key", pointer));
  }
  std::vector<ScenarioChange> allowed, forbidden;
  for (ScenarioChange& change :
       scenario_changes(reference.summary->value("scenario", Json()), candidate.summary->value("scenario", Json())))
    (!same_hash && is_below(change.pointer, options.may_change) ? allowed : forbidden).push_back(std::move(change));
  if (same_hash && !forbidden.empty()) {
    report.findings.push_back({"other scenario", "the scenarios do not match their hash: " + listed(forbidden)});
    return;
  }
  if (same_hash) return;
  if (before.empty() || now.empty())
    report.findings.push_back(
        {"other scenario", fmt::format("the {} has no scenario hash", before.empty() ? "reference" : "new result")});
  // If the hashes differ though no key does, the name differs, which is no key of the summary's scenario, or an older version
  // made one of the hashes. A compact reference may have been written under another name.
  const std::string old_name = reference.word("/name"), new_name = candidate.word("/name");
  const bool no_key_differs = allowed.empty() && forbidden.empty() && !before.empty() && !now.empty();
  if (no_key_differs && !reference.has_some_rows_only && !is_below("/name", options.may_change))
    report.findings.push_back(
        {"other scenario",
         old_name != new_name
             ? fmt::format("the name is \"{}\" in the reference, \"{}\" now (--allow-change /name allows it)", old_name,
                           new_name)
             : fmt::format("scenario hash {:.12} in the reference, {:.12} now, though no key differs: an older version made "
                           "one of them (--allow-change / allows it)",
                           before, now)});
  if (!forbidden.empty()) report.findings.push_back({"other scenario", listed(forbidden)});
  if (!allowed.empty()) report.notes.push_back("other scenario, as allowed: " + listed(allowed));
}

void append(RowsComparison&& rows, PairReport& report) {
  for (QuantityVerdict& quantity : rows.quantities) report.quantities.push_back(std::move(quantity));
  report.findings.insert(report.findings.end(), rows.findings.begin(), rows.findings.end());
  report.notes.insert(report.notes.end(), rows.notes.begin(), rows.notes.end());
}

/// The fastest rate of the scene's motion; 0 where it is not known.
double natural_rate(const Comparand& side) {
  const std::optional<Scene> scene = scene_of(side);
  return scene ? scene->fastest_rate_rad_s() : 0;
}

/// Finds the sum of both sides' error bounds on the attitudes, where both are known.
void find_attitude_errors(const Comparand& reference, const Comparand& candidate, RowsContext& context) {
  context.attitude_errors_known = true;
  for (const Comparand* side : {&reference, &candidate}) {
    const auto error = side->has_summary() ? side->number("/attitude_bound_rad") : side->attitude_error_rad;
    context.attitude_errors_known = context.attitude_errors_known && error;
    context.attitude_errors_rad += error.value_or(0);
  }
}

/// Refuses the partial results of an interrupted run: their rows have no error bounds and no verdict.
void require_assessed(const Comparand& side) {
  if (side.word("/outcome/status") == to_string(RunStatus::interrupted))
    refuse_file(side.path,
                "is a partial result: its run was interrupted before it had error bounds and a verdict, and nothing can be "
                "judged without them; run the scenario again");
}

/// Says which figures were left out, and why.
void note_left_out(PairReport& report) {
  std::vector<std::string_view> told;
  for (const LeftOut& first : report.left_out) {
    if (std::find(told.begin(), told.end(), first.why) != told.end()) continue;
    told.push_back(first.why);
    std::string names;
    for (const LeftOut& one : report.left_out)
      if (one.why == first.why) names += (names.empty() ? "" : ", ") + one.name;
    report.notes.push_back(fmt::format("not compared: {}: {}", names, first.why));
  }
}

/// Compares the figures of two runs' summaries.
void compare_summaries(const Comparand& reference, const Comparand& candidate, const RowsContext& rows, const LongerRun* longer,
                       const CompareOptions& options, PairReport& report) {
  FigureContext context;
  context.same_computation = rows.same_computation;
  context.whole_run = !magnifies_rounding(reference) && !magnifies_rounding(candidate);
  context.end_trusted = rows.trust.at(candidate.number("/outcome/reached_s").value_or(0));
  const Json::json_pointer motion("/scenario/motion");
  context.same_rows = reference.summary->value(motion, Json()) == candidate.summary->value(motion, Json());
  const Json::json_pointer largest("/drift/axis_max_at_s");  // null where there is no drift
  context.both_of_motion = reference.summary->contains(largest) && candidate.summary->contains(largest);
  context.longer = longer;
  FiguresComparison figures = compare_figures(reference, candidate, context, options);
  for (QuantityVerdict& figure : figures.quantities) report.quantities.push_back(std::move(figure));
  report.left_out = std::move(figures.left_out);
  note_left_out(report);
  if (longer) return;
  if (!context.same_rows) report.notes.emplace_back("not compared: means over the rows, since the rows are different now");
  if (!context.both_of_motion)
    report.notes.emplace_back(
        "not compared: largest values, swings and turns seen, since one of the results is of an older version, which took them "
        "from its rows");
}

/// @param longer  for runs of unlike lengths, of which one side is its `comparand`; else null
void compare_up_to_end(const Comparand& reference, const Comparand& candidate, const LongerRun* longer, const Mapping* mapping,
                       const CompareOptions& options, PairReport& report) {
  RowsContext context;
  find_attitude_errors(reference, candidate, context);
  context.natural_rate_rad_s = std::max(natural_rate(reference), natural_rate(candidate));
  context.both_runs = reference.has_summary() && candidate.has_summary();
  context.is_file = !candidate.has_summary();
  context.same_scenario = report.findings.empty() && context.both_runs &&
                          reference.word("/provenance/scenario_sha256") == candidate.word("/provenance/scenario_sha256");
  if (longer) context.end_s = longer->end.t_s;
  if (context.both_runs) {
    const double end_s = context.end_s.value_or(reference.number("/outcome/reached_s").value_or(0));
    context.trust = common_trust(reference, candidate, end_s, context.same_scenario ? kSameTrust : kOtherTrust);
    if (!context.trust.fault.empty()) report.findings.push_back({"other verdict", context.trust.fault});
  }
  context.same_computation = context.same_scenario && !magnifies_rounding(reference) && !magnifies_rounding(candidate);
  if (options.tolerances.profile != Profile::bitwise) report.until_s = context.trust.until_s();
  RowsComparison rows;
  try {
    rows = compare_rows(reference, candidate, context, options);
  } catch (const ScenarioError& refusal) {
    // Times in another unit lie where the reference tells nothing.
    if (!context.is_file) throw;
    report.hints = other_time_unit(reference, candidate, mapping ? *mapping : Mapping(), options);
    if (report.hints.empty()) throw;
    report.findings.push_back({"other times", refusal.what()});
    return;
  }
  report.rows = rows.rows;
  report.span = rows.span;
  const bool differs =
      std::any_of(rows.quantities.begin(), rows.quantities.end(), [](const QuantityVerdict& q) { return !q.passed; });
  const bool misses = std::any_of(rows.findings.begin(), rows.findings.end(), [](const CompareFinding& finding) {
    return finding.kind == "extra rows" || finding.kind == "part of the time";
  });
  if (differs || (context.is_file && misses))
    report.hints = diagnose(reference, candidate, mapping ? *mapping : Mapping(), rows, options);
  if (differs)
    for (std::string& hint : hints(rows.seen)) report.hints.push_back(std::move(hint));
  append(std::move(rows), report);
  if (reference.open_torques && candidate.open_torques)
    append(compare_torques(reference, candidate, context, options), report);
  else if (reference.open_torques)
    report.findings.push_back({"missing file", "torques.csv is missing in the new result"});
  else if (candidate.open_torques && context.both_runs && !reference.has_some_rows_only)
    report.findings.push_back({"extra file", "torques.csv is missing in the reference"});
  if (context.both_runs) compare_summaries(reference, candidate, context, longer, options, report);
}

void compare_runs(const Comparand& reference, const Comparand& candidate, const Mapping* mapping, const CompareOptions& options,
                  PairReport& report) {
  require_assessed(reference);
  require_assessed(candidate);
  if (options.until_s && candidate.has_summary())
    throw ScenarioError("",
                        "--until belongs to a CSV file; two results are compared to their common end, where --allow-change "
                        "/motion/duration_s allows unlike lengths");
  compare_scenarios(reference, candidate, options, report);
  const std::optional<LongerRun> longer = find_common_end(reference, candidate, options);
  if (longer) report.common_end = longer->end;
  const bool reference_goes_on = longer && longer->end.reference_goes_on;
  compare_up_to_end(reference_goes_on ? longer->comparand : reference,
                    longer && !reference_goes_on ? longer->comparand : candidate, longer ? &*longer : nullptr, mapping, options,
                    report);
  options.watch.reach(1);
  report.cost = compare_cost(reference, candidate, options.tolerances, report.findings);
}

/// Compares two results. @throws ScenarioError, also where a summary's content is not that of a summary
PairReport compare_pair(const fs::path& reference, const fs::path& candidate, const std::string& name, const Mapping* mapping,
                        const CompareOptions& options) try {
  PairReport report;
  report.name = name;
  report.reference = reference.string();
  report.candidate = candidate.string();
  const ComparandKind old_kind = kind_of(reference), new_kind = kind_of(candidate);
  if ((old_kind == ComparandKind::store) != (new_kind == ComparandKind::store) || old_kind == ComparandKind::collection ||
      new_kind == ComparandKind::collection)
    throw ScenarioError("",
                        fmt::format("{} and {} are of different kinds: give two results, two directories of results, or two "
                                    "study stores",
                                    printable(report.reference), printable(report.candidate)));
  const bool has_limit = options.tolerances.steps_ratio || options.tolerances.seconds_ratio;
  if (has_limit && (old_kind == ComparandKind::store || old_kind == ComparandKind::csv || new_kind == ComparandKind::csv))
    throw ScenarioError("", "a limit on the cost needs results of `run` on both sides, since only these state their cost");
  if (options.until_s && (old_kind == ComparandKind::store || new_kind == ComparandKind::store))
    throw ScenarioError("", "--until belongs to a CSV file; studies have no rows over time");
  if (old_kind == ComparandKind::store)
    compare_stores(reference, candidate, options, report);
  else if (mapping && old_kind != ComparandKind::csv && new_kind != ComparandKind::csv)
    throw ScenarioError("", "--mapping says what the columns of a CSV file mean, but neither of the two is a CSV file");
  else {
    const Comparand sides[] = {open_comparand(reference, mapping), open_comparand(candidate, mapping)};
    compare_runs(sides[0], sides[1], mapping, options, report);
    for (const Comparand& side : sides)
      for (const fs::path& path : side.unverified) report.unverified.push_back(unverified(path));
  }
  return report;
} catch (const Json::exception& error) {
  throw ScenarioError(
      "", fmt::format("{} or {}: a JSON file in it is not in the form that this program writes; write it again ({})",
                      printable(reference.string()), printable(candidate.string()), complaint_of(error)));
}

void require_distinct(const fs::path& directory, const std::vector<std::pair<std::string, fs::path>>& list) {
  for (std::size_t i = 1; i < list.size(); ++i)
    if (list[i].first == list[i - 1].first)
      refuse_file(directory, fmt::format("holds \"{}\" twice, as {} and as {}; remove one of them", list[i].first,
                                         list[i - 1].second.filename().string(), list[i].second.filename().string()));
}

/// The amount to read of a member (bytes), for the progress: its rows, and a constant for its other files.
double bytes_of(const fs::path& member) {
  constexpr double kOthers = 1e5;
  std::error_code error;
  const fs::path rows = fs::is_directory(member, error) ? member / "trajectory.csv" : member;
  const auto size = fs::file_size(rows, error);
  return kOthers + (error ? 0 : static_cast<double>(size));
}

/// Notes the seals, which are replaced last or alone, of results and compact references. A store has none: reading it is safe while a study goes on.
void note_seals(std::initializer_list<fs::path> members, FileIdentities& seals) {
  for (const fs::path& member : members) {
    const fs::path summary = member / "summary.json";
    if (is_there(summary))
      seals.emplace_back(summary, identity_of(summary));
    else if (member.extension() == ".json")
      seals.emplace_back(member, identity_of(member));
  }
}

/// Compares all results in two directories, paired by name.
void compare_collections(const fs::path& reference, const fs::path& candidate, const Mapping* mapping,
                         const CompareOptions& options, CompareReport& report, FileIdentities& seals) {
  const auto old_members = members(reference), new_members = members(candidate);
  for (const auto* list : {&old_members, &new_members})
    for (const auto& member : *list) note_seals({member.second}, seals);
  require_distinct(reference, old_members);
  require_distinct(candidate, new_members);
  const auto find = [](const auto& list, const std::string& name) {
    return std::find_if(list.begin(), list.end(), [&](const auto& member) { return member.first == name; });
  };
  double bytes = 0;
  for (const auto& member : old_members) bytes += bytes_of(member.second);
  Parts parts(options.watch, bytes);
  CompareOptions of_pair = options;
  for (const auto& [name, path] : old_members) {
    of_pair.watch = parts.next(bytes_of(path));
    PairReport pair;
    pair.name = name;
    pair.reference = path.string();
    const auto now = find(new_members, name);
    if (now == new_members.end()) {
      const char* what = "the new directory has no result of this name";
      if (options.may_lack_rows)
        pair.notes.emplace_back(what);
      else
        pair.findings.push_back({"missing result", what});
    } else {
      pair.candidate = now->second.string();
      try {
        pair = compare_pair(path, now->second, name, mapping, of_pair);
      } catch (const ScenarioError& error) {
        pair.refusal = error.what();
      }
    }
    report.pairs.push_back(std::move(pair));
  }
  for (const auto& [name, path] : new_members) {
    if (find(old_members, name) != old_members.end()) continue;
    PairReport pair;
    pair.name = name;
    pair.candidate = path.string();
    pair.findings.push_back({"extra result", "the reference has no result of this name; --update adds it"});
    report.pairs.push_back(std::move(pair));
  }
}

/// Notes tolerances that no quantity used, since their names may be wrong.
void note_unused_tolerances(const Tolerances& tolerances, CompareReport& report) {
  for (const auto& entry : tolerances.rules) {
    const std::string& name = entry.first;
    const bool used = std::any_of(report.pairs.begin(), report.pairs.end(), [&](const PairReport& pair) {
      return std::any_of(pair.quantities.begin(), pair.quantities.end(),
                         [&](const QuantityVerdict& q) { return q.name == name; });
    });
    if (!used && !report.pairs.empty() && !report.refused())
      report.pairs.front().findings.push_back(
          {"unused tolerance", fmt::format("{}: no quantity with this name was compared", name)});
  }
}

CompareReport compare_once(const fs::path& reference, const fs::path& candidate, const CompareOptions& options,
                           FileIdentities& seals) {
  CompareReport report;
  report.reference = reference.string();
  report.candidate = candidate.string();
  report.profile = options.tolerances.profile;
  report.tolerances_file = options.tolerances.file;
  std::optional<Mapping> mapping;
  if (!options.mapping.empty()) mapping = read_mapping(options.mapping);
  const Mapping* given = mapping ? &*mapping : nullptr;
  if (kind_of(reference) == ComparandKind::collection && kind_of(candidate) == ComparandKind::collection)
    compare_collections(reference, candidate, given, options, report, seals);
  else {
    note_seals({reference, candidate}, seals);
    report.pairs.push_back(compare_pair(reference, candidate, "", given, options));
  }
  note_unused_tolerances(options.tolerances, report);
  return report;
}

}  // namespace
}  // namespace compare

std::string_view to_string(Change change) {
  switch (change) {
    case Change::none: return "none";
    case Change::within_errors: return "within_errors";
    case Change::above_errors: return "above_errors";
    case Change::unknown: return "unknown";
  }
  return "unknown";
}

bool PairReport::passed() const {
  return refusal.empty() && findings.empty() &&
         std::all_of(quantities.begin(), quantities.end(), [](const QuantityVerdict& quantity) { return quantity.passed; }) &&
         std::all_of(cost.begin(), cost.end(), [](const CostRatio& ratio) { return ratio.passed(); });
}

bool CompareReport::passed() const {
  return std::all_of(pairs.begin(), pairs.end(), [](const PairReport& pair) { return pair.passed(); });
}

bool CompareReport::refused() const {
  return std::any_of(pairs.begin(), pairs.end(), [](const PairReport& pair) { return !pair.refusal.empty(); });
}

std::vector<std::string> CompareReport::unverified() const {
  std::vector<std::string> sentences;
  for (const PairReport& pair : pairs)
    for (const std::string& sentence : pair.unverified)
      if (std::find(sentences.begin(), sentences.end(), sentence) == sentences.end()) sentences.push_back(sentence);
  return sentences;
}

CompareReport compare_results(const std::filesystem::path& reference, const std::filesystem::path& candidate,
                              const CompareOptions& options) {
  using namespace compare;
  constexpr int kAttempts = 4;
  for (int attempt = 1; attempt <= kAttempts; ++attempt) {
    finish_update(reference);
    finish_update(candidate);
    FileIdentities seals;
    try {
      CompareReport report = compare_once(reference, candidate, options, seals);
      if (are_current(seals)) return report;
    } catch (const ScenarioError&) {
      if (are_current(seals)) throw;
    }
  }
  throw ScenarioError("", fmt::format("{} or {} keeps being rewritten; wait until that has ended, and compare again",
                                      printable(reference.string()), printable(candidate.string())));
}

}  // namespace earthtop
