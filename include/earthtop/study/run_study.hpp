// SPDX-License-Identifier: GPL-3.0-or-later
/// Runs a study: distributes its points to workers and keeps the results in a store, so that an interrupted study can be
/// resumed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "earthtop/study/processes.hpp"
#include "earthtop/watch.hpp"

namespace earthtop {

/// A part of a study, to be computed by itself: every n-th point, starting at the k-th, where k counts from 1.
struct StudyShard {
  std::uint64_t k = 1, n = 1;
  bool has(std::uint64_t number) const { return number % n == k - 1; }
  bool is_whole() const { return n == 1; }
};

struct StudyProgress {
  std::uint64_t wanted = 0;  ///< points of the shard
  std::uint64_t before = 0;  ///< points that the store held at the start
  std::uint64_t done = 0;    ///< points computed since the start
  std::uint64_t failed = 0;  ///< points that failed, among those computed since the start
  double seconds = 0;        ///< time since the start (s)
  double share = 0;          ///< finished share of the wanted points (0 to 1), parts of points included; never falls
  double share_before = 0;   ///< share of the wanted points that the store held at the start (0 to 1)
};

/// What an older store gave to a study whose design has changed.
struct StudyGrowth {
  std::filesystem::path from;
  std::uint64_t points = 0;    ///< points of the new design (of the shard)
  std::uint64_t reused = 0;    ///< those among them that were copied
  std::uint64_t held = 0;      ///< points of the older store that have a scenario
  std::uint64_t left_out = 0;  ///< those among them that the new design lacks
  bool replaced = false;       ///< the older store has made room, and its points that were left out are lost
  std::string why;             ///< why nothing, or not all, was reused, in words; empty where there is nothing to say
};

struct StudyRunOptions {
  std::filesystem::path dir;  ///< directory of the store and of the results
  unsigned jobs = 0;          ///< number of threads; 0: one per core
  StudyShard shard;
  bool force = false;                                     ///< discard a store that holds another study
  bool keep_going = false;                                ///< compute the study even if all points sampled are refused
  bool retry_failed = false;                              ///< compute failed points again
  bool repair = false;                                    ///< keep the intact points of a damaged store, and compute the others
  std::function<void(const StudyProgress&)> on_progress;  ///< called a few times a second; may be null
  Watch watch;                                            ///< may end the study early; reports nothing: see `on_progress`
  StudyProcesses* processes = nullptr;                    ///< if it has workers, these compute instead of threads
  std::filesystem::path reuse;  ///< an older store (or its directory) whose points are copied where they fit; may be empty
  std::function<void(const StudyGrowth&)> on_growth;  ///< called before points are computed, once an older store; may be null
};

struct StudyRunReport {
  std::filesystem::path store;
  StudyProgress progress;
  std::uint64_t failed = 0;  ///< number of failed points in the store, from earlier calls too
  bool interrupted = false;
  bool replaced = false;            ///< a store of another study in which no run had been completed has been replaced
  std::string damage;               ///< of a store that has been repaired: what was wrong with it, in words; else empty
  bool has_checksums = true;        ///< false: the store is from before points were stored with checksums
  std::vector<StudyGrowth> growth;  ///< what older stores gave; empty where there was none
  bool complete() const { return progress.before + progress.done >= progress.wanted; }
};

/// Path of the file that holds the points of a study, or of one shard of it.
std::filesystem::path study_store(const std::filesystem::path& dir, const StudyShard& shard = {});

/// The store that a path names: the path itself, or what `study_store` says of a directory.
/// @throws ScenarioError, ReadError where the path cannot be looked at
std::filesystem::path store_at(const std::filesystem::path& given);

/// Computes those points of a study that its store lacks. Each point's result depends on that point alone, and is stored within
/// about a second after it has been computed. A store of another study is replaced if none of its runs was completed. A store of
/// another design of the study grows: a point is copied if its scenario, as written for the run, is the same, if the same build
/// computed it in the same way, and if it has every quantity; the others are computed.
/// Every point that the store has already is first checked against its checksum.
/// @throws ScenarioError if the study exceeds its limits or the space left on the disk, if all points of `sample_points` are
/// refused for the same reason and no run of this study has been completed yet (unless `keep_going`), if the store holds
/// another study or points that the design lacks (unless `force`), if it is damaged (unless `repair`), or if another process writes to the store
/// @throws WriteError if a file cannot be written
StudyRunReport run_study(const Study& study, const StudyRunOptions& options);

/// Merges stores of one study (its shards, or any other parts of it) into one store in `dir`. Stores of unlike designs are merged
/// into that of the design among them that has the points of all.
/// @param force discard a store of another study that is there already
/// @returns the number of points in the merged store
/// @throws ScenarioError if points of a store fit into no design, with the key that differs; if a store is damaged, or if none is
/// given; WriteError
std::uint64_t merge_study_stores(const std::vector<std::filesystem::path>& stores, const std::filesystem::path& dir,
                                 bool force);

/// The findings of a check of a store: whether every point is what was stored, and none is missing.
struct StudyStoreCheck {
  std::string damage;         ///< what is wrong, with the numbers of the points, and the remedy; empty where nothing is
  bool has_checksums = true;  ///< false: a store from before points were stored with checksums, of which nothing is known
  std::string note;           ///< a sentence on that; empty where it has checksums
};
/// Reads all points of a store and holds them against their checksums.
/// @throws ScenarioError if it is not a store, or if its record of its study is damaged
StudyStoreCheck check_study_store(const std::filesystem::path& store);

/// The study of a store and its results so far, as JSON: counts, statistics, fits, Sobol indices, figures, and every single
/// point if there are at most 1000. Damaged points are left out. Ends with a newline The same points give the same bytes.
/// @param watch may stop the reading   @throws Interrupted
std::string study_json(const std::filesystem::path& store, const Watch& watch = {});

/// Writes the results beside the store: study.csv (one line per point), study.json, and study.svg if a few curves can show the
/// study.
/// @param watch may stop the writing before any file is in place
/// @param force  overwrite files that are not this study's results as they were written
/// @throws ScenarioError as `check_study_results`; WriteError, Interrupted
void write_study_results(const std::filesystem::path& store, const Watch& watch = {}, bool force = false);

/// Checks that the results of a study may be written to a directory. To be called before the points are computed.
/// @throws ScenarioError if one of the files is there and is not what was written for this study (unless `force`); ReadError
void check_study_results(const std::filesystem::path& dir, const Study& study, bool force);

/// Passes the document of `study_json` with every point, however many, and without checksums to `sink`, piece by piece. A point
/// that failed has its `reason`, too.
void study_whole_json(const std::filesystem::path& store, const std::function<void(std::string_view)>& sink);

/// JSON Schema (draft 7) of the document of a study's results, and every key of it as a Markdown table.
std::string study_results_schema();
std::string study_results_reference_markdown();

/// Passes the table of the points (study.csv) to `sink`, piece by piece.
void study_csv(const std::filesystem::path& store, const std::function<void(std::string_view)>& sink);

}  // namespace earthtop
