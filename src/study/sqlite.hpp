// SPDX-License-Identifier: GPL-3.0-or-later
/// SQLite with owners: a connection, and statements that are stepped through.
#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

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

  /// @returns whether there is a row
  bool step();
  /// To be bound and stepped again.
  void reset();
  /// Steps to the end and resets.
  void execute();

  std::int64_t integer(int column) const { return sqlite3_column_int64(get(), column); }
  std::string text(int column) const;
  Value value(int column) const;

 private:
  sqlite3_stmt* get() const { return statement_.get(); }
  void check(int code) const;
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
  };
  Connection* connection_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

class Connection {
 public:
  enum class Mode { read, write };
  /// @throws WriteError or ReadError
  Connection(const std::string& file, Mode mode);

  /// From now on what others have locked is waited for: a reader of a store that is being written may meet the moment in which
  /// its log is taken in. A connection that has just been opened hardly waits: others that use the file are to be named at
  /// once.
  void be_patient();
  void execute(const char* sql);
  /// @throws ScenarioError, with the process as far as it is known, where another one has locked the file and this connection
  /// is not patient; WriteError, or ReadError of a connection for reading, with SQLite's reason
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

/// A name as SQL may take it: in double quotes.
std::string quoted(std::string_view name);

}  // namespace earthtop::study::sqlite
