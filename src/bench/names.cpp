// SPDX-License-Identifier: GPL-3.0-or-later
// The names of contenders in words.
#include <fmt/core.h>

#include "earthtop/bench/bench.hpp"

namespace earthtop {

std::string_view to_string(Workload workload) {
  switch (workload) {
    case Workload::axis: return "axis";
    case Workload::motion: return "motion";
    case Workload::drift: return "drift";
  }
  return "unknown";
}

std::string method_name(const Contender& contender) {
  if (contender.peer) return std::string(contender.peer->word);
  std::string name(to_string(contender.options.method));
  if (row_of(contender.options.method).composes) {
    const Composition composition = contender.options.composition;
    name += ' ';
    name += to_string(composition == Composition::automatic ? Composition::rkn6 : composition);
  }
  return name;
}

std::string equations_name(const Contender& contender) {
  const IntegrationOptions& options = contender.options;
  if (contender.peer) return contender.workload == Workload::drift ? "difference of two" : "general, body";
  if (row_of(options.method).equations == MethodEquations::own) return "its own";
  return fmt::format("{}, {}", to_string(options.form), to_string(options.observer));
}

std::string setting_name(const Contender& contender) {
  const IntegrationOptions& options = contender.options;
  if (!contender.peer && is_exact(options.method)) return "-";
  if (options.step_s) return fmt::format("step {:.3g} s", *options.step_s);
  return fmt::format("{:.0e}", options.relative_tolerance);
}

std::string describe(const Contender& contender) {
  std::string text = fmt::format("{} {}, {}", method_name(contender), setting_name(contender), equations_name(contender));
  if (contender.precision != Precision::bits53) text += fmt::format(", {}", to_string(contender.precision));
  return text;
}

std::string_view outcome(const BenchEntry& entry) {
  if (entry.status != RunStatus::interrupted) return to_string(entry.status);
  return entry.repetitions > 0 ? "too_slow" : "not_tried";
}

}  // namespace earthtop
