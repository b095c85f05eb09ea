// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/stores.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "compare/scenario_changes.hpp"
#include "compare/tell.hpp"
#include "compare/tolerances.hpp"
#include "earthtop/study/run_study.hpp"
#include "input/file.hpp"
#include "input/node.hpp"
#include "results/seal.hpp"
#include "study/store.hpp"

namespace earthtop::compare {
namespace {

using study::PointResult;
using study::Store;
using study::Value;

constexpr double kWithoutBounds = 1e-9;  // tolerance where no bounds were collected: part of a quantity's largest size

Store open_store(const std::filesystem::path& path) {
  Store store = Store::open(store_at(path), study::sqlite::Connection::Mode::read);
  store.check_intact();
  return store;
}

/// A value for messages, in which a word is shortened.
std::string shown(const Value& value) { return input::excerpt(study::plain_text(value)); }

std::string name_of(const PointResult& point, const Study& study) {
  std::string text = fmt::format("point {}", point.number);
  for (std::size_t i = 0; i < study.axes.size(); ++i)
    text += fmt::format("{}{} {}", i == 0 ? " (" : ", ", study.axes[i].name, shown(point.axis_values[i]));
  return study.axes.empty() ? text : text + ")";
}

/// The path in the summary of the error bound for a kind of figure.
std::string_view bound_path(FigureKind kind) {
  switch (kind) {
    case FigureKind::drift_axis: return "drift.axis_bound_rad";
    case FigureKind::drift_attitude:
    case FigureKind::drift_spin: return "drift.attitude_bound_rad";
    case FigureKind::attitude: return "attitude_bound_rad";
    default: return "";
  }
}

/// One quantity that both stores hold, with its place in each store.
struct SharedQuantity {
  std::size_t reference, candidate;
  FigureKind kind;
  Rule rule;
  std::optional<std::pair<std::size_t, std::size_t>> bounds;
  double scale = 0;
  double errors_at_largest = -1;
  QuantityVerdict verdict;
};

std::optional<std::size_t> find_path(const Study& study, std::string_view path) {
  for (std::size_t i = 0; i < study.quantities.size(); ++i)
    if (study.quantities[i].path == path) return i;
  return std::nullopt;
}

std::vector<SharedQuantity> shared_quantities(const Store& reference, const Store& candidate, const CompareOptions& options,
                                              PairReport& report) {
  std::vector<SharedQuantity> shared;
  const bool same_study = reference.sha256() == candidate.sha256();
  std::vector<std::string> not_compared;
  for (std::size_t i = 0; i < reference.study().quantities.size(); ++i) {
    const StudyQuantity& quantity = reference.study().quantities[i];
    const auto there = find_path(candidate.study(), quantity.path);
    if (!there) {
      report.findings.push_back({"missing column", fmt::format("{} is missing in the new store", quantity.name)});
      continue;
    }
    // A study may have collected a figure that is not compared between two summaries: it is compared here.
    const SummaryMember* member = find_member(quantity.path);
    const FigureKind kind = member && member->kind != FigureKind::not_compared ? member->kind : FigureKind::derived;
    const auto rule = is_compared(kind) ? rule_of(quantity.name, kind, options.tolerances, same_study) : std::nullopt;
    if (!rule) {
      not_compared.push_back(quantity.name);
      continue;
    }
    SharedQuantity one{i, *there, kind, *rule, std::nullopt, 0, -1, {}};
    const auto bound = find_path(reference.study(), bound_path(kind)),
               new_bound = find_path(candidate.study(), bound_path(kind));
    if (bound && new_bound) one.bounds = {*bound, *new_bound};
    const bool by_profile = !same_study && !options.tolerances.rules.contains(quantity.name);
    if (!one.bounds && by_profile && one.rule.bounds > 0) one.rule.relative = std::max(one.rule.relative, kWithoutBounds);
    one.verdict.name = quantity.name;
    shared.push_back(std::move(one));
  }
  if (!not_compared.empty()) report.notes.push_back(fmt::format("not compared: {}", input::listed(not_compared)));
  return shared;
}

std::optional<double> errors_of(const SharedQuantity& quantity, const PointResult& a, const PointResult& b) {
  if (!quantity.bounds) return std::nullopt;
  const auto* x = std::get_if<double>(&a.values[quantity.bounds->first]);
  const auto* y = std::get_if<double>(&b.values[quantity.bounds->second]);
  return x && y ? std::optional(*x + *y) : std::nullopt;
}

void judge(SharedQuantity& quantity, const PointResult& a, const PointResult& b, const Study& study) {
  QuantityVerdict& verdict = quantity.verdict;
  const Value &before = a.values[quantity.reference], &now = b.values[quantity.candidate];
  const auto* x = std::get_if<double>(&before);
  const auto* y = std::get_if<double>(&now);
  ++verdict.compared;
  bool passed = before == now;
  if (x && y) {
    const double turn = 2 * std::numbers::pi;
    const double found = is_angle(quantity.kind) ? std::abs(std::remainder(*x - *y, turn)) : std::abs(*x - *y);
    const auto errors = errors_of(quantity, a, b);
    const Tolerance tolerance = tolerance_of(quantity.rule, quantity.scale, quantity.scale, errors.value_or(0));
    passed = quantity.rule.times > 0 ? are_of_one_size(*x, *y, quantity.rule.times, quantity.scale)
                                     : found <= tolerance.value && std::isfinite(*x);
    const double share = tolerance.value > 0 ? found / tolerance.value : passed ? 0 : std::numeric_limits<double>::infinity();
    verdict.share = std::max(verdict.share, share);
    if (found > verdict.largest || verdict.origin.empty()) {
      verdict.largest = found;
      verdict.where = name_of(a, study);
      verdict.tolerance = tolerance.value;
      verdict.origin = tolerance.origin;
      verdict.errors = errors;
    }
    if (found > 0 && verdict.change != Change::above_errors)
      verdict.change = !errors ? Change::unknown : found > *errors ? Change::above_errors : Change::within_errors;
  } else if (!passed) {
    if (verdict.change != Change::above_errors) verdict.change = Change::unknown;
    if (verdict.reason.empty()) verdict.reason = fmt::format("\"{}\" in the reference, \"{}\" now", shown(before), shown(now));
  }
  if (!passed && verdict.violations++ == 0) verdict.first_violation = name_of(a, study);
}

void compare_points(Store& reference, Store& candidate, std::vector<SharedQuantity>& quantities, const CompareOptions& options,
                    PairReport& report) {
  const bool same_study = reference.sha256() == candidate.sha256();
  std::uint64_t missing = 0, extra = 0, moved = 0, other_scenarios = 0;
  std::string first_missing, first_extra, first_moved, first_other;
  std::map<std::string, std::uint64_t> statuses;
  Store::Points old_points = reference.points(), new_points = candidate.points();
  const auto all = static_cast<double>(std::max<std::uint64_t>(reference.count(), 1));
  PointResult a, b;
  bool has_a = old_points.next(a), has_b = new_points.next(b);
  while (has_a || has_b) {
    if (has_a && (!has_b || a.number < b.number)) {
      if (missing++ == 0) first_missing = name_of(a, reference.study());
      has_a = old_points.next(a);
    } else if (!has_a || b.number < a.number) {
      if (extra++ == 0) first_extra = name_of(b, candidate.study());
      has_b = new_points.next(b);
    } else {
      if (a.axis_values != b.axis_values && moved++ == 0) first_moved = name_of(b, candidate.study());
      if (same_study && a.scenario_sha256 != b.scenario_sha256 && other_scenarios++ == 0)
        first_other = name_of(b, candidate.study());
      if (a.status != b.status)
        ++statuses[fmt::format("{} in the reference, {} now", input::excerpt(a.status), input::excerpt(b.status))];
      if (++report.rows % 1024 == 0) tell(options.watch, static_cast<double>(report.rows) / all);
      if (!a.failed() && !b.failed())
        for (SharedQuantity& quantity : quantities) judge(quantity, a, b, reference.study());
      has_a = old_points.next(a);
      has_b = new_points.next(b);
    }
  }
  if (missing > 0 && !options.may_lack_rows)
    report.findings.push_back(
        {"missing rows", fmt::format("{} points are missing in the new store, the first one {}", missing, first_missing)});
  else if (missing > 0)
    report.notes.push_back(fmt::format("{} points are missing in the new store, which was allowed", missing));
  if (extra > 0)
    report.findings.push_back(
        {"extra rows", fmt::format("{} points are in the new store alone, the first one {}", extra, first_extra)});
  if (moved > 0)
    report.findings.push_back(
        {"other points", fmt::format("{} points have different values of the axes, the first one {}", moved, first_moved)});
  if (other_scenarios > 0)
    report.findings.push_back({"other scenario", fmt::format("{} points are of different scenarios, the first one {}",
                                                             other_scenarios, first_other)});
  for (const auto& [what, count] : statuses)
    report.findings.push_back({"other status", fmt::format("{} points: {}", count, what)});
}

}  // namespace

void compare_stores(const std::filesystem::path& reference_path, const std::filesystem::path& candidate_path,
                    const CompareOptions& options, PairReport& report) {
  Store reference = open_store(reference_path), candidate = open_store(candidate_path);
  if (reference.sha256() != candidate.sha256()) {
    const std::string what =
        fmt::format("study {} in the reference, {} now", reference.sha256().substr(0, 12), candidate.sha256().substr(0, 12));
    if (!is_below("/", options.may_change))
      report.findings.push_back(
          {"other study", what + "; axes, design, quantities or base differ (--allow-change / allows it)"});
    else
      report.notes.push_back(what + ", which was allowed");
  }
  if (!reference.has_checksums()) report.unverified.push_back(unverified(reference_path));
  if (!candidate.has_checksums()) report.unverified.push_back(unverified(candidate_path));
  std::vector<SharedQuantity> quantities = shared_quantities(reference, candidate, options, report);
  reference.for_each([&](const PointResult& point) {
    for (SharedQuantity& quantity : quantities)
      if (const auto* number = std::get_if<double>(&point.values[quantity.reference]))
        quantity.scale = std::max(quantity.scale, std::abs(*number));
  });
  compare_points(reference, candidate, quantities, options, report);
  report.span = {0, 0, reference.count(), true};
  if (report.rows == 0) report.findings.push_back({"nothing in common", "no point of the new store was compared"});
  for (SharedQuantity& quantity : quantities) {
    quantity.verdict.passed = quantity.verdict.violations == 0;
    if (quantity.verdict.origin.empty()) quantity.verdict.origin = "equal";
    report.quantities.push_back(std::move(quantity.verdict));
  }
}

}  // namespace earthtop::compare
