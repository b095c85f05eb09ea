// SPDX-License-Identifier: GPL-3.0-or-later
/// Computes a study: points to workers, results into the store, whatever interrupts it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "earthtop/study/processes.hpp"
#include "earthtop/watch.hpp"

namespace earthtop {

/// Every n-th point of a study from the k-th on, counted from 1.
struct StudyShard {
  std::uint64_t k = 1, n = 1;
  bool has(std::uint64_t number) const { return number % n == k - 1; }
  bool is_whole() const { return n == 1; }
};

struct StudyProgress {
  std::uint64_t wanted = 0;  ///< points of the shard
  std::uint64_t before = 0;  ///< that were there at the start
  std::uint64_t done = 0;    ///< computed since
  std::uint64_t failed = 0;  ///< of those
  double seconds = 0;        ///< since the start
  double share = 0;          ///< of the wanted points, parts of those under way included; it never falls
  double share_before = 0;   ///< of those that were there at the start
};

struct StudyRunOptions {
  std::filesystem::path dir;  ///< of store and results
  unsigned jobs = 0;          ///< threads; 0: one a core
  StudyShard shard;
  bool force = false;                                     ///< throw a store of another study away
  bool keep_going = false;                                ///< compute a study even if all points looked at are refused
  bool retry_failed = false;                              ///< compute failed points again
  std::function<void(const StudyProgress&)> on_progress;  ///< some times a second; may be null
  Watch watch;                                            ///< may end it early; where it is is told by `on_progress`
  StudyProcesses* processes = nullptr;                    ///< whose workers compute, if there are any, instead of threads
};

struct StudyRunReport {
  std::filesystem::path store;
  StudyProgress progress;
  std::uint64_t failed = 0;  ///< of all points in the store
  bool interrupted = false;
  bool replaced = false;  ///< another study's store, without a point that came to its end, has made room
  bool complete() const { return progress.before + progress.done >= progress.wanted; }
};

/// The file that a study's points, or a shard's, are kept in.
std::filesystem::path study_store(const std::filesystem::path& dir, const StudyShard& shard = {});

/// Computes the points that the store lacks. Each point's result depends on that point alone; the store holds each within a
/// second or so of its being computed.
/// A store of another study that holds no point whose run came to its end is replaced.
/// @throws ScenarioError for a study beyond its limits, for one of which all points of `sample_points` are refused alike before
/// any point of it has been computed (unless it is to keep going), for a store of another study (unless forced), or one that
/// another process writes; WriteError
StudyRunReport run_study(const Study& study, const StudyRunOptions& options);

/// Puts stores of one study together, shards of it or any parts.
/// @returns how many points the result holds   @throws ScenarioError for stores of different studies, or none; WriteError
std::uint64_t merge_study_stores(const std::vector<std::filesystem::path>& stores, const std::filesystem::path& dir,
                                 bool force);

/// The store's study, and its results so far: counts, statistics, fits, indices, figures; of at most 1000 points each point.
/// As JSON with a final newline; the same points give the same bytes.
std::string study_json(const std::filesystem::path& store);

/// Writes study.csv, one line a point, study.json, and where a few curves show it all study.svg, beside the store. @throws
/// WriteError, Interrupted
/// @param watch  may end it before anything is in place
void write_study_results(const std::filesystem::path& store, const Watch& watch = {});

/// The table of the points alone, piece by piece.
void study_csv(const std::filesystem::path& store, const std::function<void(std::string_view)>& sink);

}  // namespace earthtop
