// SPDX-License-Identifier: GPL-3.0-or-later
/// SQLite's connections and statements, owned by C++ objects.
#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "earthtop/error.hpp"
#include "study/value.hpp"

namespace earthtop::study::sqlite {

class Connection;

/// A prepared statement. Columns are counted from 0, parameters from 1.
class Statement {
 public:
  Statement(Connection& connection, const std::string& sql);

  void bind(int parameter, std::int64_t value);
  void bind(int parameter, std::string_view text);
  void bind(int parameter, const Value& value);

  /// Goes to the next row. @returns false if there is none
  bool step();
  /// Makes the statement ready to be bound and stepped again.
  void reset();
  /// Steps to the end and resets.
  void execute();

  std::int64_t integer(int column) const { return sqlite3_column_int64(get(), column); }
  std::string text(int column) const;
  Value value(int column) const;
  std::optional<double> number(int column) const;  ///< none in a cell that holds none

 private:
  sqlite3_stmt* get() const { return statement_.get(); }
  void check(int code) const;
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
  };
  Connection* connection_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

/// A file is no database, or its content is not in order: its fault, and not that of the disk.
class DamageError : public ReadError {
  using ReadError::ReadError;
};

class Connection {
 public:
  enum class Mode { read, write };
  /// @throws WriteError or ReadError, according to the mode, if the file cannot be opened; ScenarioError if it is locked, or if
  /// it, or one of the files that SQLite keeps beside it, is something that reading could wait for
  Connection(const std::string& file, Mode mode);

  /// Makes the connection wait up to ten seconds for locks of others: a reader may meet the moment in which the writer moves
  /// its log into the store. A new connection waits only 0.2 s, so that a process which uses the file is reported immediately.
  void wait_for_locks();
  void execute(const char* sql);
  /// To be called before content is called damaged: SQLite says so, too, where the disk failed to give a page.
  /// @throws ReadError if the last read of a file failed
  void require_read() const;
  /// Whether the file's head says that nothing may be written to it, as a flipped bit there does. SQLite itself also opens a file for
  /// reading alone where it cannot open it for writing; that is no damage.
  bool head_forbids_writing() const;
  /// @throws ScenarioError, naming the other process if it can be found, if that process has locked the file and this
  /// connection is not patient; std::bad_alloc if SQLite found no memory; otherwise WriteError (ReadError in read mode, and
  /// of a damaged file) with SQLite's reason
  [[noreturn]] void fail() const;

  sqlite3* get() const { return database_.get(); }

 private:
  struct Close {
    void operator()(sqlite3* database) const { sqlite3_close_v2(database); }
  };
  std::string file_;
  Mode mode_;
  bool patient_ = false;
  std::unique_ptr<sqlite3, Close> database_;
};

/// A name in double quotes, as SQL takes it.
std::string quoted(std::string_view name);

}  // namespace earthtop::study::sqlite
