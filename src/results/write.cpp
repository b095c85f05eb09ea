// SPDX-License-Identifier: GPL-3.0-or-later
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>

#include "earthtop/results/provenance.hpp"
#include "earthtop/results/results.hpp"
#include "input/file.hpp"
#include "results/csv.hpp"
#include "results/file_set.hpp"
#include "results/seal.hpp"
#include "text/checksum.hpp"
#include "text/json.hpp"

namespace earthtop {
namespace {

namespace fs = std::filesystem;

/// summary.json names the scenario, and is the seal of the file set: it comes last in the list.
constexpr std::string_view kSummary = "summary.json";
constexpr std::array<std::string_view, 5> kFiles = {"trajectory.csv", "torques.csv", "drift.svg", "timing.json", kSummary};

[[noreturn]] void refuse(const fs::path& dir, std::string reason) {
  throw ScenarioError(std::vector<Diagnostic>{{0, 0, "", std::move(reason)}}, dir.string());
}

/// The SHA-256 of the scenario whose results `summary` holds; empty if the file is not a summary that this program wrote.
std::string scenario_of(const fs::path& summary) {
  constexpr std::size_t kLargest_MiB = 64;
  std::string text;
  try {
    text = input::read_regular_file(summary.string(), summary.string(), {"summary", false, kLargest_MiB});
  } catch (const ScenarioError&) {  // it is no file, cannot be opened or is too large
    return "";
  }
  const nlohmann::ordered_json json = json_or_discarded(text);
  const nlohmann::ordered_json::json_pointer hash("/provenance/scenario_sha256");
  if (json.is_discarded() || !json.contains(hash) || !json.at(hash).is_string()) return "";
  return json.at(hash).get<std::string>();
}

/// Whether something is at the path, a dangling link included. @throws WriteError where that cannot be known
bool is_there(const fs::path& path) {
  struct stat status = {};
  if (::lstat(path.c_str(), &status) == 0) return true;
  if (errno != ENOENT && errno != ENOTDIR) fail_to_write(path, errno);
  return false;
}

/// Refuses an existing directory whose files must not be overwritten. @throws ScenarioError
void check_present_files(const fs::path& dir, const Scene& scene, bool force) {
  for (const std::string_view name : kFiles)
    if (std::error_code error; fs::is_directory(fs::symlink_status(dir / name, error)))
      refuse(dir, std::string(name) + " in it is a directory; choose another --out");
  if (force) return;
  const fs::path summary = dir / kSummary;
  if (is_there(summary)) {
    const std::string present = scenario_of(summary);
    if (present.empty())
      refuse(dir, "summary.json in it is not a summary of earthtop's; choose another --out, or --force to overwrite it");
    if (present != scene.sha256())
      refuse(dir, "holds the results of another scenario; choose another --out, or --force to overwrite them");
    if (!scene.scenario().ledger && is_there(dir / "torques.csv"))
      refuse(dir, "torques.csv in it is none of this scenario's results; choose another --out, or --force to remove it");
    return;
  }
  // A run that was killed while it put its files in place left the summary under a temporary name.
  const auto left = FileSet::temporaries(dir, kSummary);
  const std::string& ours = scene.sha256();
  if (std::any_of(left.begin(), left.end(), [&](const fs::path& path) { return scenario_of(path) == ours; })) return;
  for (const std::string_view name : kFiles)
    if (is_there(dir / name))
      refuse(dir, std::string(name) + " is in it without a summary.json; choose another --out, or --force to overwrite it");
}

}  // namespace

void check_output_directory(const fs::path& dir, const Scene& scene, bool force) {
  if (dir.empty()) refuse("--out", "the directory's name is empty; give one");
  std::error_code error;
  fs::path present = fs::absolute(dir, error).lexically_normal();
  if (error) fail_to_write(dir, error.value());
  while (!is_there(present) && present.has_relative_path()) present = present.parent_path();
  if (!fs::is_directory(present, error)) {
    const bool link = fs::is_symlink(fs::symlink_status(present, error));
    refuse(present, link ? "is a link that leads to no directory; mend it, or choose another --out"
                         : "is not a directory; choose another --out");
  }
  if (::access(present.c_str(), W_OK | X_OK) != 0) fail_to_write(present, errno);
  if (fs::is_directory(dir, error)) check_present_files(dir, scene, force);
}

void write_file(const fs::path& file, std::string_view content) {
  std::error_code error;
  const fs::file_status status = fs::symlink_status(file, error);
  if (!file.has_filename() || (fs::exists(status) && !fs::is_regular_file(status)))
    refuse(file, "is no file's name, or something else than a file is there; give a file");
  const std::string name = file.filename().string();
  const std::string_view names[] = {name};
  FileSet files(file.has_parent_path() ? file.parent_path() : fs::path("."), names);
  files.add(name, content);
  files.commit();
}

double writing_seconds(const Scenario& scenario) {
  const double seconds_a_row = scenario.precision == Precision::bits53 ? 3e-6 : 8e-5;  // as measured
  return (scenario.ledger ? 2 : 1) * seconds_a_row * scenario.duration_s / scenario.output_step_s;
}

std::string write_results(const RunResult& result, const fs::path& dir, bool force, const Watch& watch) {
  check_output_directory(dir, result.scene, force);
  FileSet files(dir, kFiles, watch);
  check_present_files(dir, result.scene, force);  // once more, since no other run can write there while the directory is locked
  FileChecksums checksums;
  const auto add = [&](std::string_view name, const auto& produce) {
    Checksum checksum;
    files.add(name, [&](const FileSet::Sink& sink) {
      produce([&](std::string_view piece) {
        checksum.add(piece);
        sink(piece);
      });
    });
    checksums.emplace_back(name, checksum_text(checksum.value()));
  };
  add("trajectory.csv",
      [&](const FileSet::Sink& sink) { write_trajectory_csv(result, sink, watch.part(0, result.ledger ? 0.5 : 1)); });
  if (result.ledger)
    add("torques.csv", [&](const FileSet::Sink& sink) { write_torques_csv(result, sink, watch.part(0.5, 1)); });
  add("drift.svg", [&](const FileSet::Sink& sink) { sink(svg(drift_figure(result))); });
  files.add("timing.json", sealed(timing_json(result)));  // on its own: a summary has nothing that differs from run to run
  const std::string summary = sealed(summary_json(result), checksums);
  files.add(kSummary, summary);
  files.commit();
  return summary;
}

}  // namespace earthtop
