// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench_text.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "earthtop/bench/comparison.hpp"
#include "earthtop/error.hpp"
#include "wrapped.hpp"

namespace earthtop::tool {
namespace {

std::string number(const std::optional<double>& value) { return value ? fmt::format("{:.1e}", *value) : "-"; }

std::string seconds_text(double seconds) { return fmt::format("{:#.3g}", seconds); }

const char* workload_text(Workload workload) {
  switch (workload) {
    case Workload::axis: return "one motion, the axis alone where the method allows it";
    case Workload::motion: return "one motion";
    case Workload::drift: break;
  }
  return "both motions and the drift between them";
}

std::string head(const BenchReport& report, ErrorKind kind, std::size_t width) {
  const BenchErrors& error = report.reference.error;
  std::string text =
      wrapped(fmt::format("{}, {:g} s: {}", report.scenario, report.duration_s, workload_text(report.workload)), width, 2) +
      '\n';
  const auto add = [&](std::string_view label, std::string_view what) { text += wrapped_entry(label, what, width, 11); };
  const int repetitions = report.options.repetitions;
  add("Processor",
      fmt::format("{}; seconds of one core, {}", processor_description(),
                  repetitions == 1 ? "timed once" : fmt::format("median of up to {} repetitions, [least, most]", repetitions)));
  add("Errors", fmt::format("largest of {} checkpoints (rad); the largest drift is {:.3g} rad; compared: {}",
                            report.options.checkpoints, report.largest_drift, to_string(kind)));
  add("Reference", report.reference.source);
  add("", "against " + report.reference.witness);
  add("", fmt::format("good to {} rad in the axis, {} in the attitude, {} in the drift", number(error.axis),
                      number(error.attitude), number(error.drift)));
  add("Peers", peers_description());
  for (const BenchEntry& entry : report.entries)
    if (entry.contender.is_auto) add("auto", describe(entry.contender));
  return text;
}

/// @param least smallest errors that the reference can resolve; smaller ones are printed as "<" and this value
std::string row(const BenchEntry& entry, bool on_front, const BenchErrors& least) {
  const Contender& contender = entry.contender;
  const bool completed = entry.status == RunStatus::completed;
  const bool tried = entry.repetitions > 0;
  const auto error = [&](const std::optional<double>& value, std::optional<double> known) {
    if (!completed || !value) return std::string("-");
    return *value < known.value_or(0) ? "<" + number(known) : number(value);
  };
  std::string text = fmt::format(
      "{}{} {:<19} {:<19} {:<11} {:<16} {:>8} {:>8} {:>8} {:>9} {:<20} {:>9} {:>8}", on_front ? '*' : ' ',
      contender.is_auto ? 'a' : ' ', method_name(contender), equations_name(contender), to_string(contender.precision),
      setting_name(contender), error(entry.errors.axis, least.axis), error(entry.errors.attitude, least.attitude),
      error(entry.errors.drift, least.drift), tried ? seconds_text(entry.seconds) : "-",
      tried ? fmt::format("[{}, {}]", seconds_text(entry.seconds_least), seconds_text(entry.seconds_most)) : "-",
      entry.counters.evaluations, entry.counters.accepted);
  if (!completed) text += fmt::format("  {}", outcome(entry));
  return text + '\n';
}

std::string table(const BenchReport& report, ErrorKind kind, bool brief, std::size_t width) {
  std::string text =
      fmt::format("   {:<19} {:<19} {:<11} {:<16} {:>8} {:>8} {:>8} {:>9} {:<20} {:>9} {:>8}\n", "method", "equations",
                  "precision", "tolerance", "axis", "attitude", "drift", "seconds", "[least, most]", "RHS", "steps");
  const std::vector<bool> front = pareto_front(report, kind);
  std::vector<std::size_t> order(report.entries.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  if (brief)
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return report.entries[a].seconds < report.entries[b].seconds; });
  std::size_t slow = 0;
  for (const std::size_t i : order) {
    slow += report.entries[i].status == RunStatus::interrupted ? 1 : 0;
    if (!brief || front[i] || report.entries[i].contender.is_auto)
      text += row(report.entries[i], front[i], report.reference.error);
  }
  text += wrapped("*: on the Pareto front: no other is both as fast and as exact; a: what auto takes", width, 3) + '\n';
  if (slow > 0)
    text +=
        wrapped(fmt::format("{} of {} contenders are too_slow, stopped after {:g} s of processor time (--limit), or not_tried, "
                            "too slow already at a coarser tolerance",
                            slow, report.entries.size(), report.options.most_seconds),
                width, 3) +
        '\n';
  return text;
}

std::string cost(const std::optional<FamilyCost>& cost) {
  return cost ? (cost->at_most ? "<=" : "") + seconds_text(1e3 * cost->seconds) : "-";
}

std::string equal_error(const BenchReport& report, ErrorKind kind, std::size_t width) {
  std::string text =
      wrapped(fmt::format("Milliseconds at equal {} error (<=: the cheapest setting tried is already better; -: not reached)",
                          to_string(kind)),
              width, 3);
  text += fmt::format("\n   {:<19} {:<19} {:<11}", "method", "equations", "precision");
  for (const double error : kEqualErrors) text += fmt::format(" {:>9}", fmt::format("{:.0e}", error));
  text += fmt::format(" {:>11}\n", "least error");
  for (const BenchFamily& family : families(report)) {
    std::optional<double> least;
    for (const std::size_t i : family.entries)
      if (const auto error = error_of(report.entries[i], report.reference, kind))
        least = std::min(least.value_or(*error), *error);
    if (!least) continue;
    text += fmt::format("   {:<19} {:<19} {:<11}", method_name(family.first), equations_name(family.first),
                        to_string(family.first.precision));
    for (const double error : kEqualErrors) text += fmt::format(" {:>9}", cost(family_cost(report, family, kind, error)));
    text += fmt::format(" {:>11}\n", number(least));
  }
  return text;
}

}  // namespace

std::string bench_text(const BenchReport& report, bool brief, std::size_t width) {
  const ErrorKind kind = report.compared;
  return head(report, kind, width) + '\n' + table(report, kind, brief, width) + '\n' + equal_error(report, kind, width);
}

}  // namespace earthtop::tool
