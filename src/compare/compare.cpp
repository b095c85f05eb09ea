// Paths to pairs, and pairs to verdicts.
#include "earthtop/compare/compare.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "compare/cost.hpp"
#include "compare/figures.hpp"
#include "compare/hints.hpp"
#include "compare/rows.hpp"
#include "compare/scenario_changes.hpp"
#include "compare/stores.hpp"
#include "earthtop/error.hpp"
#include "earthtop/scenario/scenario.hpp"

namespace earthtop {
namespace compare {
namespace {

/// Another scenario is told of, whatever else agrees.
void compare_scenarios(const Comparand& reference, const Comparand& candidate, const CompareOptions& options,
                       PairReport& report) {
  if (!reference.summary.is_object() || !candidate.summary.is_object()) return;
  const std::string before = reference.word("/provenance/scenario_sha256"), now = candidate.word("/provenance/scenario_sha256");
  if (before == now && !before.empty()) return;
  const auto scenario_of = [](const Comparand& side) { return side.summary.value("scenario", Json()); };
  std::string allowed, forbidden;
  for (const ScenarioChange& change : scenario_changes(scenario_of(reference), scenario_of(candidate))) {
    std::string& list = is_below(change.pointer, options.may_change) ? allowed : forbidden;
    list += fmt::format("{}{}: {} in the reference, {} now", list.empty() ? "" : "; ", change.pointer, change.reference,
                        change.candidate);
  }
  // A hash that differs though no key does is of words about the scene, or of a changed file.
  if (allowed.empty() && forbidden.empty() && reference.has_some_rows_only) return;
  if (allowed.empty() && forbidden.empty() && !is_below("/title", options.may_change))
    forbidden = fmt::format("scenario hash {:.12} in the reference, {:.12} now: name, title, purpose, headline or criteria",
                            before, now);
  if (!forbidden.empty()) report.findings.push_back({"other scenario", forbidden});
  if (!allowed.empty()) report.notes.push_back("other scenario, as allowed: " + allowed);
}

/// The time up to which both verdicts trust their run; none where they trust it to the end.
std::optional<double> trusted_until(const Comparand& reference, const Comparand& candidate) {
  std::optional<double> until;
  for (const Comparand* side : {&reference, &candidate}) {
    const std::string verdict = side->word("/drift/verdict");
    if (verdict == "reliable" || verdict == "noise_floor" || verdict.empty()) continue;
    if (const auto time = side->number("/drift/reliable/until_s")) until = std::min(until.value_or(*time), *time);
  }
  return until;
}

void append(RowsComparison&& rows, PairReport& report) {
  for (QuantityVerdict& quantity : rows.quantities) report.quantities.push_back(std::move(quantity));
  report.findings.insert(report.findings.end(), rows.findings.begin(), rows.findings.end());
  report.notes.insert(report.notes.end(), rows.notes.begin(), rows.notes.end());
}

/// The fastest rate of the scene's motion; 0 where it is not known.
double natural_rate(const Comparand& side) {
  if (!side.summary.is_object() || !side.summary.contains("scenario")) return 0;
  const ScenarioReport report = examine_scenario({"", side.summary.at("scenario").dump(), false});
  return report.scenario ? fastest_rate_rad_s(*report.scenario) : 0;
}

/// Sum of both sides' error bounds on the attitudes, where both are known.
void find_attitude_errors(const Comparand& reference, const Comparand& candidate, RowsContext& context) {
  context.attitude_errors_known = true;
  for (const Comparand* side : {&reference, &candidate}) {
    const auto error = side->summary.is_object() ? side->number("/attitude_bound_rad") : side->attitude_error_rad;
    context.attitude_errors_known = context.attitude_errors_known && error;
    context.attitude_errors_rad += error.value_or(0);
  }
}

void compare_runs(const Comparand& reference, const Comparand& candidate, const CompareOptions& options, PairReport& report) {
  compare_scenarios(reference, candidate, options, report);
  RowsContext context;
  find_attitude_errors(reference, candidate, context);
  context.natural_rate_rad_s = std::max(natural_rate(reference), natural_rate(candidate));
  context.until_s = trusted_until(reference, candidate);
  context.same_scenario = report.findings.empty() && reference.summary.is_object() && candidate.summary.is_object() &&
                          reference.word("/provenance/scenario_sha256") == candidate.word("/provenance/scenario_sha256");
  context.same_computation = context.same_scenario && !context.until_s;
  if (context.until_s && options.tolerances.profile != Profile::bitwise) report.until_s = context.until_s;
  RowsComparison rows = compare_rows(reference, candidate, context, options);
  report.rows = rows.rows;
  const bool differs =
      std::any_of(rows.quantities.begin(), rows.quantities.end(), [](const QuantityVerdict& q) { return !q.passed; });
  if (differs) report.hints = hints(rows.seen);
  append(std::move(rows), report);
  if (reference.open_torques && candidate.open_torques)
    append(compare_torques(reference, candidate, context, options), report);
  else if (reference.open_torques)
    report.findings.push_back({"missing file", "torques.csv is missing in the new result"});
  if (reference.summary.is_object() && candidate.summary.is_object()) {
    const Json::json_pointer motion("/scenario/motion");
    const bool same_rows = reference.summary.value(motion, Json()) == candidate.summary.value(motion, Json());
    for (QuantityVerdict& figure :
         compare_figures(reference, candidate, {context.same_computation, !context.until_s, same_rows}, options))
      report.quantities.push_back(std::move(figure));
    if (!same_rows) report.notes.emplace_back("not compared: largest values and means of the rows, which are others now");
  }
  report.cost = compare_cost(reference, candidate, options.tolerances);
}

PairReport compare_pair(const fs::path& reference, const fs::path& candidate, const std::string& name, const Mapping* mapping,
                        const CompareOptions& options) {
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
  if (old_kind == ComparandKind::store)
    compare_stores(reference, candidate, options, report);
  else if (mapping && old_kind != ComparandKind::csv && new_kind != ComparandKind::csv)
    throw ScenarioError("", "--mapping says what the columns of a CSV file mean, but none of the two is one");
  else
    compare_runs(open_comparand(reference, mapping), open_comparand(candidate, mapping), options, report);
  return report;
}

/// Everything in two directories, by name.
void compare_collections(const fs::path& reference, const fs::path& candidate, const Mapping* mapping,
                         const CompareOptions& options, CompareReport& report) {
  const auto old_members = members(reference), new_members = members(candidate);
  const auto find = [](const auto& list, const std::string& name) {
    return std::find_if(list.begin(), list.end(), [&](const auto& member) { return member.first == name; });
  };
  for (const auto& [name, path] : old_members) {
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
        pair = compare_pair(path, now->second, name, mapping, options);
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

CompareReport compare_results(const std::filesystem::path& reference, const std::filesystem::path& candidate,
                              const CompareOptions& options) {
  using namespace compare;
  CompareReport report;
  report.reference = reference.string();
  report.candidate = candidate.string();
  report.profile = options.tolerances.profile;
  report.tolerances_file = options.tolerances.file;
  std::optional<Mapping> mapping;
  if (!options.mapping.empty()) mapping = read_mapping(options.mapping);
  const Mapping* given = mapping ? &*mapping : nullptr;
  if (kind_of(reference) == ComparandKind::collection && kind_of(candidate) == ComparandKind::collection)
    compare_collections(reference, candidate, given, options, report);
  else
    report.pairs.push_back(compare_pair(reference, candidate, "", given, options));
  return report;
}

}  // namespace earthtop
