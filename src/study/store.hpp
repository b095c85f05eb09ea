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

/// What a store says of its study, by key.
using Facts = std::map<std::string, std::string>;
/// The checksum of all facts but those that are checksums themselves.
std::string facts_checksum(const Facts& facts);
/// This program's build, as `Store::build` tells that of a store.
std::string build_text();

/// The findings of a check of a store.
struct StoreCheck {
  bool has_checksums = true;           ///< false: a store from before there were checksums, of which nothing is known
  std::vector<std::uint64_t> damaged;  ///< numbers of the points whose row is not what was stored
  std::uint64_t intact = 0;            ///< number of the other points
  std::uint64_t lost = 0;              ///< number of points that were stored and are not there
  std::string fault;                   ///< what is wrong with the file as a whole; empty where nothing is
  bool is_damaged() const { return !damaged.empty() || lost > 0 || !fault.empty(); }
  /// In words, with the remedy: "2 of 100 points are damaged (5, 17) ...".
  std::string text() const;
};

class Store {
 public:
  /// Creates an empty store. @param grown_from  `identities` of the store that it takes the place of   @throws WriteError
  static Store create(const std::filesystem::path& file, const Study& study, const StudyShard& shard,
                      const std::vector<std::string>& grown_from = {});
  /// Opens an existing store. @throws ScenarioError if the file is not a store of this format; ReadError, WriteError
  static Store open(const std::filesystem::path& file, sqlite::Connection::Mode mode);

  /// Opens what is left of a damaged store, to read its intact points: those whose checksum fits this study's.
  /// @throws ReadError if it is no longer a database
  static Store open_damaged(const std::filesystem::path& file, const Study& study);

  /// The study as it was when the store was made, with what `adopt` changed.
  const Study& study() const { return study_; }
  const std::string& sha256() const { return sha256_; }  ///< `study_sha256`
  /// Replaces what is not part of a study's identity: title, finding, fits, figures. @param study has the same identity
  void adopt(const Study& study);
  const StudyShard& shard() const { return shard_; }
  /// The study's identity, and those of the designs from which the store has grown: their results may lie beside it.
  std::vector<std::string> identities() const;
  /// The build that computed the points, in words; empty where several did.
  const std::string& build() const { return build_; }
  /// Records that points of another build are among the points.
  void mix_builds();
  bool has_checksums() const { return has_checksums_; }

  std::uint64_t count() { return counted(""); }
  /// Number of points whose run was completed, so that it has values.
  std::uint64_t ended_count() { return counted(" WHERE status IN ('completed', 'accuracy_not_reached')"); }
  std::uint64_t failed_count() { return counted(" WHERE status <> 'completed'"); }

  /// Reads every point and holds it against its checksum, and their number against what was stored.
  StoreCheck check();
  /// The same. @throws ScenarioError, which names the damage, if there is any
  StoreCheck check_intact();

  void begin();
  void insert(const PointResult& point);
  void commit();
  /// Deletes the points that failed.
  void remove_failed();
  /// Moves SQLite's log into the file, so that the store is one file; does nothing while someone else reads it.
  void finish();

  /// The numbers of stored points in first <= number < end, ascending.
  std::vector<std::uint64_t> numbers(std::uint64_t first, std::uint64_t end);

  /// One point; none if it is not there or damaged.
  std::optional<PointResult> point(std::uint64_t number);

  /// All points in ascending order, one at a time; those whose row is damaged are passed over.
  class Points {
   public:
    /// @returns false at the end
    bool next(PointResult& point);

   private:
    friend class Store;
    Points(sqlite::Statement statement, const Store& store) : statement_(std::move(statement)), store_(store) {}
    /// Reads the row that the statement is at. @returns whether it is what was stored
    bool read(PointResult& point) const;
    sqlite::Statement statement_;
    const Store& store_;
  };
  Points points(std::uint64_t first = 0, std::optional<std::uint64_t> last = std::nullopt);
  void for_each(const std::function<void(const PointResult&)>& visit);

  /// Passes the numbers of the completed points' quantities, each with the index of its quantity.
  void for_each_number(const std::function<void(std::size_t quantity, double number)>& visit);

 private:
  /// How many points there are, and the sum of their checksums modulo 2^64: kept with every commit, so that lost points are
  /// noticed.
  struct Contents {
    std::uint64_t count = 0, sum = 0;
    void include(std::uint64_t checksum) { ++count, sum += checksum; }
    void exclude(std::uint64_t checksum) { --count, sum -= checksum; }
    bool operator==(const Contents&) const = default;
  };

  Store(std::unique_ptr<sqlite::Connection> connection, Study study, std::string sha256, StudyShard shard);
  /// Whether the table of points has the study's columns.
  bool has_its_table();
  std::uint64_t counted(const char* condition);
  std::string columns() const;
  std::uint64_t checksum_of_row(const PointResult& point) const;
  std::optional<Contents> stored_contents();  ///< none if the record is damaged
  std::string contents_text(const Contents& contents) const;
  std::string fault_of_file();
  std::string fault_of_numbers();  ///< whether a point has a number that its study has not
  std::string fault_of_values();   ///< whether a value is out of its range
  void pass_over(const std::vector<std::uint64_t>& numbers);
  /// Takes the points whose checksums a query gives out of the contents.
  void exclude(const std::string& query);

  std::unique_ptr<sqlite::Connection> connection_;
  Study study_;
  std::string sha256_, build_;
  std::vector<std::string> grown_from_;
  StudyShard shard_;
  bool has_checksums_ = true, passes_over_ = false;
  std::filesystem::path file_;
  std::optional<Contents> contents_;  ///< of a store that is written to
  std::unique_ptr<sqlite::Statement> insert_;
};

}  // namespace earthtop::study
