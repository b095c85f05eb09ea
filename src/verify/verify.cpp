// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/verify/verify.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <ctime>
#include <limits>
#include <numeric>
#include <set>

#include "text/number_words.hpp"
#include "verify/judge.hpp"

namespace earthtop {
namespace {

using namespace verify_detail;

const Kind& kind_of(const CriterionSpec& criterion) {
  for (const Kind& kind : kKinds)
    if (kind.kind == criterion.kind) return kind;
  throw std::logic_error("a criterion of no kind");
}

/// Approximate number of runs of a scene when all methods must give exactly zero.
constexpr double kApproximateMethodCount = 8;

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void judge(const CriterionSpec& criterion, Runs& runs, VerificationRow& row) {
  const double start = processor_seconds();
  try {
    row.error = kind_of(criterion).error(criterion, runs);
    if (!std::isfinite(row.error)) row.remark = "the error is not a finite number";
  } catch (const NotJudged& reason) {
    row.error = std::numeric_limits<double>::infinity();
    row.remark = reason.what();
  }
  row.outcome = row.error <= row.bound ? VerificationOutcome::passed : VerificationOutcome::failed;  // NaN fails
  row.seconds = processor_seconds() - start;
}

/// The work of each criterion. A run that several criteria share is counted for the first of them.
std::vector<double> work_of(const std::vector<CriterionSpec>& criteria, const Runs& runs, const VerificationOptions& options) {
  std::vector<double> all;
  std::set<Changes> known;
  for (const CriterionSpec& criterion : criteria) {
    double& work = all.emplace_back(0);
    const RunsTaken takes = kind_of(criterion).takes;
    if (takes == RunsTaken::none || (criterion.slow && !options.slow)) continue;
    if (takes == RunsTaken::its_own) {
      work = order_work(criterion, runs);
      continue;
    }
    if (known.insert(criterion.set).second) work += runs.scene(criterion.set).estimate().seconds.all();
    if (takes == RunsTaken::that_and_unchanged && known.insert(Changes()).second) work += runs.scene().estimate().seconds.all();
    if (takes == RunsTaken::all_methods) work *= kApproximateMethodCount;
  }
  return all;
}

}  // namespace

double verification_work(const ScenarioSource& source, const VerificationOptions& options) {
  const Runs runs(source);
  const std::vector<double> work = work_of(parse_verifiable(source).criteria, runs, options);
  return std::accumulate(work.begin(), work.end(), 0.0);
}

std::string criterion_text(const CriterionSpec& criterion) {
  std::string words(kind_of(criterion).word);
  if (!criterion.quantity.empty()) words += " " + criterion.quantity;
  if (criterion.at_s) words += " at " + time_text(*criterion.at_s);
  if (criterion.until_s) words += " until " + time_text(*criterion.until_s);
  if (!criterion.set.empty()) words += fmt::format(" [{}]", fmt::join(criterion.set, ", "));
  return words;
}

Scenario parse_verifiable(const ScenarioSource& source) {
  const Runs runs(source);
  Scenario scenario = runs.scene().scenario();
  if (scenario.criteria.empty())
    throw ScenarioError({{0, 0, "/criteria", "is missing: there is nothing to verify"}}, source.file);
  for (std::size_t i = 0; i < scenario.criteria.size(); ++i) {
    if (kind_of(scenario.criteria[i]).takes == RunsTaken::none) continue;
    try {
      runs.scene(scenario.criteria[i].set);
    } catch (const ScenarioError& error) {
      std::vector<Diagnostic> diagnostics;
      for (const Diagnostic& d : error.diagnostics())
        diagnostics.push_back(
            {0, 0, fmt::format("/criteria/{}/set", i), fmt::format("makes a scenario in which {} {}", d.pointer, d.message)});
      throw ScenarioError(std::move(diagnostics), source.file);
    }
  }
  return scenario;
}

void verify(const ScenarioSource& source, const VerificationOptions& options,
            const std::function<void(const VerificationRow&)>& tell) {
  Runs runs(source);
  const Scenario scenario = parse_verifiable(source);
  const std::vector<double> work = work_of(scenario.criteria, runs, options);
  Parts parts(options.watch, std::accumulate(work.begin(), work.end(), 0.0));
  std::size_t number = 0;
  for (const CriterionSpec& criterion : scenario.criteria) {
    const Watch watch = parts.next(work[number++]);
    VerificationRow row{scenario.name, criterion_text(criterion), criterion.why, {}, 0, criterion.tolerance.value_or(0), 0, ""};
    if (criterion.slow && !options.slow) {
      row.outcome = VerificationOutcome::skipped;
      row.remark = "slow";
    } else {
      runs.set_watch(watch);
      judge(criterion, runs, row);
      if (watch.asks_to_stop()) return;
    }
    tell(row);
  }
}

}  // namespace earthtop
