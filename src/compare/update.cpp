// SPDX-License-Identifier: GPL-3.0-or-later
// Replaces references by new results, and keeps the reason for each change.
#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>

#include "compare/compact_reference.hpp"
#include "compare/replacement.hpp"
#include "compare/snapshot.hpp"
#include "earthtop/compare/compare.hpp"
#include "earthtop/error.hpp"
#include "earthtop/results/results.hpp"
#include "earthtop/study/run_study.hpp"
#include "results/seal.hpp"
#include "text/json.hpp"

namespace earthtop {
namespace compare {
namespace {

constexpr std::array<std::string_view, 5> kResultFiles = {"trajectory.csv", "torques.csv", "drift.svg", "timing.json",
                                                          "summary.json"};
constexpr std::array<std::string_view, 3> kStudyFiles = {"study.csv", "study.json", "study.svg"};
constexpr std::string_view kNotes = "reference.json";  // beside the files of a reference that is a directory
constexpr const char* kNotesSchema = "earthtop-reference-notes-1.json";

Json history_in(const fs::path& file) {
  if (!is_there(file)) return Json::array();
  const Json json = read_json_file(file, "reference");
  const std::string schema = json.value("$schema", Json()).is_string() ? json.at("$schema").get<std::string>() : "";
  if (schema != kReferenceSchema && schema != kNotesSchema)
    refuse_file(file, "already exists, and is not a reference; choose another place");
  return json.contains("history") && json.at("history").is_array() ? json.at("history") : Json::array();
}

/// Refuses results that cannot be a reference: those that do not agree with themselves, and incomplete ones.
void require_sound(const fs::path& candidate, const Watch& watch) {
  CompareOptions options;
  options.watch = watch;
  options.tolerances.profile = Profile::bitwise;
  for (const PairReport& pair : compare_results(candidate, candidate, options).pairs) {
    if (!pair.refusal.empty()) refuse_file(candidate, pair.refusal);
    for (const CompareFinding& finding : pair.findings) refuse_file(pair.candidate, finding.text);
    for (const QuantityVerdict& quantity : pair.quantities)
      if (!quantity.passed) refuse_file(pair.candidate, fmt::format("{}: {}", quantity.name, quantity.reason));
    if (kind_of(pair.candidate) != ComparandKind::results) continue;
    const Comparand results = open_comparand(pair.candidate, nullptr);
    if (results.word("/outcome/status") != "completed")
      refuse_file(pair.candidate, "its run was not completed, so that it cannot become a reference");
    for (const char* key : {"scenario", "drift", "motion", "invariants", "solution", "provenance"})
      if (!results.summary->contains(key) || results.summary->at(key).is_null())
        refuse_file(pair.candidate, fmt::format("its summary has no \"{}\"; run the scenario again", key));
    const auto rows = results.open_rows();
    for (std::size_t i = 0; i < trajectory_table().columns.size(); ++i)
      if (const Measure& measure = trajectory_table().measure_of(i);
          !rows->has_column(i) && (measure.owner == RowOwner::every_top || results.summary->contains(name_of(measure.owner))))
        refuse_file(pair.candidate,
                    fmt::format("its trajectory.csv has no {}; run the scenario again", trajectory_table().columns[i]));
  }
}

std::string notes(Json history, const std::string& reason) {
  const Json document = {{"$schema", kNotesSchema}, {"history", with_reason(std::move(history), reason)}};
  return written_replacing(document, 2) + '\n';
}

/// An update of one or several references within a root.
struct Update {
  Replacement& next;
  const std::string& reason;
  Watch watch;
  FileIdentities read;  ///< the files of which the new references are made
  bool has_changed = false;
};

/// Copies a file of a snapshot to the next version. @returns the checksum of its bytes
std::string put_copy(Update& update, const fs::path& name, const Snapshot::File& file) {
  const auto copy = [&](const FileSet::Sink& sink) {
    std::string block(std::size_t{1} << 20, '\0');
    while (const std::size_t got = input::read_some(*file.open, file.path.string(), block.data(), block.size()))
      sink(std::string_view(block).substr(0, got));
  };
  return update.next.put(name, copy).second;
}

void put_notes(Update& update, const fs::path& root, const fs::path& place) {
  const std::string text = notes(history_in(root / place / kNotes), update.reason);
  update.next.put(place / kNotes, [&](const FileSet::Sink& sink) { sink(text); });
}

/// Holds the files that were copied against the checksums in the summary.
/// @param copied  names and checksums   @throws ScenarioError if they are not those of one run
void require_whole(const fs::path& candidate, const FileChecksums& copied, const std::string& summary) {
  if (seal_of(summary) == Seal::absent) return;
  const FileChecksums stated = checksums_in(summary, candidate / "summary.json");
  for (const auto& [name, checksum] : stated) {
    const auto found = std::find_if(copied.begin(), copied.end(), [&, its = name](const auto& c) { return c.first == its; });
    if (found == copied.end())
      refuse_file(candidate, fmt::format("has no {}, which its summary names; run the scenario again", printable(name)));
    if (found->second != checksum) refuse_damaged(candidate / name);
  }
}

/// Puts the notes of a reference that changes; those of one that does not stay as they are.
template <class Names>
void put_notes_of_change(Update& update, const fs::path& root, const fs::path& place, const Names& names) {
  const bool has_changed =
      std::any_of(std::begin(names), std::end(names), [&](const auto& name) { return update.next.changes(place / name); });
  const bool had_notes = is_there(root / place / kNotes);
  put_notes(update, root, place);  // so that damaged ones are refused in any case
  if (!has_changed && had_notes) update.next.keep(place / kNotes);
  update.has_changed = has_changed || update.next.changes(place / kNotes);
}

/// Copies the results of a run. @param place  the reference's path below the root; may be empty
void put_results(Update& update, const fs::path& root, const fs::path& place, const fs::path& candidate) {
  const FileIdentities read = read_settled(candidate, kResultFiles, update.watch, [&](const Snapshot& snapshot) {
    require_sound(candidate, update.watch);
    FileChecksums copied;
    for (const Snapshot::File& file : snapshot.files()) {
      const fs::path name = file.path.filename();
      if (file.open)
        copied.emplace_back(name.string(), put_copy(update, place / name, file));
      else
        update.next.remove(place / name);
    }
    const std::string staged = update.next.staged(place / kResultFiles.back()).string();
    require_whole(candidate, copied, input::read_regular_file(staged, staged, {"summary", false, 64}));
  });
  update.read.insert(update.read.end(), read.begin(), read.end());
  put_notes_of_change(update, root, place, kResultFiles);
}

/// Whether two compact references differ in their history alone.
bool say_the_same(const std::string& one, const std::string& other) {
  const auto content = [](const std::string& text) {
    Json json = Json::parse(text, nullptr, false);
    if (json.is_object())
      for (const char* key : {"history", "checksum"}) json.erase(key);
    return json;
  };
  const Json a = content(one);
  return a.is_object() && a == content(other);
}

/// @param text  gets the compact reference that is made of the results   @returns the files of which it is made
FileIdentities make_compact(const fs::path& reference, const fs::path& candidate, const std::string& reason, const Watch& watch,
                            std::string& text) {
  const Json history = history_in(reference);
  return read_settled(candidate, kResultFiles, watch, [&](const Snapshot&) {
    require_sound(candidate, watch);
    text = compact_reference(open_comparand(candidate, nullptr), history, reason);
    if (!is_there(reference)) return;
    const std::string last = input::read_regular_file(reference.string(), reference.string(), {"reference", false, 64});
    if (seal_of(last) != Seal::broken && say_the_same(last, text)) text = last;
  });
}

/// Refuses a store to which a process writes, or whose last points are not in its file yet.
void require_at_rest(const fs::path& directory) {
  const fs::path store = study_store(directory);
  for (const char* log : {"-wal", "-shm", "-journal"})
    if (is_there(store.string() + log))
      refuse_file(directory, fmt::format("{}{} in it says that its store is in use; wait until that has ended",
                                         store.filename().string(), log));
  const int lock = ::open((store.string() + ".lock").c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
  if (lock < 0) {
    if (errno == ENOENT || errno == ENOTDIR || errno == EACCES) return;
    throw ReadError(store.string() + ".lock", std::strerror(errno));
  }
  const bool in_use = ::flock(lock, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(lock);
  if (in_use) refuse_file(directory, "a study is writing there; wait until it has ended, and repeat the command");
}

/// Copies the store of a study, and writes its table, document and picture anew from the copy.
void put_study(Update& update, const fs::path& root, const fs::path& place, const fs::path& candidate) {
  const fs::path name = study_store({});
  const std::array<std::string_view, 1> names = {name.native()};
  const FileIdentities read = read_settled(candidate, names, update.watch, [&](const Snapshot& snapshot) {
    require_at_rest(candidate);
    require_sound(candidate, update.watch);
    put_copy(update, place / name, snapshot.files().front());
    require_at_rest(candidate);
  });
  update.read.insert(update.read.end(), read.begin(), read.end());
  const fs::path staged = update.next.staged(place / name);
  if (const StudyStoreCheck check = check_study_store(staged); !check.damage.empty())
    throw ReadError(staged.string(), "is a copy that cannot be read back: " + check.damage);
  for (const std::string_view file : kStudyFiles) update.next.take(place / file);
  write_study_results(staged, update.watch);
  for (const std::string_view file : kStudyFiles)
    if (!is_there(update.next.staged(place / file))) update.next.remove(place / file);
  if (update.next.changes(place / name))
    put_notes(update, root, place);
  else
    put_notes_of_change(update, root, place, kStudyFiles);
  update.has_changed = update.has_changed || update.next.changes(place / name);
}

/// Refuses a place that cannot become a reference of this kind: it may be missing, empty, or a reference of the kind already.
void require_kind(const fs::path& reference, ComparandKind kind) {
  const input::PathType type = input::type_of(reference.string());
  if (type != input::PathType::nothing && type != input::PathType::directory)
    refuse_file(reference, "is a file; give a directory");
  const bool other = kind == ComparandKind::store ? is_there(reference / "summary.json") : is_there(study_store(reference));
  if (other) refuse_file(reference, "is a reference of another kind; choose another place");
  if (kind == ComparandKind::store) require_at_rest(reference);
}

[[noreturn]] void refuse_as_reference(const fs::path& candidate) {
  refuse_file(
      candidate,
      "cannot be a reference; give a directory that `earthtop run` or a study has written, or a directory of such directories");
}

/// Stages one of several references, or the only one. @param place  its path below the root; empty for the root itself
void put_one(Update& update, const fs::path& root, const fs::path& place, const fs::path& candidate, ComparandKind kind) {
  if (kind == ComparandKind::store || place.extension() != ".json") require_kind(root / place, kind);
  if (kind == ComparandKind::store) {
    put_study(update, root, place, candidate);
  } else if (place.extension() == ".json") {
    std::string text;
    const FileIdentities read = make_compact(root / place, candidate, update.reason, update.watch, text);
    update.next.put(place, [&](const FileSet::Sink& sink) { sink(text); });
    update.has_changed = update.next.changes(place);
    update.read.insert(update.read.end(), read.begin(), read.end());
  } else {
    put_results(update, root, place, candidate);
  }
}

/// Replaces a compact reference, which is one file. @returns whether it has changed
bool update_compact(const fs::path& reference, const fs::path& candidate, const std::string& reason, const Watch& watch) {
  const FileIdentity before = identity_of(reference);
  std::string next;
  make_compact(reference, candidate, reason, watch, next);
  if (is_there(reference) && input::read_regular_file(reference.string(), reference.string(), {"reference", false, 64}) == next)
    return false;
  write_file(reference, [&] {
    if (identity_of(reference) != before) refuse_file(reference, "has been changed in the meantime; repeat the command");
    return next;
  });
  return true;
}

/// Replaces a directory that is one reference. @returns its path, and whether it has changed
std::pair<fs::path, bool> update_directory(const fs::path& reference, const fs::path& given, ComparandKind kind,
                                           const std::string& reason, const Watch& watch) {
  fs::path root = reference, candidate = given;
  if (kind == ComparandKind::store) {
    const bool is_file = input::type_of(given.string()) != input::PathType::directory;
    if (is_file && given.filename() != study_store({}).filename())
      refuse_file(given, "give the study's directory, or its study.sqlite");
    if (is_file) candidate = given.has_parent_path() ? given.parent_path() : fs::path(".");
    if (reference.filename() == study_store({}).filename())
      root = reference.has_parent_path() ? reference.parent_path() : fs::path(".");
  }
  require_kind(root, kind);
  Replacement next(root, watch);
  Update update{next, reason, watch, {}, false};
  put_one(update, root, {}, candidate, kind);
  next.commit();
  return {root, update.has_changed};
}

/// Replaces all references of a directory for which there are new results, and adds those that it has not.
std::vector<std::string> update_collection(const fs::path& reference, const fs::path& candidate, const std::string& reason,
                                           const Watch& watch, std::vector<std::string>& unchanged) {
  const input::PathType type = input::type_of(reference.string());
  const bool holds_many =
      type == input::PathType::directory && !is_there(reference / "summary.json") && !is_there(study_store(reference));
  if (type != input::PathType::nothing && !holds_many)
    refuse_file(reference, "is a single reference, but there are several new results; give a directory");
  if (holds_many) members(reference);  // brings updates of single ones to their end
  Replacement next(reference, watch);
  struct Member {
    fs::path place, candidate;
    ComparandKind kind;
    FileIdentities read = {};
    bool has_changed = true;
  };
  std::vector<Member> all;
  std::vector<std::string> written;
  for (const auto& [name, path] : members(candidate)) {
    const ComparandKind kind = kind_of(path);
    if (kind != ComparandKind::results && kind != ComparandKind::store) refuse_as_reference(path);
    fs::path place = name;
    if (kind == ComparandKind::results && !is_there(reference / place)) place += ".json";
    all.push_back({place, path, kind});
  }
  // A result that has been rewritten since it was read is read again, until all of them have been there together.
  constexpr int kAttempts = 4;
  bool has_changed = true;
  for (int attempt = 1; has_changed && attempt <= kAttempts; ++attempt) {
    has_changed = false;
    for (Member& member : all) {
      if (!member.read.empty() && are_current(member.read)) continue;
      Update update{next, reason, watch, {}, false};
      put_one(update, reference, member.place, member.candidate, member.kind);
      member.read = std::move(update.read);
      member.has_changed = update.has_changed;
      has_changed = true;
    }
  }
  if (has_changed) refuse_under_way(candidate);
  next.commit();
  for (const Member& member : all) (member.has_changed ? written : unchanged).push_back((reference / member.place).string());
  return written;
}

}  // namespace
}  // namespace compare

std::vector<std::string> update_reference(const std::filesystem::path& reference, const std::filesystem::path& candidate,
                                          const std::string& reason, const Watch& watch, std::vector<std::string>* unchanged) {
  using namespace compare;
  if (reason.find_first_not_of(" \t\r\n") == std::string::npos)
    throw ScenarioError("", "a new reference needs a reason; give one with --reason TEXT");
  finish_update(candidate);
  finish_update(reference);
  const ComparandKind kind = kind_of(candidate);
  if (const FileIdentity there = identity_of(reference);
      there.inode != 0 && there.inode == identity_of(candidate).inode && there.device == identity_of(candidate).device)
    refuse_file(candidate, "is the reference itself; give new results");
  std::vector<std::string> same;
  std::vector<std::string>& kept = unchanged != nullptr ? *unchanged : same;
  if (kind == ComparandKind::collection) return update_collection(reference, candidate, reason, watch, kept);
  if (kind != ComparandKind::results && kind != ComparandKind::store) {
    require_sound(candidate, watch);
    refuse_as_reference(candidate);
  }
  if (kind == ComparandKind::results && reference.extension() == ".json") {
    if (update_compact(reference, candidate, reason, watch)) return {reference.string()};
    kept.push_back(reference.string());
    return {};
  }
  const auto [root, has_changed] = update_directory(reference, candidate, kind, reason, watch);
  if (has_changed) return {root.string()};
  kept.push_back(root.string());
  return {};
}

}  // namespace earthtop
