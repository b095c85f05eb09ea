// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the files of a benchmark.
#include <fmt/core.h>

#include <algorithm>

#include "earthtop/bench/comparison.hpp"
#include "earthtop/error.hpp"
#include "earthtop/results/output_files.hpp"
#include "results/file_set.hpp"

namespace earthtop {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> file_names(std::span<const std::string> scenarios) {
  std::vector<std::string> names;
  for (const std::string& scenario : scenarios)
    for (const char* kind : {".csv", ".svg"}) names.push_back(scenario + kind);
  return names;
}

}  // namespace

void check_bench_directory(const fs::path& dir, std::span<const std::string> scenarios, bool force) {
  if (dir.empty()) refuse_file("--out", "the directory's name is empty; give a name");
  require_place_for_directory(dir, "choose another --out");
  std::error_code error;
  for (const std::string& name : file_names(scenarios)) {
    if (!is_something_at(dir / name)) continue;
    if (fs::is_directory(fs::symlink_status(dir / name, error)))
      refuse_file(dir / name, "is a directory; choose another --out");
    if (!force) refuse_file(dir / name, "already exists; choose another --out, or --force to overwrite it");
  }
}

void write_bench(std::span<const BenchReport> reports, const fs::path& dir, bool force) {
  std::vector<std::string> scenarios;
  for (const BenchReport& report : reports) scenarios.push_back(report.scenario);
  check_bench_directory(dir, scenarios, force);
  const std::vector<std::string> names = file_names(scenarios);
  const std::vector<std::string_view> views(names.begin(), names.end());
  FileSet files(dir, views);
  for (const BenchReport& report : reports) {
    files.add(report.scenario + ".csv", bench_csv(report));
    files.add(report.scenario + ".svg", svg(bench_figure(report)));
  }
  files.commit();
}

}  // namespace earthtop
