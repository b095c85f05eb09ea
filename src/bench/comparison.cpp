// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/bench/comparison.hpp"

#include <algorithm>

namespace earthtop {
namespace {

std::optional<double> error_in(const BenchErrors& errors, ErrorKind kind) {
  switch (kind) {
    case ErrorKind::axis: return errors.axis;
    case ErrorKind::attitude: return errors.attitude;
    case ErrorKind::drift: return errors.drift;
  }
  return std::nullopt;
}

bool same_family(const Contender& a, const Contender& b) {
  return a.workload == b.workload && a.precision == b.precision && method_name(a) == method_name(b) &&
         equations_name(a) == equations_name(b);
}

}  // namespace

std::string_view to_string(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::axis: return "axis";
    case ErrorKind::attitude: return "attitude";
    case ErrorKind::drift: return "drift";
  }
  return "unknown";
}

std::optional<double> error_of(const BenchEntry& entry, const CertifiedReference& reference, ErrorKind kind) {
  if (entry.status != RunStatus::completed) return std::nullopt;
  const std::optional<double> error = error_in(entry.errors, kind);
  if (!error) return std::nullopt;
  return std::max(*error, error_in(reference.error, kind).value_or(0));
}

std::vector<bool> pareto_front(const BenchReport& report, ErrorKind kind) {
  struct Point {
    std::size_t entry;
    double seconds, error;
  };
  std::vector<Point> points;
  for (std::size_t i = 0; i < report.entries.size(); ++i)
    if (const auto error = error_of(report.entries[i], report.reference, kind))
      points.push_back({i, report.entries[i].seconds, *error});
  std::sort(points.begin(), points.end(),
            [](const Point& a, const Point& b) { return a.seconds != b.seconds ? a.seconds < b.seconds : a.error < b.error; });
  std::vector<bool> front(report.entries.size(), false);
  const Point* last = nullptr;  // the most exact of the faster entries
  for (const Point& point : points) {
    if (last != nullptr && point.error >= last->error && !(point.error == last->error && point.seconds == last->seconds))
      continue;
    front[point.entry] = true;
    last = &point;
  }
  return front;
}

std::vector<BenchFamily> families(const BenchReport& report) {
  std::vector<BenchFamily> all;
  for (std::size_t i = 0; i < report.entries.size(); ++i) {
    const Contender& contender = report.entries[i].contender;
    const auto family =
        std::find_if(all.begin(), all.end(), [&](const BenchFamily& other) { return same_family(other.first, contender); });
    if (family == all.end())
      all.push_back({contender, {i}});
    else
      family->entries.push_back(i);
  }
  return all;
}

std::optional<FamilyCost> family_cost(const BenchReport& report, const BenchFamily& family, ErrorKind kind, double error) {
  std::vector<BenchEntry> entries;
  std::optional<double> cheapest;
  for (const std::size_t i : family.entries) {
    const auto known = error_of(report.entries[i], report.reference, kind);
    if (!known) continue;
    entries.push_back(report.entries[i]);
    entries.back().errors = {*known, std::nullopt, std::nullopt};
    if (*known <= error) cheapest = std::min(cheapest.value_or(report.entries[i].seconds), report.entries[i].seconds);
  }
  const auto between = cost_at_error(
      entries, [](const BenchErrors& errors) { return errors.axis; }, error);
  if (between && !(cheapest && *cheapest < between->seconds)) return FamilyCost{between->seconds, false};
  if (cheapest) return FamilyCost{*cheapest, true};
  return std::nullopt;
}

}  // namespace earthtop
