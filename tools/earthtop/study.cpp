// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <ios>
#include <iterator>
#include <memory>
#include <new>
#include <optional>
#include <thread>

#include "command_line.hpp"
#include "earthtop/results/results.hpp"
#include "earthtop/study/indices_note.hpp"
#include "earthtop/study/run_study.hpp"
#include "earthtop/study/selection.hpp"
#include "earthtop/study/timing.hpp"
#include "interrupt.hpp"
#include "json_object.hpp"
#include "output.hpp"
#include "progress_line.hpp"
#include "screen.hpp"
#include "study_progress.hpp"
#include "study_text.hpp"
#include "verbs.hpp"
#include "wrapped.hpp"

namespace earthtop::tool {
namespace {

namespace fs = std::filesystem;

struct StudyArguments {
  std::string study;  // a file, or "-"
  std::optional<std::string> out;
  unsigned jobs = 0;
  std::string shard, reuse;
  bool force = false, keep_going = false, retry_failed = false, repair = false, dry_run = false, list_quantities = false;
  bool json = false, quiet = false;
  std::vector<std::string> stores;  // for merge
  std::string store;                // for show and export
  PointSelection points;            // for show
};

StudyShard parse_shard(const std::string& text) {
  if (text.empty()) return {};
  StudyShard shard;
  const char* end = text.data() + text.size();
  const auto [slash, error] = std::from_chars(text.data(), end, shard.k);
  const bool k = error == std::errc() && slash != end && *slash == '/';
  const auto [stop, n_error] =
      k ? std::from_chars(slash + 1, end, shard.n) : std::from_chars_result{end, std::errc::invalid_argument};
  if (!k || n_error != std::errc() || stop != end || shard.k < 1 || shard.n < shard.k)
    throw ScenarioError("", fmt::format("--shard {}: must be K/N with 1 <= K <= N, e.g. 1/4", printable(text)));
  return shard;
}

int dry_run(const Study& study, const StudyArguments& arguments) {
  require_affordable(study);
  const StudyEstimate expected = estimate(study);
  const StudySample sample = sample_points(study);
  if (sample.common && !arguments.keep_going) throw *sample.common;
  const unsigned jobs = arguments.jobs > 0 ? arguments.jobs : std::max(1U, std::thread::hardware_concurrency());
  const double memory = expected.memory_bytes + jobs * expected.memory_bytes_a_job;
  const StudyShard shard = parse_shard(arguments.shard);
  const StudyTiming timing = time_study(study, jobs, shard);
  const std::string note = indices_note(study);
  if (arguments.json) {
    JsonObject json;
    json.put("name", study.name)
        .put("points", expected.points)
        .put("core_seconds", timing.core_seconds)
        .put("disk_bytes", expected.disk_bytes)
        .put("memory_bytes", memory)
        .put("points_looked_at", sample.looked_at)
        .put("points_refused", sample.refused)
        .put("study_sha256", study_sha256(study))
        .put("jobs", std::uint64_t{jobs})
        .put("shard_points", timing.shard_points)
        .put("seconds", timing.seconds)
        .put("points_timed", timing.points_timed)
        .put("seconds_timed", timing.spent_seconds)
        .put("time_basis", timing_basis(timing));
    if (!note.empty()) json.put("indices_note", note);
    print_json(json);
    return kDone;
  }
  const std::size_t width = output_screen().width;
  print(fmt::format("{}: {} points, {} on one core, {} on disk, {} of memory\n", study.name, expected.points,
                    about_seconds(timing.core_seconds), bytes_text(expected.disk_bytes), bytes_text(memory)));
  print(wrapped(fmt::format("{} with {} {}{}. {}", about_seconds(timing.seconds), jobs, jobs == 1 ? "thread" : "threads",
                            shard.is_whole() ? "" : fmt::format(" for the {} points of this shard", timing.shard_points),
                            timing_basis(timing)),
                width, 2) +
        '\n');
  if (!note.empty()) print(wrapped(note, width, 2) + '\n');
  if (sample.refused > 0)
    print(wrapped(fmt::format("{} of {} points examined are refused, the first one because of {}", sample.refused,
                              sample.looked_at, sample.first_refusal),
                  width, 2) +
          '\n');
  return kDone;
}

int list_quantities(const StudyArguments& arguments) {
  const std::vector<CollectablePath> all =
      arguments.study.empty() ? collectable_paths() : collectable_paths(read_scenario_source(arguments.study));
  if (arguments.json) {
    std::vector<JsonObject> objects;
    for (const CollectablePath& each : all) {
      JsonObject object;
      object.put("path", each.path).put("unit", each.unit).put("meaning", each.meaning);
      objects.push_back(std::move(object));
    }
    print_json(JsonObject().put("quantities", objects));
    return kDone;
  }
  std::size_t path = 0, unit = 0;
  for (const CollectablePath& each : all) path = std::max(path, each.path.size()), unit = std::max(unit, each.unit.size());
  std::string text;
  for (const CollectablePath& each : all)
    text += fmt::format("{:<{}}  {:<{}}  {}\n", each.path, path, each.unit, unit, each.meaning);
  print(text);
  return kDone;
}

/// Reports the end of a shard; its points alone are not shown as a study.
void print_shard_report(const StudyRunReport& report, const StudyArguments& arguments) {
  if (arguments.json)
    print_json(JsonObject()
                   .put("store", report.store.string())
                   .put("points_wanted", report.progress.wanted)
                   .put("points_computed", report.progress.before + report.progress.done)
                   .put("points_failed", report.failed));
  else if (!arguments.quiet)
    print(fmt::format("{}: {} of {} points of this shard, {} failed; earthtop study merge puts the shards together\n",
                      printable(report.store.string()), report.progress.before + report.progress.done, report.progress.wanted,
                      report.failed));
}

/// The document that `write_study_results` put beside the store; gathering it again from millions of points would take long.
std::string written_document(const fs::path& store) {
  const fs::path name = store.parent_path() / "study.json";
  try {
    errno = 0;
    std::ifstream file(name);
    if (!file && errno == ENOMEM) throw std::bad_alloc();
    std::string text{std::istreambuf_iterator<char>(file), {}};
    if (text.empty()) throw ReadError(name.string(), "reading broke off; check the file");
    return text;
  } catch (const std::ios_base::failure&) {
    throw ReadError(name.string(), "reading broke off; check the file");
  }
}

void print_results(const fs::path& store, bool json, bool quiet) {
  if (quiet && !json) return;
  const std::string text = written_document(store);
  if (json) return print(text);
  const std::size_t width = output_screen().width;
  const std::string files =
      fmt::format("Results in {}: study.csv, study.json, study.sqlite, and study.svg if it has one or two axes",
                  printable(store.parent_path().string()));
  print(study_text(text, width) + '\n' + wrapped(files, width, 2) + '\n');
}

void warn_of_missing_checksums(const fs::path& store, bool has_checksums) {
  if (!has_checksums)
    message(fmt::format("{} has no checksums, so damage to it would not be noticed", printable(store.string())));
}

/// What an older store gave to a study, and why it gave no more.
std::string growth_text(const StudyGrowth& growth) {
  std::string text =
      fmt::format("reused {} of {} points from {}", growth.reused, growth.points, printable(growth.from.string()));
  if (!growth.why.empty()) text += ": " + growth.why;
  if (growth.left_out > 0)
    text += fmt::format("; {} of its {} points are not in this design, and {}", growth.left_out, growth.held,
                        growth.replaced ? "have been dropped" : "stay there");
  return text;
}

int study_verb(const StudyArguments& arguments) {
  StudyProcesses processes;
  if (!processes.is_first()) {
    const OrderlyEnd orderly;
    processes.serve(stop_flag());
    return kDone;
  }
  if (arguments.list_quantities) return list_quantities(arguments);
  if (arguments.study.empty()) throw ScenarioError("", "a study file is needed, or one of merge, show, export");
  const Study study = parse_study(read_scenario_source(arguments.study));
  if (arguments.dry_run) return dry_run(study, arguments);
  StudyRunOptions options;
  options.dir = arguments.out ? *arguments.out : "out/studies/" + study.name;
  options.jobs = arguments.jobs;
  options.shard = parse_shard(arguments.shard);
  options.force = arguments.force;
  options.keep_going = arguments.keep_going;
  options.retry_failed = arguments.retry_failed;
  options.repair = arguments.repair;
  options.reuse = arguments.reuse;
  options.processes = &processes;
  options.watch = stop_flag();
  if (options.shard.is_whole()) check_study_results(options.dir, study, options.force);
  StudyRunReport report;
  {
    const OrderlyEnd orderly;
    ProgressLine line(!arguments.quiet && !arguments.json);
    bool told = arguments.quiet || arguments.json;
    options.on_progress = [&](const StudyProgress& progress) {
      if (!told && progress.before > 0) {
        line.clear();
        message(fmt::format("resuming: {} of {} points have already been computed", progress.before, progress.wanted));
      }
      told = true;
      line.show(progress_text(progress));
    };
    options.on_growth = [&](const StudyGrowth& growth) {
      const bool says_nothing = growth.reused == 0 && growth.left_out == 0 && growth.why.empty();  // all was there already
      if (arguments.quiet || arguments.json || says_nothing) return;
      line.clear();
      message(growth_text(growth));
      told = told || growth.reused > 0;
    };
    try {
      report = run_study(study, options);
    } catch (const Interrupted&) {  // while the points of an older store were looked for
      report.interrupted = true;
      report.progress.wanted = point_count(study).value_or(0);
    }
  }
  if (report.replaced && !arguments.quiet && !arguments.json)
    message(fmt::format("{} was another study's, no point of which had been completed; it has been replaced",
                        printable(report.store.string())));
  if (!report.damage.empty() && !arguments.quiet && !arguments.json)
    message(fmt::format("{} was repaired; it {}", printable(report.store.string()), printable(report.damage)));
  if (!arguments.quiet) warn_of_missing_checksums(report.store, report.has_checksums);
  if (report.interrupted)
    return report_errors("",
                         {{0, 0, "",
                           fmt::format("interrupted at {} of {} points; the same command goes on from there",
                                       report.progress.before + report.progress.done, report.progress.wanted)}},
                         arguments.json, interrupted_status());
  if (options.shard.is_whole()) {
    write_study_results(report.store, {}, arguments.force);
    print_results(report.store, arguments.json, arguments.quiet);
  } else {
    print_shard_report(report, arguments);
  }
  if (report.failed == 0) return kDone;
  message(fmt::format("earthtop: {} of {} points failed; the reasons are in the table", report.failed, report.progress.wanted));
  return kNegative;
}

/// Checks a store against its checksums and reports what is wrong. @returns the exit status
int check_store(const fs::path& store) {
  const StudyStoreCheck check = check_study_store(store);
  warn_of_missing_checksums(store, check.has_checksums);
  if (check.damage.empty()) return kDone;
  message(fmt::format("earthtop: error: {} {}", printable(store.string()), printable(check.damage)));
  return kNegative;
}

int merge_verb(const StudyArguments& arguments) {
  std::vector<fs::path> stores;
  for (const std::string& given : arguments.stores) stores.push_back(store_at(given));
  const fs::path dir = arguments.out.value_or(".");
  merge_study_stores(stores, dir, arguments.force);
  const fs::path merged = study_store(dir);
  write_study_results(merged, {}, arguments.force);
  const auto [planned, computed, failed] = study_counts(written_document(merged));
  print_results(merged, arguments.json, arguments.quiet);
  if (computed < planned)
    message(fmt::format("earthtop: {} of {} points are missing; earthtop study STUDY.json --out {} computes them",
                        planned - computed, planned, printable(dir.string())));
  return computed < planned || failed > 0 ? kNegative : kDone;
}

int show_verb(const StudyArguments& arguments) {
  const fs::path store = store_at(arguments.store);
  if (!arguments.points.where.empty() || arguments.points.worst) {
    const std::string text = selected_points_json(store, arguments.points);
    const int status = check_store(store);
    print(arguments.json ? text : selected_points_text(text));
    return status;
  }
  const int status = check_store(store);
  const std::string text = study_json(store);
  print(arguments.json ? text : study_text(text, output_screen().width));
  return status;
}

int export_verb(const StudyArguments& arguments) {
  const fs::path store = store_at(arguments.store);
  const int status = check_store(store);
  const auto pass_on = [](std::string_view piece) { print(piece); };
  arguments.json ? study_whole_json(store, pass_on) : study_csv(store, pass_on);
  return status;
}

}  // namespace

Verb describe_study() {
  auto arguments = std::make_shared<StudyArguments>();
  StudyArguments& a = *arguments;
  const auto add_output_flags = [&](Verb& verb) {
    verb.add("--json", &a.json, "print the results, or the errors, as one JSON document");
    verb.add("--quiet", &a.quiet, "print nothing but errors (and what --json asks for)");
  };
  Verb study("study", "run a parameter study: many runs, resumable; merge, show and export its results",
             [arguments] { return study_verb(*arguments); });
  study.add("STUDY", &a.study, "study file (JSON); - is standard input").json_file();
  study.add("--out", &a.out, "directory for the store and the results; default: out/studies/<name>").called("DIR");
  study.add("--jobs", &a.jobs, "number of threads; default: one per core").called("N").within(1, 4096);
  study.add("--shard", &a.shard, "compute only every N-th point, beginning with the K-th").called("K/N");
  study.add("--reuse", &a.reuse, "copy the points that an older store, or the directory that holds it, has of this design")
      .called("OLD");
  study.add("--force", &a.force, "discard the store of another study, and overwrite results that are not this study's");
  study.add("--keep-going", &a.keep_going,
            "compute the study even if all points examined beforehand are refused for the same reason");
  study.add("--retry-failed", &a.retry_failed, "compute failed points again");
  study.add("--repair", &a.repair, "keep the intact points of a damaged store, and compute the others again");
  study.add("--list-quantities", &a.list_quantities,
            "list what a study can collect, with unit and meaning; of STUDY, or a scenario, only what its runs have");
  study.add("--dry-run", &a.dry_run, "count the points, and estimate time and disk space; store nothing");
  add_output_flags(study);

  Verb merge("merge", "put the stores of shards together", [arguments] { return merge_verb(*arguments); });
  merge.describe("Puts the points of several stores of one study into one store, and writes and prints its results.");
  merge.example("earthtop study merge part*/shard-*.sqlite --out all", "puts the shards together");
  merge.ends_with(kDone, "all points of the study are there, and none has failed");
  merge.ends_with(kNegative, "points failed or are missing");
  merge.ends_with(kRefused, "the command line or a store was refused; nothing was written");
  merge.ends_with(kWriteFailed, "writing failed, or reading a store broke off");
  merge.add("STORE", &a.stores, "stores, or directories that hold one").required();
  merge.add("--out", &a.out, "directory of the merged store and its results").called("DIR").required();
  merge.add("--force", &a.force, "discard the store of another study there, and overwrite results that are not this study's");
  add_output_flags(merge);

  Verb show("show", "print what a store holds: statistics, fits, indices", [arguments] { return show_verb(*arguments); });
  show.describe("Prints what the study itself prints at its end, also while it is running or after it was interrupted.");
  show.example("earthtop study show out/studies/latitudes", "prints statistics, fits and indices");
  show.example("earthtop study show out/studies/latitudes --worst drift.axis_bound_rad",
               "prints the points with the largest bounds");
  show.example("earthtop study show out/studies/latitudes --where 'latitude_deg>=60'", "prints the points near the pole");
  show.ends_with(kNegative, "the store is damaged: a point does not match its checksum");
  show.ends_with(kRefused, "the command line or a condition was refused, or there is no such store");
  show.ends_with(kWriteFailed, "reading the store broke off, or writing to standard output failed");
  show.add("STORE", &a.store, "a store, or the directory that holds it").required();
  show.add("--worst", &a.points.worst,
           "print instead the ten points with the largest absolute values of a quantity, of an error bound the largest")
      .called("QUANTITY");
  show.add("--where", &a.points.where,
           "print instead the points where a column (an axis, a quantity, status or point) compares so with a value: <, >, <=, "
           ">=, = or !=; once for each of several conditions")
      .called("CONDITION");
  show.add("--json", &a.json, "print it as one JSON document");

  Verb table("export", "print the points of a store as CSV or JSON", [arguments] { return export_verb(*arguments); });
  table.describe(
      "Prints a line for every point that has been computed, as in study.csv; with --json the results with every point as one "
      "document, which earthtop schema --study-results describes.");
  table.example("earthtop study export out/studies/latitudes > points.csv", "writes the points to a file");
  table.ends_with(kNegative, "the store is damaged: a point does not match its checksum");
  table.ends_with(kRefused, "the command line was refused, or there is no such store");
  table.ends_with(kWriteFailed, "reading the store broke off, or writing to standard output failed");
  table.example("earthtop study export out/studies/latitudes --json > points.json", "writes all results as JSON");
  table.add("STORE", &a.store, "a store, or the directory that holds it").required();
  table.add("--json", &a.json, "print the results with all points as one JSON document");

  study.describe(
      "Runs a scenario at many points, those of a grid or a sample, and keeps every point in a store, study.sqlite, as soon as "
      "it is computed. If the study is interrupted, the same command continues it. At the end it prints statistics, fits and "
      "indices, and writes study.csv, study.json and, for one or two axes, study.svg beside the store. With --shard, several "
      "machines share the points; merge then puts their stores together.");
  study.example("earthtop study latitudes.json --dry-run", "counts the points, and estimates time and disk space");
  study.example("earthtop study latitudes.json --shard 1/4 --out part1", "computes a quarter of the points");
  study.example("earthtop study merge part*/shard-*.sqlite --out all", "puts the shards together");
  study.example("earthtop study latitudes.json", "computes all points, and prints and writes the results");
  study.ends_with(kDone, "all points are computed, and none has failed");
  study.ends_with(kNegative, "points failed; or merge found points missing, or show or export found the store damaged");
  study.ends_with(kRefused, "the command line or the study was refused, or the store is another study's; nothing was written");
  study.ends_with(kNumericalFailure, "memory or threads ran out");
  study.ends_with(kWriteFailed, "writing failed, or reading an input broke off");
  study.ends_with(kInterrupted, "interrupted by SIGHUP, SIGINT or SIGTERM; the same command continues the study");
  study.verbs = {merge, show, table};
  return study;
}

}  // namespace earthtop::tool
