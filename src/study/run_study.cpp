// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/study/run_study.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <thread>

#include "earthtop/error.hpp"
#include "earthtop/results/output_files.hpp"
#include "earthtop/run.hpp"
#include "input/file.hpp"
#include "results/file_set.hpp"
#include "results/seal.hpp"
#include "study/growth.hpp"
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

/// Refuses to replace a store by one of another design. @param here  what the points would be lost to, in words
[[noreturn]] void refuse_loss(const fs::path& file, const Study& there, const Study& here, const StudyGrowth& growth) {
  const std::string key = difference(there, here);
  const std::string where = key.empty() ? "" : fmt::format(" ({})", key);
  const std::string why = growth.why.empty() ? "" : "; " + growth.why;
  if (growth.reused == 0)
    refuse_file(
        file, fmt::format("holds the points of another study, or of a base that has changed since{}{}; all {} of them would be "
                          "lost; choose another --out, or --force to discard them and start again",
                          where, why, growth.held));
  refuse_file(
      file,
      fmt::format("holds {} points of another study or another design; this one lacks {} of them{}{}, which would be lost; "
                  "choose another --out, with --reuse {} to copy the others, or --force to lose them",
                  growth.held, growth.left_out, where, why, printable(file.string())));
}

/// Replaces a store by one of another design that has the points shared. It is put in place at once and complete: who is killed
/// before has the older store, who is killed later goes on with the new one.
void grow(const fs::path& file, const Study& study, const StudyShard& shard, const SharedPoints& shared) {
  const fs::path next = file.string() + ".grown";
  remove_store(next);
  {
    Store older = Store::open(file, sqlite::Connection::Mode::write);
    Store fresh = Store::create(next, study, shard, older.identities());
    fresh.begin();
    copy_shared(shared, older, study, fresh);
    fresh.commit();
    fresh.finish();
    older.finish();
  }
  if (is_something_at(file.string() + "-wal")) {  // SQLite would take it for the new file's
    remove_store(next);
    refuse_file(file, "is being read by another process; try again when that has ended");
  }
  std::error_code error;
  fs::rename(next, file, error);
  if (error) fail_to_write(file, error.value());
}

/// Opens the store of a study. One of another study makes room if none of its runs was completed or with `force`; one of another
/// design of this study grows if no point is lost, or with `force`. @param report  receives what has happened
Store open_or_create(const fs::path& file, const Study& study, const StudyRunOptions& options, StudyRunReport& report) {
  if (is_there(file) && is_blank(file)) remove_store(file);
  remove_store(file.string() + ".grown");  // of a process that was killed
  if (!is_there(file)) return Store::create(file, study, options.shard);
  const std::string sha256 = study_sha256(study);
  std::optional<SharedPoints> shared;
  try {
    Store store = Store::open(file, sqlite::Connection::Mode::read);
    if (store.sha256() != sha256) {
      report.replaced = !may_hold_results(store);
      if (!report.replaced) {
        if (const StoreCheck check = store.check(); check.is_damaged())
          refuse_file(file,
                      fmt::format("holds the points of another study, and {}; choose another --out, or --force to discard "
                                  "them and start again",
                                  check.text()));
        shared = shared_points(store, study, options.shard, build_text(), options.watch);
        StudyGrowth& growth = shared->growth;
        growth.from = file;
        growth.replaced = true;
        const bool grows = (growth.reused > 0 || shared->of_quantities) && growth.left_out == 0;
        if (!grows && !options.force) refuse_loss(file, store.study(), study, growth);
      }
    }
  } catch (const ScenarioError&) {
    if (!options.force) throw;
    remove_store(file);
    return Store::create(file, study, options.shard);
  }
  if (shared) {
    grow(file, study, options.shard, *shared);
    report.growth.push_back(shared->growth);
    return Store::open(file, sqlite::Connection::Mode::write);
  }
  {
    Store store = Store::open(file, sqlite::Connection::Mode::write);
    if (store.sha256() == sha256) {
      store.adopt(study);
      return store;
    }
  }
  remove_store(file);
  return Store::create(file, study, options.shard);
}

/// Copies what fits from a store that stays as it is.
StudyGrowth reuse(const fs::path& from, const Study& study, const StudyRunOptions& options, Store& store) {
  Store older = Store::open(from, sqlite::Connection::Mode::read);
  older.check_intact();
  SharedPoints shared = shared_points(older, study, options.shard, store.build(), options.watch);
  shared.growth.from = from;
  store.begin();
  shared.growth.reused = copy_shared(shared, older, study, store);
  store.commit();
  return shared.growth;
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
  fs::path from;
  if (!options.reuse.empty()) {
    from = store_at(options.reuse);
    std::error_code ignored;
    if (fs::equivalent(from, report.store, ignored))
      from.clear();  // a store of another design grows by itself
    else
      Store::open(from, sqlite::Connection::Mode::read).check_intact();
  }
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
  Store store = open_or_create(report.store, study, options, report);
  report.has_checksums = store.check_intact().has_checksums;
  if (!from.empty()) report.growth.push_back(reuse(from, study, options, store));
  if (options.on_growth)
    for (const StudyGrowth& growth : report.growth) options.on_growth(growth);
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

namespace study {
namespace {

/// Refuses a store whose points fit into no design. @param here  the study of the store `first`
[[noreturn]] void refuse_unlike(const fs::path& part, const Study& there, const Study& here, const fs::path& first,
                                const StudyGrowth& growth) {
  const std::string key = difference(there, here);
  refuse_file(part, fmt::format("holds points of another study than {}{}{}", printable(first.string()),
                                key.empty() ? "" : ": " + key, growth.why.empty() ? "" : "; " + growth.why));
}

/// A design with the points of several stores, and what each of them shares with it.
struct Common {
  Study study;
  std::vector<SharedPoints> shared;  // one for each store; without pairs where its study is the same
};

/// What stores share with a design. @returns none where points of one do not fit; `unlike` then receives the first such store
std::optional<Common> common_in(const Study& study, const std::vector<fs::path>& stores, const std::string& build,
                                std::optional<std::pair<std::size_t, StudyGrowth>>& unlike) {
  Common common{study, std::vector<SharedPoints>(stores.size())};
  const std::string sha256 = study_sha256(study);
  for (std::size_t i = 0; i < stores.size(); ++i) {
    Store store = Store::open(stores[i], sqlite::Connection::Mode::read);
    if (store.sha256() == sha256) continue;
    common.shared[i] = shared_points(store, study, {}, build, {});
    const StudyGrowth& growth = common.shared[i].growth;
    if (growth.left_out == 0 && growth.why.empty() && (growth.reused > 0 || growth.held == 0)) continue;
    if (!unlike) unlike.emplace(i, growth);
    return std::nullopt;
  }
  return common;
}

/// Refuses a store whose points belong to another study than its description is for this program: none would be found again.
void require_own_identity(Store& store, const fs::path& file) {
  if (store.sha256() == study_sha256(store.study())) return;
  const std::string build = store.build();
  refuse_file(file,
              fmt::format("holds points of a study that its description does not give to this version of earthtop{}; merge "
                          "it with the version that computed it, or run the study again",
                          build.empty() ? "" : fmt::format(" (they were computed by {})", printable(build))));
}

/// The design of one of the stores that has the points of all; or the grid of all values.
/// @throws ScenarioError, which names the key that differs, where there is none
Common common_design(const std::vector<fs::path>& stores) {
  std::vector<std::pair<std::uint64_t, std::size_t>> order;  // the largest design first
  std::vector<Study> studies;
  std::vector<std::string> identities, builds;
  for (std::size_t i = 0; i < stores.size(); ++i) {
    Store store = Store::open(stores[i], sqlite::Connection::Mode::read);
    store.check_intact();
    require_own_identity(store, stores[i]);
    order.emplace_back(~point_count(store.study()).value_or(0), i);
    studies.push_back(store.study());
    identities.push_back(store.sha256());
    builds.push_back(store.build());
  }
  if (std::equal(identities.begin() + 1, identities.end(), identities.begin()))
    return {studies.front(), std::vector<SharedPoints>(stores.size())};
  std::sort(order.begin(), order.end());
  std::optional<std::pair<std::size_t, StudyGrowth>> unlike;
  std::vector<std::string> tried;
  for (const auto& [unused, place] : order) {
    if (std::find(tried.begin(), tried.end(), identities[place]) != tried.end()) continue;
    tried.push_back(identities[place]);
    if (auto common = common_in(studies[place], stores, builds[place], unlike)) return *std::move(common);
  }
  std::optional<Study> all = studies.front();
  for (std::size_t i = 1; all && i < stores.size(); ++i)
    if (identities[i] != identities[0]) all = united(*all, studies[i]);
  std::optional<std::pair<std::size_t, StudyGrowth>> ignored;
  if (all)
    if (auto common = common_in(*all, stores, builds.front(), ignored)) return *std::move(common);
  const std::size_t largest = order.front().second;
  refuse_unlike(stores[unlike->first], studies[unlike->first], studies[largest], stores[largest], unlike->second);
}

}  // namespace
}  // namespace study

std::uint64_t merge_study_stores(const std::vector<std::filesystem::path>& stores, const std::filesystem::path& dir,
                                 bool force) {
  using namespace earthtop::study;
  if (stores.empty()) throw ScenarioError("", "there is no store to merge");
  const fs::path target = study_store(dir);
  for (const fs::path& part : stores) {
    std::error_code error;
    if (fs::equivalent(part, target, error)) refuse_file(part, "is the merged store itself; choose another --out");
  }
  const Common common = common_design(stores);
  const std::string sha256 = study_sha256(common.study);
  check_study_results(dir, common.study, force);
  make_directory(dir);
  const StoreLock lock(target);
  StudyRunOptions options;
  options.force = force;
  StudyRunReport report;
  Store merged = open_or_create(target, common.study, options, report);
  merged.check_intact();
  for (std::size_t i = 0; i < stores.size(); ++i) {
    Store store = Store::open(stores[i], sqlite::Connection::Mode::read);
    if (store.build() != merged.build()) merged.mix_builds();
    merged.begin();
    if (store.sha256() == sha256)
      store.for_each([&](const PointResult& point) { merged.insert(point); });
    else
      copy_shared(common.shared[i], store, common.study, merged);
    merged.commit();
  }
  const std::uint64_t count = merged.count();
  merged.finish();
  return count;
}

}  // namespace earthtop
