// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/store.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <bit>
#include <charconv>
#include <cstdio>
#include <iterator>
#include <limits>
#include <sstream>

#include "earthtop/error.hpp"
#include "earthtop/results/provenance.hpp"
#include "input/file.hpp"
#include "results/number_ranges.hpp"
#include "text/checksum.hpp"

namespace earthtop::study {
namespace {

constexpr const char* kRepairStore = "; the same study with --repair keeps the intact points and computes the others again";
constexpr const char* kFormat = "earthtop-study-store-1";

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

constexpr const char* kFactsChecksum = "facts_checksum";  // the checksum of all facts but itself and the next
constexpr const char* kContents = "contents";
constexpr const char *kGrownFrom = "grown_from", *kMixed = "mixed_builds";

std::string build_of(const Facts& facts) {
  std::string text;
  for (const char* key : {"version", "commit", "compiler", "flags"})
    if (const auto fact = facts.find(key); fact != facts.end()) text += (text.empty() ? "" : ", ") + fact->second;
  return facts.contains(kMixed) ? "" : text;
}

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

Facts facts_of(sqlite::Connection& connection) {
  Facts facts;
  sqlite::Statement statement(connection, "SELECT key, value FROM study");
  while (statement.step()) facts[statement.text(0)] = statement.text(1);
  return facts;
}

/// Reads the study whose text a store holds. @throws ScenarioError that names the store
Study study_in(Facts& facts, const std::filesystem::path& file) {
  const ScenarioSource base{facts["base_file"], facts["base"]};
  try {
    Study study = parse_study({facts["name"] + ".json", facts["study"]}, base);
    study.name = facts["name"];
    return study;
  } catch (const ScenarioError& error) {
    const Diagnostic& first = error.diagnostics().front();
    refuse_file(file, fmt::format("holds a study that cannot be read: {}", format_diagnostic(facts["name"], first)));
  }
}

/// The name of the column of checksums.
constexpr const char* kRowChecksum = "row_checksum";

bool has_column_of_checksums(sqlite::Connection& connection) {
  sqlite::Statement statement(connection,
                              fmt::format("SELECT count(*) FROM pragma_table_info('point') WHERE name = '{}'", kRowChecksum));
  return statement.step() && statement.integer(0) > 0;
}

void append(std::string& bytes, std::uint64_t number) {
  for (int shift = 0; shift < 64; shift += 8) bytes += static_cast<char>(number >> shift);
}
void append(std::string& bytes, std::string_view text) {
  append(bytes, text.size());
  bytes += text;
}
void append(std::string& bytes, const Value& value) {
  bytes += static_cast<char>(value.index());
  if (const auto* number = std::get_if<double>(&value)) append(bytes, std::bit_cast<std::uint64_t>(*number));
  if (const auto* word = std::get_if<std::string>(&value)) append(bytes, std::string_view(*word));
}

constexpr const char* kForbidsWriting = "its head says that nothing may be written to it";

/// Makes SQLite write changes to a log first: readers see whole transactions only, and a kill loses no committed one.
void set_up(sqlite::Connection& connection) {
  connection.execute("PRAGMA journal_mode = WAL");
  connection.execute("PRAGMA synchronous = NORMAL");
}

}  // namespace

std::string facts_checksum(const Facts& facts) {
  Checksum checksum;
  for (const auto& [key, value] : facts) {
    if (key == kFactsChecksum || key == kContents) continue;
    checksum.add(fmt::format("{}:{}:", key.size(), value.size()));
    checksum.add(key);
    checksum.add(value);
  }
  return checksum_text(checksum.value());
}

std::string build_text() {
  const BuildInfo& build = build_info();
  return build_of({{"version", build.version}, {"commit", build.commit}, {"compiler", build.compiler}, {"flags", build.flags}});
}

std::string StoreCheck::text() const {
  const std::uint64_t wrong = damaged.size() + lost;
  std::string numbers;
  constexpr std::size_t kNamed = 8;
  for (std::size_t i = 0; i < std::min(damaged.size(), kNamed); ++i)
    numbers += fmt::format("{}{}", i > 0 ? ", " : "", damaged[i]);
  if (damaged.size() > kNamed) numbers += ", ...";
  std::string text = "is damaged";
  if (!damaged.empty())
    text += fmt::format(": of {} points {} ({}) are not what was stored", intact + wrong, damaged.size(), numbers);
  if (lost > 0) text += fmt::format("{} {} points are missing", damaged.empty() ? ":" : ", and", lost);
  if (!fault.empty()) text += (wrong > 0 ? "; " : ": ") + fault;
  return text + kRepairStore;
}

Store::Store(std::unique_ptr<sqlite::Connection> connection, Study study, std::string sha256, StudyShard shard)
    : connection_(std::move(connection)), study_(std::move(study)), sha256_(std::move(sha256)), shard_(shard) {}

/// The checksum of a point as it is stored. The study's identity is part of it: a row of another study does not pass for one of
/// this.
std::uint64_t Store::checksum_of_row(const PointResult& point) const {
  std::string bytes = sha256_;
  append(bytes, point.number);
  for (const std::string* text : {&point.status, &point.reason, &point.scenario_sha256}) append(bytes, std::string_view(*text));
  for (const Value& value : point.axis_values) append(bytes, value);
  for (const Value& value : point.values) append(bytes, value);
  return checksum_of(bytes);
}

std::string Store::columns() const {
  std::string list = "number, status, reason, scenario_sha256";
  for (const StudyAxis& axis : study_.axes) list += ", " + sqlite::quoted(axis.name);
  for (const StudyQuantity& quantity : study_.quantities) list += ", " + sqlite::quoted(quantity.name);
  return has_checksums_ ? list + ", " + kRowChecksum : list;
}

Store Store::create(const std::filesystem::path& file, const Study& study, const StudyShard& shard,
                    const std::vector<std::string>& grown_from) {
  Store store(std::make_unique<sqlite::Connection>(file.string(), sqlite::Connection::Mode::write), study, study_sha256(study),
              shard);
  store.file_ = file;
  store.contents_ = Contents();
  sqlite::Connection& connection = *store.connection_;
  set_up(connection);
  connection.wait_for_locks();
  store.begin();
  connection.execute("CREATE TABLE study (key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID");
  std::string table = "CREATE TABLE point (number INTEGER PRIMARY KEY, status TEXT NOT NULL, reason TEXT, scenario_sha256 TEXT";
  for (const StudyAxis& axis : study.axes) table += ", " + sqlite::quoted(axis.name);
  for (const StudyQuantity& quantity : study.quantities) table += ", " + sqlite::quoted(quantity.name);
  connection.execute(fmt::format("{}, {} INTEGER)", table, kRowChecksum).c_str());
  const BuildInfo& build = build_info();
  Facts facts = {{"format", kFormat},
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
  store.build_ = build_of(facts);
  store.grown_from_ = grown_from;
  if (!grown_from.empty()) facts[kGrownFrom] = fmt::format("{}", fmt::join(grown_from, " "));
  facts[kFactsChecksum] = facts_checksum(facts);
  for (const auto& [key, value] : facts) put(connection, key, value);
  store.commit();
  return store;
}

Store Store::open(const std::filesystem::path& file, sqlite::Connection::Mode mode) {
  const input::PathType type = input::type_of(file.string());
  if (type == input::PathType::nothing) refuse_file(file, "there is no such store");
  if (type != input::PathType::file) refuse_file(file, "is not a file, or is a link that leads nowhere; give a store");
  auto connection = std::make_unique<sqlite::Connection>(file.string(), mode);
  Facts facts;
  bool has_checksums = true;
  try {
    facts = facts_of(*connection);
    has_checksums = has_column_of_checksums(*connection);
  } catch (const sqlite::DamageError& what) {
    refuse_file(file, fmt::format("is not a study's store, or is damaged ({}){}", what.reason(), kRepairStore));
  }
  const bool is_damaged =
      has_checksums != facts.contains(kFactsChecksum) || (has_checksums && facts.at(kFactsChecksum) != facts_checksum(facts));
  if (is_damaged || facts["format"] != kFormat) connection->require_read();
  if (is_damaged)
    refuse_file(file, fmt::format("is damaged: its description of the study is not what was stored{}", kRepairStore));
  if (facts["format"] != kFormat) refuse_file(file, "is not a study's store of this version");
  if (mode == sqlite::Connection::Mode::write && connection->head_forbids_writing())
    refuse_file(file, fmt::format("is damaged: {}{}", kForbidsWriting, kRepairStore));
  if (mode == sqlite::Connection::Mode::write) set_up(*connection);
  connection->wait_for_locks();
  Study study = study_in(facts, file);
  Store store(std::move(connection), std::move(study), facts["sha256"],
              StudyShard{whole_number(facts["shard_k"]), whole_number(facts["shard_n"])});
  store.has_checksums_ = has_checksums;
  store.file_ = file;
  store.build_ = build_of(facts);
  store.grown_from_ = words_of(facts[kGrownFrom]);
  if (!store.has_its_table()) {
    store.connection_->require_read();
    refuse_file(file, fmt::format("is damaged: its table of points is not that of its study{}", kRepairStore));
  }
  return store;
}

bool Store::has_its_table() {
  std::vector<std::string> expected = {"number", "status", "reason", "scenario_sha256"};
  for (const StudyAxis& axis : study_.axes) expected.push_back(axis.name);
  for (const StudyQuantity& quantity : study_.quantities) expected.push_back(quantity.name);
  if (has_checksums_) expected.emplace_back(kRowChecksum);
  sqlite::Statement columns(*connection_, "SELECT name, pk FROM pragma_table_info('point') ORDER BY cid");
  std::vector<std::string> there;
  while (columns.step()) {
    there.push_back(columns.text(0));
    if ((columns.integer(1) != 0) != (there.size() == 1)) return false;  // the number, and nothing else, is the key
  }
  return there == expected;
}

Store Store::open_damaged(const std::filesystem::path& file, const Study& study) {
  Store store(std::make_unique<sqlite::Connection>(file.string(), sqlite::Connection::Mode::read), study, study_sha256(study),
              {});
  store.connection_->wait_for_locks();
  store.file_ = file;
  return store;
}

std::optional<Store::Contents> Store::stored_contents() {
  const Facts facts = facts_of(*connection_);
  const auto found = facts.find(kContents);
  Contents contents;
  unsigned long long count = 0, sum = 0;
  if (found == facts.end() || std::sscanf(found->second.c_str(), "%llu %llx", &count, &sum) != 2) return std::nullopt;
  contents.count = count;
  contents.sum = sum;
  if (found->second != contents_text(contents)) return std::nullopt;
  return contents;
}

std::string Store::contents_text(const Contents& contents) const {
  const std::string numbers = fmt::format("{} {:016x}", contents.count, contents.sum);
  return fmt::format("{} {}", numbers, checksum_text(checksum_of(sha256_ + numbers)));
}

std::string Store::fault_of_file() {
  if (connection_->head_forbids_writing()) return kForbidsWriting;
  if (input::type_of(file_.string() + "-wal") != input::PathType::nothing) return "";  // the file is not all of the store
  sqlite::Statement pages(*connection_, "SELECT page_count * page_size FROM pragma_page_count(), pragma_page_size()");
  const std::uintmax_t size = std::filesystem::file_size(file_);
  if (!pages.step() || size == static_cast<std::uintmax_t>(pages.integer(0))) return "";
  return fmt::format("the file has {} bytes where its pages have {}", size, pages.integer(0));
}

std::string Store::fault_of_numbers() {
  const std::uint64_t planned = point_count(study_).value_or(std::numeric_limits<std::int64_t>::max());
  sqlite::Statement outside(*connection_, "SELECT number FROM point WHERE number < 0 OR number >= ? LIMIT 1");
  outside.bind(1, static_cast<std::int64_t>(planned));
  if (!outside.step()) return "";
  return fmt::format("it has a point numbered {}, but its study has the points 0 to {}", outside.integer(0), planned - 1);
}

std::string Store::fault_of_values() {
  Points all = points();
  for (PointResult point; all.next(point);)
    for (std::size_t i = 0; i < study_.quantities.size(); ++i) {
      const std::string& path = study_.quantities[i].path;
      const auto* number = std::get_if<double>(&point.values[i]);
      const std::string_view wanted = number ? fault_of(range_of(path.substr(path.rfind('.') + 1)), *number) : "";
      if (!wanted.empty())
        return fmt::format("{} of point {} is {}, but must be {}", study_.quantities[i].name, point.number, *number, wanted);
    }
  return "";
}

StoreCheck Store::check() {
  StoreCheck check;
  check.has_checksums = has_checksums_;
  if (!has_checksums_) {
    try {
      sqlite::Statement pages(*connection_, "PRAGMA quick_check(1)");
      if (pages.step() && pages.text(0) != "ok") {
        connection_->require_read();
        check.fault = "its pages are not in order";
      }
      if (check.fault.empty()) check.fault = fault_of_file();
      if (check.fault.empty()) check.fault = fault_of_numbers();
      if (check.fault.empty()) check.fault = fault_of_values();
      check.intact = count();
    } catch (const sqlite::DamageError& error) {
      check.fault = fmt::format("it cannot be read to its end ({})", error.reason());
    }
    return check;
  }
  Contents seen;
  try {
    connection_->execute("BEGIN");  // what is read belongs together, though another process may be storing points
    Points all = points();
    PointResult point;
    while (all.statement_.step())
      if (all.read(point)) {
        seen.include(checksum_of_row(point));
      } else {
        check.damaged.push_back(point.number);
      }
    check.intact = seen.count;
    check.fault = fault_of_file();
    const std::optional<Contents> stored = stored_contents();
    const std::uint64_t there = seen.count + check.damaged.size();
    if (!stored)
      check.fault = "its record of the stored points has changed";
    else if (stored->count > there)
      check.lost = stored->count - there;
    else if (check.damaged.empty() && *stored != seen)
      check.fault = "its points are not those that were stored";
    if (const std::string numbers = fault_of_numbers(); !numbers.empty()) check.fault = numbers;
    connection_->execute("COMMIT");
  } catch (const sqlite::DamageError& error) {
    check.fault = fmt::format("it cannot be read to its end ({})", error.reason());
    sqlite3_exec(connection_->get(), "ROLLBACK", nullptr, nullptr, nullptr);
  }
  if (check.is_damaged()) connection_->require_read();
  pass_over(check.damaged);
  return check;
}

StoreCheck Store::check_intact() {
  StoreCheck found = check();
  if (found.is_damaged()) refuse_file(file_, found.text());
  return found;
}

void Store::pass_over(const std::vector<std::uint64_t>& numbers) {
  if (numbers.empty()) return;
  connection_->execute("CREATE TEMP TABLE damaged (number INTEGER PRIMARY KEY)");
  sqlite::Statement insert(*connection_, "INSERT OR IGNORE INTO damaged VALUES (?)");
  for (const std::uint64_t number : numbers) {
    insert.bind(1, static_cast<std::int64_t>(number));
    insert.execute();
  }
  passes_over_ = true;
}

void Store::adopt(const Study& study) try {
  begin();
  put(*connection_, "name", study.name);
  put(*connection_, "study", study.text);
  put(*connection_, "base", study.base.text);
  put(*connection_, "base_file", study.base.file);
  if (has_checksums_) put(*connection_, kFactsChecksum, facts_checksum(facts_of(*connection_)));
  commit();
  study_ = study;
  if (build_ != build_text()) mix_builds();  // points that are added from now on are this build's
} catch (const sqlite::DamageError& what) {
  refuse_file(file_, fmt::format("is damaged ({}){}", what.reason(), kRepairStore));
}

std::vector<std::string> Store::identities() const {
  std::vector<std::string> list = {sha256_};
  list.insert(list.end(), grown_from_.begin(), grown_from_.end());
  return list;
}

void Store::mix_builds() {
  if (build_.empty()) return;
  begin();
  put(*connection_, kMixed, "yes");
  if (has_checksums_) put(*connection_, kFactsChecksum, facts_checksum(facts_of(*connection_)));
  commit();
  build_.clear();
}

std::uint64_t Store::counted(const char* condition) {
  sqlite::Statement statement(*connection_, fmt::format("SELECT count(*) FROM point{}", condition));
  statement.step();
  return static_cast<std::uint64_t>(statement.integer(0));
}

void Store::begin() {
  connection_->execute("BEGIN IMMEDIATE");
  if (has_checksums_ && !contents_) contents_ = stored_contents().value_or(Contents());
}

void Store::commit() {
  if (contents_) put(*connection_, kContents, contents_text(*contents_));
  connection_->execute("COMMIT");
}

void Store::remove_failed() {
  constexpr const char* kFailed = "FROM point WHERE status <> 'completed'";
  begin();
  exclude(fmt::format("SELECT {} {}", kRowChecksum, kFailed));
  connection_->execute(fmt::format("DELETE {}", kFailed).c_str());
  commit();
}

void Store::exclude(const std::string& query) {
  if (!contents_) return;
  sqlite::Statement statement(*connection_, query);
  while (statement.step()) contents_->exclude(static_cast<std::uint64_t>(statement.integer(0)));
}

void Store::insert(const PointResult& point) {
  if (!insert_) {
    std::string places = has_checksums_ ? "?, ?, ?, ?, ?" : "?, ?, ?, ?";
    for (std::size_t i = 0; i < study_.axes.size() + study_.quantities.size(); ++i) places += ", ?";
    insert_ = std::make_unique<sqlite::Statement>(
        *connection_, fmt::format("INSERT OR IGNORE INTO point ({}) VALUES ({})", columns(), places));
  }
  int at = 0;
  insert_->bind(++at, static_cast<std::int64_t>(point.number));
  insert_->bind(++at, std::string_view(point.status));
  insert_->bind(++at, point.reason.empty() ? Value() : Value(point.reason));
  insert_->bind(++at, point.scenario_sha256.empty() ? Value() : Value(point.scenario_sha256));
  for (const Value& value : point.axis_values) insert_->bind(++at, value);
  for (const Value& value : point.values) insert_->bind(++at, value);
  const std::uint64_t checksum = has_checksums_ ? checksum_of_row(point) : 0;
  if (has_checksums_) insert_->bind(++at, static_cast<std::int64_t>(checksum));
  insert_->execute();
  if (sqlite3_changes(connection_->get()) == 0) {  // the point exists already
    exclude(fmt::format("SELECT {} FROM point WHERE number = {}", kRowChecksum, point.number));
    connection_->execute(fmt::format("DELETE FROM point WHERE number = {}", point.number).c_str());
    insert_->execute();
  }
  if (contents_) contents_->include(checksum);
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

Store::Points Store::points(std::uint64_t first, std::optional<std::uint64_t> last) {
  const std::string until = last ? fmt::format(" AND number <= {}", *last) : "";
  return {sqlite::Statement(*connection_,
                            fmt::format("SELECT {} FROM point WHERE number >= {}{} ORDER BY number", columns(), first, until)),
          *this};
}

std::optional<PointResult> Store::point(std::uint64_t number) {
  Points one = points(number, number);
  PointResult point;
  return one.next(point) ? std::optional(std::move(point)) : std::nullopt;
}

bool Store::Points::read(PointResult& point) const {
  int at = 0;
  point.number = static_cast<std::uint64_t>(statement_.integer(at++));
  point.status = statement_.text(at++);
  point.reason = statement_.text(at++);
  point.scenario_sha256 = statement_.text(at++);
  point.axis_values.resize(store_.study_.axes.size());
  for (Value& value : point.axis_values) value = statement_.value(at++);
  point.values.resize(store_.study_.quantities.size());
  for (Value& value : point.values) value = statement_.value(at++);
  return !store_.has_checksums_ || static_cast<std::uint64_t>(statement_.integer(at)) == store_.checksum_of_row(point);
}

bool Store::Points::next(PointResult& point) {
  while (statement_.step())
    if (read(point)) return true;
  return false;
}

void Store::for_each(const std::function<void(const PointResult&)>& visit) {
  Points all = points();
  PointResult point;
  while (all.next(point)) visit(point);
}

void Store::for_each_number(const std::function<void(std::size_t quantity, double number)>& visit) {
  std::string list;
  for (const StudyQuantity& quantity : study_.quantities) list += (list.empty() ? "" : ", ") + sqlite::quoted(quantity.name);
  sqlite::Statement statement(*connection_, fmt::format("SELECT {} FROM point WHERE status = 'completed'{}", list,
                                                        passes_over_ ? " AND number NOT IN damaged" : ""));
  while (statement.step())
    for (std::size_t q = 0; q < study_.quantities.size(); ++q)
      if (const auto number = statement.number(static_cast<int>(q))) visit(q, *number);
}

}  // namespace earthtop::study
