// SPDX-License-Identifier: GPL-3.0-or-later
/// The store of a study's points: one SQLite file with one row per point. It stays intact if the process is killed at any
/// moment.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "earthtop/study/run_study.hpp"
#include "study/collect.hpp"
#include "study/sqlite.hpp"

namespace earthtop::study {

class Store {
 public:
  /// Creates an empty store. @throws WriteError
  static Store create(const std::filesystem::path& file, const Study& study, const StudyShard& shard);
  /// Opens an existing store. @throws ScenarioError if the file is no store of this format; ReadError, WriteError
  static Store open(const std::filesystem::path& file, sqlite::Connection::Mode mode);

  /// The study as it was when the store was made, with what `adopt` changed.
  const Study& study() const { return study_; }
  const std::string& sha256() const { return sha256_; }  ///< `study_sha256`
  /// Replaces what is not part of a study's identity: title, finding, fits, figures. @param study has the same identity
  void adopt(const Study& study);
  const StudyShard& shard() const { return shard_; }

  std::uint64_t count() { return counted(""); }
  /// Number of points whose run came to its end, so that it has values.
  std::uint64_t ended_count() { return counted(" WHERE status IN ('completed', 'accuracy_not_reached')"); }
  std::uint64_t failed_count() { return counted(" WHERE status <> 'completed'"); }

  void begin() { connection_->execute("BEGIN IMMEDIATE"); }
  void insert(const PointResult& point);
  void commit() { connection_->execute("COMMIT"); }
  /// Deletes the points that failed.
  void remove_failed() { connection_->execute("DELETE FROM point WHERE status <> 'completed'"); }
  /// Moves SQLite's log into the file, so that the store is one file; does nothing while someone else reads it.
  void finish();

  /// The numbers of stored points in first <= number < end, ascending.
  std::vector<std::uint64_t> numbers(std::uint64_t first, std::uint64_t end);

  /// All points in ascending order, one at a time.
  class Points {
   public:
    /// @returns false at the end
    bool next(PointResult& point);

   private:
    friend class Store;
    Points(sqlite::Statement statement, const Study& study) : statement_(std::move(statement)), study_(study) {}
    sqlite::Statement statement_;
    const Study& study_;
  };
  Points points();
  void for_each(const std::function<void(const PointResult&)>& visit);

  /// The quantile of a quantity over the completed points that have a number for it: the value at position share * (count - 1),
  /// rounded, in ascending order.
  /// @param count how many such points there are; nothing is returned if it is 0
  std::optional<double> quantile(const std::string& quantity, double share, std::uint64_t count);

 private:
  Store(std::unique_ptr<sqlite::Connection> connection, Study study, std::string sha256, StudyShard shard);
  std::uint64_t counted(const char* condition);
  std::string columns() const;

  std::unique_ptr<sqlite::Connection> connection_;
  Study study_;
  std::string sha256_;
  StudyShard shard_;
  std::unique_ptr<sqlite::Statement> insert_;
};

}  // namespace earthtop::study
