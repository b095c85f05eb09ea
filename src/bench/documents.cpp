// SPDX-License-Identifier: GPL-3.0-or-later
// A benchmark report as CSV and as JSON.
#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "earthtop/bench/comparison.hpp"
#include "earthtop/results/provenance.hpp"
#include "results/csv.hpp"
#include "results/seal.hpp"

namespace earthtop {
namespace {

using Json = nlohmann::ordered_json;

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json errors_json(const BenchErrors& errors) {
  return {{"axis_rad", errors.axis}, {"attitude_rad", or_null(errors.attitude)}, {"drift_rad", or_null(errors.drift)}};
}

Json entry_json(const BenchEntry& entry, bool on_front) {
  const Contender& contender = entry.contender;
  const bool completed = entry.status == RunStatus::completed, tried = entry.repetitions > 0;
  const bool reads_tolerance = contender.peer || (!is_exact(contender.options.method) && !contender.options.step_s);
  return {{"method", method_name(contender)},
          {"peer", contender.peer != nullptr},
          {"equations", equations_name(contender)},
          {"precision", to_string(contender.precision)},
          {"relative_tolerance", reads_tolerance ? Json(contender.options.relative_tolerance) : Json(nullptr)},
          {"step_s", or_null(contender.options.step_s)},
          {"outcome", outcome(entry)},
          {"error", completed ? errors_json(entry.errors) : Json(nullptr)},
          {"seconds", tried ? Json(entry.seconds) : Json(nullptr)},
          {"seconds_least", tried ? Json(entry.seconds_least) : Json(nullptr)},
          {"seconds_most", tried ? Json(entry.seconds_most) : Json(nullptr)},
          {"repetitions", entry.repetitions},
          {"evaluations", entry.counters.evaluations},
          {"steps", entry.counters.accepted},
          {"rejected_steps", entry.counters.rejected},
          {"on_front", on_front},
          {"auto", contender.is_auto}};
}

Json equal_error_json(const BenchReport& report, ErrorKind kind) {
  Json rows = Json::array();
  for (const BenchFamily& family : families(report)) {
    Json costs = Json::array();
    for (const double error : kEqualErrors) {
      const auto cost = family_cost(report, family, kind, error);
      costs.push_back(
          {{"error_rad", error}, {"seconds", cost ? Json(cost->seconds) : Json(nullptr)}, {"at_most", cost && cost->at_most}});
    }
    rows.push_back({{"method", method_name(family.first)},
                    {"equations", equations_name(family.first)},
                    {"precision", to_string(family.first.precision)},
                    {"costs", std::move(costs)}});
  }
  return rows;
}

Json report_json(const BenchReport& report) {
  const ErrorKind kind = report.compared;
  Json entries = Json::array();
  const std::vector<bool> front = pareto_front(report, kind);
  for (std::size_t i = 0; i < report.entries.size(); ++i) entries.push_back(entry_json(report.entries[i], front[i]));
  const BenchOptions& options = report.options;
  return {{"scenario", report.scenario},
          {"title", report.title},
          {"duration_s", report.duration_s},
          {"workload", to_string(report.workload)},
          {"compared_error", to_string(kind)},
          {"checkpoints", options.checkpoints},
          {"most_seconds", options.most_seconds},
          {"largest_drift_rad", report.largest_drift},
          {"reference",
           {{"source", report.reference.source},
            {"witness", report.reference.witness},
            {"error", errors_json(report.reference.error)}}},
          {"entries", std::move(entries)},
          {"equal_error", equal_error_json(report, kind)}};
}

/// Names contain commas but no quotes.
std::string csv_field(std::string_view text) { return fmt::format("\"{}\"", text); }

void append_line(std::string& csv, const BenchEntry& entry, bool on_front) {
  const Contender& contender = entry.contender;
  csv += fmt::format("{},{},{},", method_name(contender), csv_field(equations_name(contender)), to_string(contender.precision));
  if (contender.peer || (!is_exact(contender.options.method) && !contender.options.step_s))
    append_number(csv, contender.options.relative_tolerance);
  csv += ',';
  if (contender.options.step_s) append_number(csv, *contender.options.step_s);
  csv += fmt::format(",{},", outcome(entry));
  const bool completed = entry.status == RunStatus::completed;
  if (completed) append_number(csv, entry.errors.axis);
  csv += ',';
  if (completed && entry.errors.attitude) append_number(csv, *entry.errors.attitude);
  csv += ',';
  if (completed && entry.errors.drift) append_number(csv, *entry.errors.drift);
  for (const double seconds : {entry.seconds, entry.seconds_least, entry.seconds_most}) {
    csv += ',';
    if (entry.repetitions > 0) append_number(csv, seconds);
  }
  csv += fmt::format(",{},{},{},{},{},{}\n", entry.repetitions, entry.counters.evaluations, entry.counters.accepted,
                     entry.counters.rejected, on_front ? 1 : 0, contender.is_auto ? 1 : 0);
}

}  // namespace

std::string bench_csv(const BenchReport& report) {
  std::string csv =
      "method,equations,precision,relative_tolerance,step_s,outcome,axis_error_rad,attitude_error_rad,drift_error_rad,"
      "seconds,seconds_least,seconds_most,repetitions,evaluations,steps,rejected_steps,on_front,auto,processor\n";
  const std::vector<bool> front = pareto_front(report, report.compared);
  const std::string processor = fmt::format(",{}\n", csv_field(processor_description()));
  for (std::size_t i = 0; i < report.entries.size(); ++i) {
    append_line(csv, report.entries[i], front[i]);
    csv.replace(csv.size() - 1, 1, processor);
  }
  return csv;
}

std::string bench_json(std::span<const BenchReport> reports) {
  Json list = Json::array();
  for (const BenchReport& report : reports) list.push_back(report_json(report));
  const BuildInfo& build = build_info();
  const Json document = {{"program", "earthtop"},
                         {"document", "bench"},
                         {"version", build.version},
                         {"commit", build.commit},
                         {"compiler", build.compiler},
                         {"flags", build.flags},
                         {"processor", processor_description()},
                         {"peers", peers_description()},
                         {"scenarios", std::move(list)}};
  return sealed_document(document);
}

}  // namespace earthtop
