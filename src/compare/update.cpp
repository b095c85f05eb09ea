// SPDX-License-Identifier: GPL-3.0-or-later
// Replaces references by new results, and keeps the reason for each change.
#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "compare/compact_reference.hpp"
#include "earthtop/compare/compare.hpp"
#include "earthtop/error.hpp"
#include "earthtop/results/results.hpp"
#include "earthtop/study/run_study.hpp"
#include "results/file_set.hpp"
#include "text/json.hpp"

namespace earthtop {
namespace compare {
namespace {

constexpr std::string_view kNotes = "reference.json";  // beside the files of a reference that is a directory
constexpr const char* kNotesSchema = "earthtop-reference-notes-1.json";

Json history_in(const fs::path& file) {
  if (!is_there(file)) return Json::array();
  const Json json = read_json_file(file, "reference");
  const std::string schema = json.value("$schema", Json()).is_string() ? json.at("$schema").get<std::string>() : "";
  if (schema != kReferenceSchema && schema != kNotesSchema)
    refuse_path(file, "is there already, and is no reference; choose another place");
  return json.contains("history") && json.at("history").is_array() ? json.at("history") : Json::array();
}

std::string notes(Json history, const std::string& reason) {
  const Json document = {{"$schema", kNotesSchema}, {"history", with_reason(std::move(history), reason)}};
  return written_replacing(document, 2) + '\n';
}

/// Copies a file's bytes to the sink, a block at a time.
void copy(const fs::path& file, const FileSet::Sink& sink) {
  const input::Descriptor from = input::open_regular_file(file.string(), file.string(), {"result file", false});
  std::string block(std::size_t{1} << 20, '\0');
  while (const std::size_t got = input::read_some(from, file.string(), block.data(), block.size()))
    sink(std::string_view(block).substr(0, got));
}

/// Copies files from the candidate's directory to the reference's, and writes the reason beside them.
/// @param names  the files; the last one is the seal
void replace_files(const fs::path& reference, const fs::path& candidate, std::vector<std::string_view> names,
                   const std::string& reason) {
  const Json history = history_in(reference / kNotes);
  names.insert(names.begin(), kNotes);
  FileSet files(reference, names);
  files.add(kNotes, notes(history, reason));
  for (const std::string_view name : names)
    if (name != kNotes && is_there(candidate / name))
      files.add(name, [&](const FileSet::Sink& sink) { copy(candidate / name, sink); });
  files.commit();
}

/// Refuses results that cannot be a reference: those that do not agree with themselves, and incomplete ones.
void require_sound(const fs::path& candidate) {
  CompareOptions options;
  options.tolerances.profile = Profile::bitwise;
  for (const PairReport& pair : compare_results(candidate, candidate, options).pairs) {
    if (!pair.refusal.empty()) refuse_path(candidate, pair.refusal);
    for (const CompareFinding& finding : pair.findings) refuse_path(pair.candidate, finding.text);
    for (const QuantityVerdict& quantity : pair.quantities)
      if (!quantity.passed) refuse_path(pair.candidate, fmt::format("{}: {}", quantity.name, quantity.reason));
    if (kind_of(pair.candidate) != ComparandKind::results) continue;
    const Comparand results = open_comparand(pair.candidate, nullptr);
    if (results.word("/outcome/status") != "completed")
      refuse_path(pair.candidate, "its run was not completed; no reference is made of it");
    for (const char* key : {"scenario", "drift", "motion", "invariants", "solution", "provenance"})
      if (!results.summary->contains(key) || results.summary->at(key).is_null())
        refuse_path(pair.candidate, fmt::format("its summary has no \"{}\"; run the scenario again", key));
    const auto rows = results.open_rows();
    for (std::size_t i = 0; i < trajectory_table().columns.size(); ++i)
      if (const Measure& measure = trajectory_table().measure_of(i);
          !rows->has_column(i) && (!measure.of_contact || results.summary->contains("contact")))
        refuse_path(pair.candidate,
                    fmt::format("its trajectory.csv has no {}; run the scenario again", trajectory_table().columns[i]));
  }
}

/// Refuses a place that cannot become a reference of this kind: it may be missing, empty, or a reference of the kind already.
void require_kind(const fs::path& reference, ComparandKind kind) {
  std::error_code error;
  if (is_there(reference) && !fs::is_directory(reference, error)) refuse_path(reference, "is a file; give a directory");
  const bool other = kind == ComparandKind::store ? is_there(reference / "summary.json") : is_there(study_store(reference));
  if (other) refuse_path(reference, "is a reference of another kind; choose another place");
}

std::string update_one(const fs::path& reference, const fs::path& candidate, const std::string& reason) {
  const ComparandKind kind = kind_of(candidate);
  if (kind == ComparandKind::store) {
    std::error_code error;
    const fs::path from = fs::is_directory(candidate, error) ? candidate : candidate.parent_path();
    const fs::path to = reference.filename() == study_store({}).filename() ? reference.parent_path() : reference;
    if (!fs::is_directory(candidate, error) && candidate.filename() != study_store({}).filename())
      refuse_path(candidate, "give the study's directory, or its study.sqlite");
    require_kind(to, kind);
    for (const fs::path& side : {from, to})
      for (const char* log : {"study.sqlite-wal", "study.sqlite-shm"})
        if (is_there(side / log))
          refuse_path(side, fmt::format("{} in it says that its store is in use; wait for the end", log));
    replace_files(to, from, {"study.csv", "study.json", "study.svg", "study.sqlite"}, reason);
    return to.string();
  }
  if (kind != ComparandKind::results)
    refuse_path(candidate,
                "cannot be a reference; give a directory that `earthtop run` has written, a study's, or one of several");
  if (reference.extension() == ".json") {
    write_file(reference, compact_reference(open_comparand(candidate, nullptr), history_in(reference), reason));
    return reference.string();
  }
  require_kind(reference, kind);
  replace_files(reference, candidate, {"trajectory.csv", "torques.csv", "drift.svg", "timing.json", "summary.json"}, reason);
  return reference.string();
}

}  // namespace
}  // namespace compare

std::vector<std::string> update_reference(const std::filesystem::path& reference, const std::filesystem::path& candidate,
                                          const std::string& reason) {
  using namespace compare;
  if (reason.find_first_not_of(" \t\r\n") == std::string::npos)
    throw ScenarioError("", "a new reference needs a reason; give one with --reason TEXT");
  require_sound(candidate);
  std::vector<std::string> written;
  if (kind_of(candidate) != ComparandKind::collection) {
    written.push_back(update_one(reference, candidate, reason));
    return written;
  }
  const bool holds_many =
      std::filesystem::is_directory(reference) && !is_there(reference / "summary.json") && !is_there(study_store(reference));
  if (is_there(reference) && !holds_many)
    refuse_path(reference, "is one reference, where the new results are several; give a directory");
  for (const auto& [name, path] : members(candidate)) {
    fs::path there = reference / name;
    if (!is_there(there) && kind_of(path) == ComparandKind::results) there += ".json";
    written.push_back(update_one(there, path, reason));
  }
  return written;
}

}  // namespace earthtop
