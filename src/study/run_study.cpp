// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/study/run_study.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <thread>

#include "earthtop/error.hpp"
#include "earthtop/run.hpp"
#include "input/file.hpp"
#include "results/file_set.hpp"
#include "study/process_workforce.hpp"
#include "study/store.hpp"
#include "study/store_lock.hpp"
#include "study/workforce.hpp"

namespace earthtop {
namespace study {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

void make_directory(const fs::path& dir) {
  std::error_code error;
  fs::create_directories(dir, error);
  if (error) fail_to_write(dir, error.value());
}

void remove_store(const fs::path& file) {
  std::error_code ignored;
  for (const char* suffix : {"", "-wal", "-shm", "-journal"}) fs::remove(file.string() + suffix, ignored);
}

/// Whether a file is a database without tables, as a process leaves behind that is killed at the very beginning.
bool is_blank(const fs::path& file) {
  try {
    sqlite::Connection connection(file.string(), sqlite::Connection::Mode::read);
    sqlite::Statement tables(connection, "SELECT count(*) FROM sqlite_master");
    return tables.step() && tables.integer(0) == 0;
  } catch (const sqlite::DamageError&) {
    return false;
  }
}

/// Whether a store is at the path. @throws ScenarioError where something else is; ReadError
bool is_there(const fs::path& file) {
  const input::PathType type = input::type_of(file.string());
  if (type == input::PathType::nothing || type == input::PathType::file) return type == input::PathType::file;
  refuse_file(file, "is not a file, or is a link that leads nowhere; remove it, or choose another --out");
}

/// @throws ScenarioError if the disk has no room for the study's results
void require_room(const fs::path& dir, double bytes) {
  std::error_code error;
  fs::path present = fs::absolute(dir, error).lexically_normal();
  while (!fs::exists(present, error) && present.has_relative_path()) present = present.parent_path();
  const fs::space_info space = fs::space(present, error);
  if (!error && bytes > static_cast<double>(space.available))
    refuse_file(dir, fmt::format("has {:.2g} GB left, and the study takes about {:.2g} GB; make room, or choose another --out",
                                 static_cast<double>(space.available) / 1e9, bytes / 1e9));
}

/// Whether the store holds a point whose run was completed, or cannot say.
bool may_hold_results(Store& store) {
  try {
    return store.ended_count() > 0;
  } catch (const sqlite::DamageError&) {
    return true;
  }
}

/// Whether the store holds a point of this study whose run was completed.
bool is_under_way(const fs::path& file, const Study& study) {
  if (!is_there(file) || is_blank(file)) return false;
  Store store = Store::open(file, sqlite::Connection::Mode::read);
  return store.sha256() == study_sha256(study) && may_hold_results(store);
}

/// @param replaced set if a store of another study was replaced because none of its runs had been completed
Store open_or_create(const fs::path& file, const Study& study, const StudyRunOptions& options, bool& replaced) {
  if (is_there(file) && is_blank(file)) remove_store(file);
  if (!is_there(file)) return Store::create(file, study, options.shard);
  const std::string sha256 = study_sha256(study);
  try {
    Store store = Store::open(file, sqlite::Connection::Mode::write);
    if (store.sha256() == sha256) {
      store.adopt(study);
      return store;
    }
    replaced = !may_hold_results(store);
  } catch (const ScenarioError&) {
    if (!options.force) throw;
  }
  if (!options.force && !replaced)
    refuse_file(file,
                "holds the points of another study, or of a base that has changed since; choose another --out, or --force to "
                "discard them and start again");
  remove_store(file);
  return Store::create(file, study, options.shard);
}

/// Copies the intact points with numbers from `first` to `last` from a damaged store. Where a part of the file cannot be read,
/// smaller and smaller spans are tried.
void copy_intact(Store& damaged, Store& fresh, std::uint64_t first, std::uint64_t last) {
  try {
    std::vector<PointResult> found;  // all of them or none: an error may come in the middle
    Store::Points points = damaged.points(first, last);
    for (PointResult point; points.next(point);) found.push_back(point);
    for (const PointResult& point : found) fresh.insert(point);
  } catch (const sqlite::DamageError&) {
    if (first == last) return;
    const std::uint64_t middle = first + (last - first) / 2;
    copy_intact(damaged, fresh, first, middle);
    copy_intact(damaged, fresh, middle + 1, last);
  }
}

/// Replaces a damaged store by a new one with its intact points.
void repair(const fs::path& file, const Study& study, const StudyShard& shard) {
  const fs::path next = file.string() + ".repaired";
  remove_store(next);
  {
    Store fresh = Store::create(next, study, shard);
    fresh.begin();
    try {
      Store damaged = Store::open_damaged(file, study);
      constexpr std::uint64_t kSpan = 4096;
      const std::uint64_t count = point_count(study).value_or(0);
      for (std::uint64_t first = 0; first < count; first += kSpan)
        copy_intact(damaged, fresh, first, std::min(count, first + kSpan) - 1);
    } catch (const sqlite::DamageError&) {  // it is not a database any more: nothing can be kept
    }
    fresh.commit();
    fresh.finish();
  }
  remove_store(file);
  std::error_code error;
  fs::rename(next, file, error);
  if (error) fail_to_write(file, error.value());
}

/// Says what is wrong with the store of a study; empty where nothing is, or where there is no store of this study.
std::string damage_of(const fs::path& file, const Study& study) {
  if (!is_there(file) || is_blank(file)) return "";
  try {
    Store store = Store::open(file, sqlite::Connection::Mode::read);
    if (store.sha256() != study_sha256(study)) return "";
    const StoreCheck check = store.check();
    return check.is_damaged() ? check.text() : "";
  } catch (const ScenarioError& what) {
    return what.diagnostics().front().message;
  }
}

/// Hands out the points that the store lacks, in ascending order.
class MissingPoints {
 public:
  MissingPoints(const Study& study, std::uint64_t count, const StudyShard& shard, Store& store)
      : design_(study), count_(count), shard_(shard), store_(store), at_(shard.k - 1) {}

  bool all_given() const { return at_ >= count_; }
  std::uint64_t left() const { return all_given() ? 0 : (count_ - at_) / shard_.n + 1; }  ///< an upper bound
  Chunk next(std::size_t most) {
    Chunk chunk;
    while (chunk.size() < most && !all_given()) {
      if (at_ >= known_until_) look_ahead();
      if (!std::binary_search(known_.begin(), known_.end(), at_)) chunk.push_back(design_.point(at_));
      at_ += shard_.n;
    }
    return chunk;
  }

 private:
  void look_ahead() {
    constexpr std::uint64_t kAhead = 4096;
    known_until_ = std::min(count_, at_ + kAhead * shard_.n);
    known_ = store_.numbers(at_, known_until_);
  }
  Design design_;
  std::uint64_t count_;
  StudyShard shard_;
  Store& store_;
  std::uint64_t at_, known_until_ = 0;
  std::vector<std::uint64_t> known_;  // numbers of the points in the store, from the last look-ahead up to `known_until_`
};

/// The main loop of the process that holds the store: hands out chunks and stores results.
StudyProgress run_points(const Study& study, const StudyRunOptions& options, Store& store, Workforce& workforce,
                         unsigned workers, double seconds_a_point) {
  const std::uint64_t count = point_count(study).value_or(0);
  const StudyShard& shard = options.shard;
  StudyProgress progress;
  progress.wanted = count < shard.k ? 0 : (count - shard.k) / shard.n + 1;
  progress.before = store.count();
  MissingPoints missing(study, count, shard, store);
  ChunkSize size(seconds_a_point, workers);
  const auto start = Clock::now();
  auto last_told = start, last_commit = start - std::chrono::hours(1);  // so that the first results are stored immediately
  bool open_transaction = false;
  constexpr double kCommitEvery_s = 0.25, kTellEvery_s = 0.2;
  while (true) {
    while (!options.watch.asks_to_stop() && !missing.all_given() && workforce.wants_work()) {
      Chunk chunk = missing.next(size.points(missing.left()));
      if (!chunk.empty()) workforce.give(std::move(chunk));
    }
    const bool ends = workforce.under_way() == 0;
    const std::vector<PointResult> results = workforce.collect(std::chrono::milliseconds(ends ? 0 : 50));
    if (!results.empty() && !open_transaction) {
      store.begin();
      open_transaction = true;
    }
    for (const PointResult& point : results) {
      store.insert(point);
      ++progress.done;
      if (point.failed()) ++progress.failed;
    }
    progress.seconds = seconds_since(start);
    const auto wanted = static_cast<double>(std::max<std::uint64_t>(progress.wanted, 1));
    progress.share_before = static_cast<double>(progress.before) / wanted;
    const double there = static_cast<double>(progress.before + progress.done) + workforce.points_begun();
    progress.share = std::max(progress.share, std::min(1.0, there / wanted));
    if (!results.empty()) size.learn(progress.done, progress.seconds);
    if (open_transaction && (ends || seconds_since(last_commit) > kCommitEvery_s)) {
      store.commit();
      open_transaction = false;
      last_commit = Clock::now();
    }
    if (options.on_progress && (ends || seconds_since(last_told) > kTellEvery_s)) {
      options.on_progress(progress);
      last_told = Clock::now();
    }
    if (ends && (options.watch.asks_to_stop() || missing.all_given())) return progress;
  }
}

}  // namespace
}  // namespace study

std::filesystem::path study_store(const std::filesystem::path& dir, const StudyShard& shard) {
  return dir / (shard.is_whole() ? std::string("study.sqlite") : fmt::format("shard-{}-of-{}.sqlite", shard.k, shard.n));
}

std::filesystem::path store_at(const std::filesystem::path& given) {
  return input::type_of(given.string()) == input::PathType::directory ? study_store(given) : given;
}

StudyRunReport run_study(const Study& study, const StudyRunOptions& options) {
  using namespace earthtop::study;
  require_affordable(study);
  const StudyEstimate expected = estimate(study);
  require_room(options.dir, expected.disk_bytes / static_cast<double>(options.shard.n));
  StudyRunReport report;
  report.store = study_store(options.dir, options.shard);
  std::optional<StoreLock> lock;
  if (options.repair) {
    make_directory(options.dir);
    lock.emplace(report.store);
    report.damage = damage_of(report.store, study);
    if (!report.damage.empty()) repair(report.store, study, options.shard);
  }
  if (!options.keep_going)
    if (const auto refusal = sample_points(study).common; refusal && !is_under_way(report.store, study)) throw *refusal;
  make_directory(options.dir);
  if (!lock) lock.emplace(report.store);
  Store store = open_or_create(report.store, study, options, report.replaced);
  report.has_checksums = store.check_intact().has_checksums;
  if (options.retry_failed) store.remove_failed();
  const bool spread_out = options.processes && options.processes->workers() > 0;
  const unsigned cores = std::max(1U, std::thread::hardware_concurrency());
  const unsigned workers = spread_out ? options.processes->workers() : options.jobs > 0 ? options.jobs : cores;
  const auto workforce =
      spread_out ? make_processes(study, *options.processes, options.watch) : make_threads(study, workers, options.watch);
  const double seconds_a_point = expected.core_seconds / static_cast<double>(expected.points);
  report.progress = run_points(study, options, store, *workforce, workers, seconds_a_point);
  report.failed = store.failed_count();
  report.interrupted = options.watch.asks_to_stop();
  store.finish();
  return report;
}

std::uint64_t merge_study_stores(const std::vector<std::filesystem::path>& stores, const std::filesystem::path& dir,
                                 bool force) {
  using namespace earthtop::study;
  if (stores.empty()) throw ScenarioError("", "there is no store to merge");
  const fs::path target = study_store(dir);
  for (const fs::path& part : stores) {
    std::error_code error;
    if (fs::equivalent(part, target, error)) refuse_file(part, "is the merged store itself; choose another --out");
  }
  std::optional<Store> first = Store::open(stores.front(), sqlite::Connection::Mode::read);
  for (const fs::path& part : stores) {
    Store store = Store::open(part, sqlite::Connection::Mode::read);
    if (store.sha256() != first->sha256())
      refuse_file(part, fmt::format("holds points of another study than {}", stores.front().string()));
    store.check_intact();
  }
  check_study_results(dir, first->study(), force);
  make_directory(dir);
  const StoreLock lock(target);
  StudyRunOptions options;
  options.force = force;
  bool replaced = false;
  Store merged = open_or_create(target, first->study(), options, replaced);
  merged.check_intact();
  for (const fs::path& part : stores) {
    Store store = Store::open(part, sqlite::Connection::Mode::read);
    merged.begin();
    store.for_each([&](const PointResult& point) { merged.insert(point); });
    merged.commit();
  }
  const std::uint64_t count = merged.count();
  merged.finish();
  return count;
}

}  // namespace earthtop
