// SPDX-License-Identifier: GPL-3.0-or-later
/// Where a study's points are kept: one SQLite file, one row a point, whole after a kill at any moment.
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
  /// A new store, empty. @throws WriteError
  static Store create(const std::filesystem::path& file, const Study& study, const StudyShard& shard);
  /// One that is there. @throws ScenarioError for a file that is no store of this format; ReadError, WriteError
  static Store open(const std::filesystem::path& file, sqlite::Connection::Mode mode);

  /// The study as it was when the store was made.
  const Study& study() const { return study_; }
  const std::string& sha256() const { return sha256_; }  ///< `study_sha256`
  /// Takes over what is not part of a study's identity: title, finding, fits, figures. @param study  of the same identity
  void adopt(const Study& study);
  const StudyShard& shard() const { return shard_; }

  std::uint64_t count() { return counted(""); }
  /// Points whose run came to its end, and has numbers.
  std::uint64_t ended_count() { return counted(" WHERE status IN ('completed', 'accuracy_not_reached')"); }
  std::uint64_t failed_count() { return counted(" WHERE status <> 'completed'"); }

  void begin() { connection_->execute("BEGIN IMMEDIATE"); }
  void insert(const PointResult& point);
  void commit() { connection_->execute("COMMIT"); }
  /// Forgets the points that failed.
  void remove_failed() { connection_->execute("DELETE FROM point WHERE status <> 'completed'"); }
  /// Everything in one file, unless someone is reading.
  void finish();

  /// The numbers of the points that are there, from `first` up to, not including, `end`, ascending.
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

  /// Of a quantity's numbers in completed points, the one that this share of them is not above; nothing where there are none.
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
