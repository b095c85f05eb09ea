// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/comparand.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "compare/compact_reference.hpp"
#include "compare/replacement.hpp"
#include "earthtop/error.hpp"
#include "earthtop/study/run_study.hpp"
#include "input/document.hpp"
#include "input/file.hpp"
#include "results/directory_lock.hpp"
#include "results/file_set.hpp"
#include "results/number_ranges.hpp"
#include "results/seal.hpp"

namespace earthtop::compare {
namespace {

using input::PathType;

constexpr const char* kSummarySchema = "earthtop-summary-1.json";

bool is_link(const fs::path& path) {
  std::error_code error;
  return fs::is_symlink(fs::symlink_status(path, error));
}

bool is_compact_reference(const fs::path& file) {
  if (file.extension() != ".json") return false;
  std::string head(std::size_t{1} << 10, '\0');
  try {
    const input::Descriptor descriptor = input::open_regular_file(file.string(), file.string(), {"reference", false});
    head.resize(input::read_some(descriptor, file.string(), head.data(), head.size()));
  } catch (const ScenarioError&) {  // no file that can be opened
    return false;
  }
  return head.find(kReferenceSchema) != head.npos;
}

/// Whether a directory looks like a result or a store by its files' names. Results without their summary count, too, so that
/// they are refused by name later.
bool may_be_results(const fs::path& directory) {
  const auto looks_so = [&] {
    return is_there(directory / "summary.json") || is_there(study_store(directory)) || is_there(directory / "trajectory.csv") ||
           !FileSet::temporaries(directory, "summary.json").empty();
  };
  if (looks_so()) return true;
  // A run that is replacing its files takes them away for a moment.
  const DirectoryLock lock(directory, DirectoryLock::Mode::shared);
  return looks_so();
}

Comparand open_results(const fs::path& directory) {
  Comparand results;
  results.path = directory;
  const fs::path file = directory / "summary.json";
  std::string summary;
  results.summary = read_json_file(file, "summary", [&](std::string_view text) {
    if (!check_result_files(directory, text)) results.unverified.push_back(directory);
    summary = text;
  });
  if (results.word("/$schema") != kSummarySchema)
    refuse_file(file, fmt::format("is not a summary of `earthtop run`: its $schema is not \"{}\"", kSummarySchema));
  const auto rows = results.number("/outcome/rows");
  if (!rows || *rows > 1e15)
    refuse_file(file, "does not state its number of rows (/outcome/rows), a whole number; run the scenario again");
  results.stated_rows = static_cast<std::uint64_t>(*rows);
  if (const fs::path timing = directory / "timing.json"; is_there(timing))
    results.timing = read_json_file(timing, "timing", [&](std::string_view text) {
      if (!check_timing(directory, text, summary) && results.unverified.empty()) results.unverified.push_back(timing);
    });
  const std::string trajectory = (directory / "trajectory.csv").string(), torques = (directory / "torques.csv").string();
  results.open_rows = [trajectory] { return open_own_csv(trajectory, trajectory_table()); };
  if (is_there(torques)) results.open_torques = [torques] { return open_own_csv(torques, torques_table()); };
  return results;
}

}  // namespace

bool is_there(const fs::path& path) { return input::type_of(path.string()) != PathType::nothing; }

ComparandKind kind_of(const fs::path& path) {
  if (path.empty()) refuse_file(path, "the path is empty; give a directory of results, a study store, or a file");
  const PathType type = input::type_of(path.string());
  if (type == PathType::nothing) refuse_file(path, "there is no such file or directory; check the path");
  if (type != PathType::directory) {
    if (path.extension() == ".sqlite") return ComparandKind::store;
    return path.extension() == ".json" ? ComparandKind::reference : ComparandKind::csv;
  }
  if (is_there(path / "summary.json")) return ComparandKind::results;
  if (is_there(study_store(path))) return ComparandKind::store;
  {
    const DirectoryLock lock(path,
                             DirectoryLock::Mode::shared);  // a run that is replacing its files has no summary for a moment
    if (is_there(path / "summary.json")) return ComparandKind::results;
    if (is_there(path / "trajectory.csv"))
      refuse_file(path, "has a trajectory.csv without its summary.json: writing it was interrupted; run the scenario again");
  }
  if (members(path).empty())
    refuse_file(
        path, "holds no results: it has no summary.json, no study.sqlite, no directories with one, and no compact references");
  return ComparandKind::collection;
}

std::vector<std::pair<std::string, fs::path>> members(const fs::path& directory) {
  std::vector<std::pair<std::string, fs::path>> found;
  for (const std::string& name : input::names_in(directory.string())) {
    const fs::path path = directory / name;
    const PathType type = input::type_of(path.string());
    if (type == PathType::file && is_compact_reference(path)) found.emplace_back(path.stem().string(), path);
    if (type != PathType::directory || name == kStagingName) continue;
    finish_update_in(path);
    if (may_be_results(path)) {
      found.emplace_back(name, path);
    } else if (!is_link(path)) {
      for (auto& [below, there] : members(path)) found.emplace_back(fmt::format("{}/{}", name, below), std::move(there));
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

Json read_json_file(const fs::path& file, std::string_view noun, const std::function<void(std::string_view)>& check) {
  const std::string text = input::read_regular_file(file.string(), file.string(), {noun, false});
  if (check) check(text);
  Json json = input::read_document(text, file.string(), {noun});
  check_ranges(json, file.string());
  return json;
}

Comparand open_comparand(const fs::path& path, const Mapping* mapping) {
  const ComparandKind kind = kind_of(path);
  if (kind == ComparandKind::results) return open_results(path);
  if (kind == ComparandKind::reference) return open_compact_reference(path);
  Comparand csv;
  csv.path = path;
  const std::string file = path.string();
  if (mapping) {
    csv.attitude_error_rad = mapping->attitude_error_rad;
    csv.open_rows = [file, mapping] { return open_mapped_csv(file, *mapping); };
  } else {
    csv.open_rows = [file] { return open_own_csv(file, trajectory_table()); };
  }
  return csv;
}

}  // namespace earthtop::compare
