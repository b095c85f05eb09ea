// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/store.hpp"

#include <fmt/core.h>

#include <charconv>
#include <cmath>

#include "earthtop/results/provenance.hpp"

namespace earthtop::study {
namespace {

constexpr const char* kFormat = "earthtop-study-store-1";

[[noreturn]] void refuse_store(const std::filesystem::path& file, std::string message) {
  throw ScenarioError(std::vector<Diagnostic>{{0, 0, "", std::move(message)}}, file.string());
}

void put(sqlite::Connection& connection, std::string_view key, std::string_view value) {
  sqlite::Statement statement(connection, "INSERT OR REPLACE INTO study VALUES (?, ?)");
  statement.bind(1, key);
  statement.bind(2, value);
  statement.execute();
}

std::uint64_t whole_number(const std::string& text) {
  std::uint64_t number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

/// Makes SQLite write changes to a log first: readers see whole transactions only, and a kill loses no committed one.
void set_up(sqlite::Connection& connection) {
  connection.execute("PRAGMA journal_mode = WAL");
  connection.execute("PRAGMA synchronous = NORMAL");
}

}  // namespace

Store::Store(std::unique_ptr<sqlite::Connection> connection, Study study, std::string sha256, StudyShard shard)
    : connection_(std::move(connection)), study_(std::move(study)), sha256_(std::move(sha256)), shard_(shard) {}

std::string Store::columns() const {
  std::string list = "number, status, reason, scenario_sha256";
  for (const StudyAxis& axis : study_.axes) list += ", " + sqlite::quoted(axis.name);
  for (const StudyQuantity& quantity : study_.quantities) list += ", " + sqlite::quoted(quantity.name);
  return list;
}

Store Store::create(const std::filesystem::path& file, const Study& study, const StudyShard& shard) {
  Store store(std::make_unique<sqlite::Connection>(file.string(), sqlite::Connection::Mode::write), study, study_sha256(study),
              shard);
  sqlite::Connection& connection = *store.connection_;
  set_up(connection);
  connection.wait_for_locks();
  store.begin();
  connection.execute("CREATE TABLE study (key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID");
  std::string table = "CREATE TABLE point (number INTEGER PRIMARY KEY, status TEXT NOT NULL, reason TEXT, scenario_sha256 TEXT";
  for (const StudyAxis& axis : study.axes) table += ", " + sqlite::quoted(axis.name);
  for (const StudyQuantity& quantity : study.quantities) table += ", " + sqlite::quoted(quantity.name);
  connection.execute((table + ")").c_str());
  const BuildInfo& build = build_info();
  const std::pair<const char*, std::string> facts[] = {{"format", kFormat},
                                                       {"name", study.name},
                                                       {"study", study.text},
                                                       {"base", study.base.text},
                                                       {"base_file", study.base.file},
                                                       {"sha256", store.sha256_},
                                                       {"shard_k", fmt::format("{}", shard.k)},
                                                       {"shard_n", fmt::format("{}", shard.n)},
                                                       {"version", build.version},
                                                       {"commit", build.commit},
                                                       {"compiler", build.compiler},
                                                       {"flags", build.flags}};
  for (const auto& [key, value] : facts) put(connection, key, value);
  store.commit();
  return store;
}

Store Store::open(const std::filesystem::path& file, sqlite::Connection::Mode mode) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) refuse_store(file, "there is no such store");
  auto connection = std::make_unique<sqlite::Connection>(file.string(), mode);
  std::map<std::string, std::string> facts;
  try {
    sqlite::Statement statement(*connection, "SELECT key, value FROM study");
    while (statement.step()) facts[statement.text(0)] = statement.text(1);
  } catch (const FileError& what) {
    refuse_store(file, fmt::format("is no study's store ({})", what.reason()));
  }
  if (facts["format"] != kFormat) refuse_store(file, "is no study's store of this version");
  if (mode == sqlite::Connection::Mode::write) set_up(*connection);
  connection->wait_for_locks();
  const ScenarioSource base{facts["base_file"], facts["base"]};
  Study study = parse_study({facts["name"] + ".json", facts["study"]}, base);
  study.name = facts["name"];
  return Store(std::move(connection), std::move(study), facts["sha256"],
               StudyShard{whole_number(facts["shard_k"]), whole_number(facts["shard_n"])});
}

void Store::adopt(const Study& study) {
  begin();
  put(*connection_, "name", study.name);
  put(*connection_, "study", study.text);
  put(*connection_, "base", study.base.text);
  put(*connection_, "base_file", study.base.file);
  commit();
  study_ = study;
}

std::uint64_t Store::counted(const char* condition) {
  sqlite::Statement statement(*connection_, fmt::format("SELECT count(*) FROM point{}", condition));
  statement.step();
  return static_cast<std::uint64_t>(statement.integer(0));
}

void Store::insert(const PointResult& point) {
  if (!insert_) {
    std::string places = "?, ?, ?, ?";
    for (std::size_t i = 0; i < study_.axes.size() + study_.quantities.size(); ++i) places += ", ?";
    insert_ = std::make_unique<sqlite::Statement>(
        *connection_, fmt::format("INSERT OR REPLACE INTO point ({}) VALUES ({})", columns(), places));
  }
  int at = 0;
  insert_->bind(++at, static_cast<std::int64_t>(point.number));
  insert_->bind(++at, std::string_view(point.status));
  insert_->bind(++at, point.reason.empty() ? Value() : Value(point.reason));
  insert_->bind(++at, point.scenario_sha256.empty() ? Value() : Value(point.scenario_sha256));
  for (const Value& value : point.axis_values) insert_->bind(++at, value);
  for (const Value& value : point.values) insert_->bind(++at, value);
  insert_->execute();
}

void Store::finish() {
  insert_.reset();
  // While someone reads the store, the log stays beside it until the last reader has gone.
  const int code = sqlite3_exec(connection_->get(), "PRAGMA journal_mode = DELETE", nullptr, nullptr, nullptr);
  if (code != SQLITE_OK && (code & 0xff) != SQLITE_BUSY && (code & 0xff) != SQLITE_LOCKED) connection_->fail();
}

std::vector<std::uint64_t> Store::numbers(std::uint64_t first, std::uint64_t end) {
  sqlite::Statement statement(*connection_, "SELECT number FROM point WHERE number >= ? AND number < ? ORDER BY number");
  statement.bind(1, static_cast<std::int64_t>(first));
  statement.bind(2, static_cast<std::int64_t>(end));
  std::vector<std::uint64_t> list;
  while (statement.step()) list.push_back(static_cast<std::uint64_t>(statement.integer(0)));
  return list;
}

Store::Points Store::points() {
  return {sqlite::Statement(*connection_, fmt::format("SELECT {} FROM point ORDER BY number", columns())), study_};
}

bool Store::Points::next(PointResult& point) {
  if (!statement_.step()) return false;
  int at = 0;
  point.number = static_cast<std::uint64_t>(statement_.integer(at++));
  point.status = statement_.text(at++);
  point.reason = statement_.text(at++);
  point.scenario_sha256 = statement_.text(at++);
  point.axis_values.resize(study_.axes.size());
  for (Value& value : point.axis_values) value = statement_.value(at++);
  point.values.resize(study_.quantities.size());
  for (Value& value : point.values) value = statement_.value(at++);
  return true;
}

void Store::for_each(const std::function<void(const PointResult&)>& visit) {
  Points all = points();
  PointResult point;
  while (all.next(point)) visit(point);
}

std::optional<double> Store::quantile(const std::string& quantity, double share, std::uint64_t count) {
  if (count == 0) return std::nullopt;
  const std::string column = sqlite::quoted(quantity);
  sqlite::Statement statement(
      *connection_, fmt::format("SELECT {0} FROM point WHERE status = 'completed' AND typeof({0}) IN ('real', 'integer') "
                                "ORDER BY {0} LIMIT 1 OFFSET ?",
                                column));
  statement.bind(1, std::int64_t{std::llround(share * static_cast<double>(count - 1))});
  if (!statement.step()) return std::nullopt;
  return std::get<double>(statement.value(0));
}

}  // namespace earthtop::study
