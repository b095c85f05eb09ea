/// Speed against error of every method on a scenario, as Markdown: what a motion costs at equal error, and what a drift costs.
///
/// earthtop-speed-error [SCENARIO [SECONDS [REPETITIONS]]]   SCENARIO: a shipped one's name, or a file

#include <fmt/format.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "earthtop/bench/bench.hpp"

namespace {

using namespace earthtop;

double axis_error(const BenchErrors& errors) { return errors.axis; }
double attitude_error(const BenchErrors& errors) { return errors.attitude.value_or(0); }

/// Entries that differ in nothing but the tolerance stand together.
bool same_family(const Contender& a, const Contender& b) {
  return a.workload == b.workload && a.precision == b.precision && a.options.method == b.options.method &&
         a.options.form == b.options.form && a.options.observer == b.options.observer;
}

std::string cost(const std::optional<CostAtError>& at) {
  return at ? fmt::format("{:.2f} ms, {:.0f}k", 1e3 * at->seconds, 1e-3 * at->evaluations) : "-";
}

void print_equal_error(const BenchReport& report) {
  fmt::print(
      "| one motion | equations | axis 1e-6 rad | 1e-9 | 1e-12 | attitude 1e-9 |\n| --- | --- | ---: | ---: | ---: | ---: |\n");
  const auto& entries = report.entries;
  for (std::size_t begin = 0, end = 0; begin < entries.size(); begin = end) {
    while (end < entries.size() && same_family(entries[begin].contender, entries[end].contender)) ++end;
    const Contender& first = entries[begin].contender;
    if (first.workload == Workload::drift) continue;
    if (first.workload == Workload::closed_form) {
      const BenchEntry& entry = entries[begin];
      fmt::print("| closed form | {:.2f} us a call | | | {:.0e} rad of axis, {:.0e} of attitude | |\n",
                 1e6 * entry.seconds / static_cast<double>(entry.counters.evaluations), entry.errors.axis,
                 entry.errors.attitude.value_or(0));
      continue;
    }
    const std::span<const BenchEntry> family(&entries[begin], end - begin);
    fmt::print("| {} | {}, {}{} | {} | {} | {} | {} |\n", to_string(first.options.method), to_string(first.options.form),
               to_string(first.options.observer), first.workload == Workload::axis ? ", axis only" : "",
               cost(cost_at_error(family, axis_error, 1e-6)), cost(cost_at_error(family, axis_error, 1e-9)),
               cost(cost_at_error(family, axis_error, 1e-12)), cost(cost_at_error(family, attitude_error, 1e-9)));
  }
}

void print_drift(const BenchReport& report) {
  double largest = 0;
  for (const auto& sample : report.reference.samples) largest = std::max(largest, static_cast<double>(sample.measures.axis));
  fmt::print(
      "\n| both motions and the drift | milliseconds | least, most | evaluations | error of the axis drift, of its largest | "
      "attitude "
      "error (rad) |\n| --- | ---: | ---: | ---: | ---: | ---: |\n");
  for (const BenchEntry& entry : report.entries) {
    if (entry.contender.workload != Workload::drift) continue;
    fmt::print("| {} | {:.1f} | {:.1f}, {:.1f} | {} | {:.1e} | {:.1e} |\n", describe(entry.contender), 1e3 * entry.seconds,
               1e3 * entry.seconds_least, 1e3 * entry.seconds_most, entry.counters.evaluations,
               entry.errors.drift.value_or(0) / largest, entry.errors.attitude.value_or(0));
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string name = argc > 1 ? argv[1] : "toy-top";
  const bool is_file = name.find('.') != std::string::npos;
  const std::string file = is_file ? name : std::string(EARTHTOP_SCENARIOS) + "/" + name + ".json";
  Scenario scenario = parse_scenario(read_scenario_source(file));
  if (argc > 2) scenario.duration_s = std::atof(argv[2]);
  BenchOptions options;
  if (argc > 3) options.repetitions = std::atoi(argv[3]);

  const BenchReport report = bench(scenario, standard_contenders(scenario), options);
  const CertifiedReference& reference = report.reference;
  fmt::print("{}, {:g} s, {} checkpoints, {} repetitions, one core.\n", report.scenario, report.duration_s, options.checkpoints,
             options.repetitions);
  fmt::print("Reference: {}, against {}: axis to {:.1e}, attitude to {:.1e}, drift to {:.1e} rad.\n\n", reference.source,
             reference.witness, reference.error.axis, reference.error.attitude.value_or(0), reference.error.drift.value_or(0));
  print_equal_error(report);
  print_drift(report);
}
