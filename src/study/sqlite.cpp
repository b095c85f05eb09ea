#include "study/sqlite.hpp"

#include "earthtop/error.hpp"

namespace earthtop::study::sqlite {

Connection::Connection(const std::string& file, Mode mode) : file_(file), mode_(mode) {
  sqlite3* opened = nullptr;
  const int flags = mode == Mode::write ? SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE : SQLITE_OPEN_READWRITE;
  const int code = sqlite3_open_v2(file.c_str(), &opened, flags | SQLITE_OPEN_NOMUTEX, nullptr);
  database_.reset(opened);
  if (code != SQLITE_OK) fail();
  sqlite3_extended_result_codes(opened, 1);
  sqlite3_busy_timeout(opened, 10'000);  // ms; a reader may meet a checkpoint
}

void Connection::fail() const {
  const std::string reason = database_ ? sqlite3_errmsg(database_.get()) : "out of memory";
  if (mode_ == Mode::write) throw WriteError(file_, reason);
  throw ReadError(file_, reason);
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

std::string quoted(std::string_view name) {
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + '"';
}

}  // namespace earthtop::study::sqlite
