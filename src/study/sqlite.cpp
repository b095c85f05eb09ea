// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/sqlite.hpp"

#include <fmt/core.h>
#include <sys/stat.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <new>
#include <sstream>
#include <string>

#include "earthtop/error.hpp"
#include "input/file.hpp"
#include "study/store_lock.hpp"

namespace earthtop::study::sqlite {

namespace {

/// Refuses what SQLite would wait for or write through: FIFOs, devices, links that lead nowhere. @throws ScenarioError, ReadError
void require_plain_files(const std::string& database) {
  for (const char* suffix : {"", "-journal", "-wal", "-shm"}) {
    const std::string file = database + suffix;
    const input::PathType type = input::type_of(file);
    struct stat named = {};
    const bool is_link = *suffix != '\0' && ::lstat(file.c_str(), &named) == 0 && S_ISLNK(named.st_mode);
    if (is_link || (type != input::PathType::nothing && type != input::PathType::file))
      throw ScenarioError(
          std::vector<Diagnostic>{{0, 0, "", "is not a file, or is a link; give a store whose files are files"}}, file);
  }
  // A file like /proc/kmsg calls itself regular and empty. No other is opened: closing it would release SQLite's locks on it.
  struct stat status = {};
  if (::stat(database.c_str(), &status) != 0 || status.st_size > 0) return;
  std::array<char, 1> first{};
  input::read_some(input::open_regular_file(database, database, {"store"}), database, first.data(), first.size());
}

/// The process that holds a lock on one of SQLite's files, as far as the system's list of locks shows. Opening the file to ask
/// for its locks would be wrong: closing it again would release this process's own locks on it.
std::string holder_of(const std::string& file) {
  for (const char* suffix : {"", "-shm"}) {
    struct stat of_file = {};
    if (::stat((file + suffix).c_str(), &of_file) != 0) continue;
    // "1: POSIX  ADVISORY  WRITE 1234 08:01:5678 0 EOF": a process, a device and an inode.
    const std::string inode = ":" + std::to_string(of_file.st_ino);
    std::ifstream locks("/proc/locks");
    for (std::string line; std::getline(locks, line);) {
      std::istringstream words(line);
      std::string number, kind, mode, access, place;
      long process = 0;
      if (!(words >> number >> kind >> mode >> access >> process >> place) || !place.ends_with(inode)) continue;
      std::string name;
      std::getline(std::ifstream("/proc/" + std::to_string(process) + "/comm"), name);
      // A lock that another machine holds through a network file system has no process here.
      if (!name.empty()) return "process " + std::to_string(process) + " (" + printable(name) + ")";
    }
  }
  return "another process";
}

/// What SQLite complains of, in words of a user of a study's store. @param code  without its extension
std::string reason_of(int code, sqlite3* database) {
  switch (code) {
    case SQLITE_CORRUPT: return "its pages are damaged";
    case SQLITE_NOTADB: return "it is not a database";
    case SQLITE_FULL: return "the disk is full";
    case SQLITE_CANTOPEN: return "cannot be opened";
    case SQLITE_READONLY: return "may not be written";
    case SQLITE_PERM:
    case SQLITE_AUTH: return "access is not allowed";
    case SQLITE_ERROR:
    case SQLITE_SCHEMA:
    case SQLITE_CONSTRAINT:
    case SQLITE_MISMATCH: return "its tables are not those of a study";
    default: break;
  }
  const int error = sqlite3_system_errno(database);
  return error != 0 ? std::strerror(error) : "reading or writing failed";
}

}  // namespace

Connection::Connection(const std::string& file, Mode mode) : file_(file), mode_(mode) {
  require_plain_files(file);
  sqlite3* opened = nullptr;
  const int flags = mode == Mode::write ? SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE : SQLITE_OPEN_READWRITE;
  const int code = sqlite3_open_v2(file.c_str(), &opened, flags | SQLITE_OPEN_NOMUTEX, nullptr);
  database_.reset(opened);
  if (code != SQLITE_OK) fail();
  sqlite3_extended_result_codes(opened, 1);
  sqlite3_busy_timeout(opened, 200);  // ms
  // A quoted name that is not a column's is an error, not a word: a table without a column would have its name in every row.
  sqlite3_db_config(opened, SQLITE_DBCONFIG_DQS_DML, 0, nullptr);
}

void Connection::wait_for_locks() {
  patient_ = true;
  sqlite3_busy_timeout(database_.get(), 10'000);  // ms
}

void Connection::fail() const {
  const int extended = database_ ? sqlite3_extended_errcode(database_.get()) : SQLITE_NOMEM;
  const int code = extended & 0xff;
  if (code == SQLITE_NOMEM || extended == SQLITE_IOERR_NOMEM) throw std::bad_alloc();
  std::string reason = reason_of(code, database_.get());
  if (code == SQLITE_BUSY || code == SQLITE_LOCKED) {
    if (!patient_) refuse_in_use(file_, holder_of(file_));
    reason = "is in use by " + holder_of(file_);
  }
  // An error of a statement means that a table or a column is not there.
  const bool is_damaged = code == SQLITE_CORRUPT || code == SQLITE_NOTADB || code == SQLITE_ERROR || code == SQLITE_TOOBIG ||
                          extended == SQLITE_IOERR_SHORT_READ;
  if (is_damaged) require_read();
  if (is_damaged) throw DamageError(file_, reason);
  if (mode_ == Mode::write) throw WriteError(file_, reason);
  throw ReadError(file_, reason + "; check the disk");
}

bool Connection::head_forbids_writing() const {
  constexpr sqlite3_int64 kWriteVersion = 18;  // place in the head; 1 and 2 are known [SQLite, Database File Format, 1.3]
  sqlite3_file* opened = nullptr;
  unsigned char version = 0;
  return sqlite3_db_readonly(get(), "main") == 1 &&
         sqlite3_file_control(get(), "main", SQLITE_FCNTL_FILE_POINTER, &opened) == SQLITE_OK && opened != nullptr &&
         opened->pMethods != nullptr && opened->pMethods->xRead(opened, &version, 1, kWriteVersion) == SQLITE_OK && version > 2;
}

void Connection::require_read() const {
  const auto require = [&](int error) {
    for (const int fault : {EIO, ENXIO, ESTALE})
      if (error == fault) throw ReadError(file_, fmt::format("reading failed ({}); check the disk", std::strerror(error)));
  };
  int error = 0;
  if (sqlite3_file_control(database_.get(), "main", SQLITE_FCNTL_LAST_ERRNO, &error) == SQLITE_OK) require(error);
  sqlite3_file* log = nullptr;
  if (sqlite3_file_control(database_.get(), "main", SQLITE_FCNTL_JOURNAL_POINTER, &log) != SQLITE_OK) return;
  if (log && log->pMethods && log->pMethods->xFileControl(log, SQLITE_FCNTL_LAST_ERRNO, &error) == SQLITE_OK) require(error);
}

void Connection::execute(const char* sql) {
  if (sqlite3_exec(get(), sql, nullptr, nullptr, nullptr) != SQLITE_OK) fail();
}

Statement::Statement(Connection& connection, const std::string& sql) : connection_(&connection) {
  sqlite3_stmt* prepared = nullptr;
  check(sqlite3_prepare_v2(connection.get(), sql.c_str(), -1, &prepared, nullptr));
  statement_.reset(prepared);
}

void Statement::check(int code) const {
  if (code != SQLITE_OK) connection_->fail();
}

void Statement::bind(int parameter, std::int64_t value) { check(sqlite3_bind_int64(get(), parameter, value)); }

void Statement::bind(int parameter, std::string_view text) {
  check(sqlite3_bind_text64(get(), parameter, text.data(), text.size(), SQLITE_TRANSIENT, SQLITE_UTF8));
}

void Statement::bind(int parameter, const Value& value) {
  if (const auto* number = std::get_if<double>(&value))
    check(sqlite3_bind_double(get(), parameter, *number));
  else if (const auto* word = std::get_if<std::string>(&value))
    bind(parameter, std::string_view(*word));
  else
    check(sqlite3_bind_null(get(), parameter));
}

bool Statement::step() {
  const int code = sqlite3_step(get());
  if (code != SQLITE_ROW && code != SQLITE_DONE) connection_->fail();
  return code == SQLITE_ROW;
}

void Statement::reset() { sqlite3_reset(get()); }

void Statement::execute() {
  while (step()) {
  }
  reset();
}

std::string Statement::text(int column) const {
  const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(get(), column));
  // A value that is there but has no text means that there was no memory for it.
  if (!bytes && sqlite3_errcode(sqlite3_db_handle(get())) == SQLITE_NOMEM) throw std::bad_alloc();
  return bytes ? std::string(bytes, static_cast<std::size_t>(sqlite3_column_bytes(get(), column))) : std::string();
}

Value Statement::value(int column) const {
  switch (sqlite3_column_type(get(), column)) {
    case SQLITE_NULL: return {};
    case SQLITE_INTEGER:
    case SQLITE_FLOAT: return sqlite3_column_double(get(), column);
    default: return text(column);
  }
}

std::optional<double> Statement::number(int column) const {
  const int type = sqlite3_column_type(get(), column);
  if (type != SQLITE_INTEGER && type != SQLITE_FLOAT) return std::nullopt;
  return sqlite3_column_double(get(), column);
}

std::string quoted(std::string_view name) {
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + '"';
}

}  // namespace earthtop::study::sqlite
