// SPDX-License-Identifier: GPL-3.0-or-later
// Changes of a study's store that leave it a database.
#include <fmt/format.h>
#include <sqlite3.h>

#include <cstring>
#include <memory>
#include <random>
#include <vector>

#include "fuzz/mutation.hpp"

namespace earthtop::fuzz {
namespace {

using Random = std::mt19937;

std::size_t below(Random& random, std::size_t count) { return count == 0 ? 0 : random() % count; }

struct Close {
  void operator()(sqlite3* database) const { sqlite3_close_v2(database); }
};
using Database = std::unique_ptr<sqlite3, Close>;

/// The bytes as a database in memory; null where they are none.
Database open(std::string_view bytes) {
  sqlite3* opened = nullptr;
  if (sqlite3_open(":memory:", &opened) != SQLITE_OK) return nullptr;
  Database database(opened);
  auto* copy = static_cast<unsigned char*>(sqlite3_malloc64(bytes.size()));
  if (!copy) return nullptr;
  std::memcpy(copy, bytes.data(), bytes.size());
  const auto size = static_cast<sqlite3_int64>(bytes.size());
  if (sqlite3_deserialize(opened, "main", copy, size, size, SQLITE_DESERIALIZE_FREEONCLOSE | SQLITE_DESERIALIZE_RESIZEABLE) !=
      SQLITE_OK)
    return nullptr;
  return database;
}

std::vector<std::string> names(sqlite3* database, const std::string& query) {
  std::vector<std::string> list;
  sqlite3_stmt* statement = nullptr;
  if (sqlite3_prepare_v2(database, query.c_str(), -1, &statement, nullptr) == SQLITE_OK)
    while (sqlite3_step(statement) == SQLITE_ROW)
      if (const auto* text = sqlite3_column_text(statement, 0)) list.emplace_back(reinterpret_cast<const char*>(text));
  sqlite3_finalize(statement);
  return list;
}

std::string quoted(const std::string& name) {
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? "\"\"" : std::string(1, c);
  return text + "\"";
}

std::string odd_value(Random& random) {
  static const std::vector<std::string> kValues = {"NULL",
                                                   "0",
                                                   "-1",
                                                   "1e308",
                                                   "-1e308",
                                                   "9e999",
                                                   "-9e999",
                                                   "5e-324",
                                                   "9223372036854775807",
                                                   "-9223372036854775808",
                                                   "''",
                                                   "'x'",
                                                   "'nan'",
                                                   "'completed'",
                                                   "'refused'",
                                                   "'accuracy_not_reached'",
                                                   "x'00ff'",
                                                   "x'6100620a'",
                                                   "'<b>&''\"'",
                                                   "'=1+1'",
                                                   "char(10, 13, 34, 44)",
                                                   "char(8238, 7)",
                                                   "replace(hex(zeroblob(2000)), '00', 'long ')",
                                                   "cast(x'c0ff' AS TEXT)",
                                                   "'{}'",
                                                   "'['",
                                                   "zeroblob(50)",
                                                   "'1'",
                                                   "1.5"};
  return kValues[below(random, kValues.size())];
}

std::string change(sqlite3* database, Random& random) {
  const auto columns = names(database, "SELECT name FROM pragma_table_info('point')");
  const auto facts = names(database, "SELECT key FROM study");
  const auto numbers = names(database, "SELECT number FROM point");
  const auto one_of = [&](const std::vector<std::string>& list) {
    return list.empty() ? std::string("x") : list[below(random, list.size())];
  };
  const std::string column = quoted(one_of(columns)), number = numbers.empty() ? "0" : one_of(numbers);
  switch (below(random, 12)) {
    case 0: return fmt::format("UPDATE study SET value = {} WHERE key = '{}'", odd_value(random), one_of(facts));
    case 1: {  // one character of a fact
      const std::string fact = one_of(facts);
      const std::size_t at = 1 + below(random, 1500);
      return fmt::format(
          "UPDATE study SET value = substr(value, 1, {0}) || char({1}) || substr(value, {0} + 2) WHERE key = '{2}'", at,
          32 + below(random, 95), fact);
    }
    case 2: return fmt::format("DELETE FROM study WHERE key = '{}'", one_of(facts));
    case 3: return fmt::format("DELETE FROM point WHERE number = {}", number);
    case 4: return fmt::format("UPDATE point SET number = {} WHERE number = {}", odd_value(random), number);
    case 5: return fmt::format("ALTER TABLE point DROP COLUMN {}", column);
    case 6: return fmt::format("ALTER TABLE point RENAME COLUMN {} TO {}", column, quoted(one_of(columns) + "x"));
    case 7:
      return fmt::format("ALTER TABLE point ADD COLUMN {} DEFAULT {}", quoted("c" + std::to_string(random() % 3)),
                         odd_value(random));
    case 8:  // a store from before there were checksums, of which everything is believed
      return "ALTER TABLE point DROP COLUMN row_checksum; DELETE FROM study WHERE key IN ('facts_checksum', 'contents')";
    case 9: return fmt::format("CREATE VIEW v{} AS SELECT * FROM point; DROP TABLE study", random() % 3);
    default: return fmt::format("UPDATE point SET {} = {} WHERE number = {}", column, odd_value(random), number);
  }
}

}  // namespace

std::string mutated_store(std::string_view input, std::uint32_t seed) {
  Random random(seed);
  const Database database = open(input);
  if (!database) return "";
  // Most stores lose their checksums first: otherwise every change would only be noticed.
  if (below(random, 4) == 0)
    sqlite3_exec(database.get(),
                 "ALTER TABLE point DROP COLUMN row_checksum; DELETE FROM study WHERE key IN ('facts_checksum', 'contents')",
                 nullptr, nullptr, nullptr);
  for (std::size_t times = 1 + below(random, 3); times > 0; --times)
    sqlite3_exec(database.get(), change(database.get(), random).c_str(), nullptr, nullptr, nullptr);
  sqlite3_int64 size = 0;
  const std::unique_ptr<unsigned char, decltype(&sqlite3_free)> bytes(sqlite3_serialize(database.get(), "main", &size, 0),
                                                                      &sqlite3_free);
  return bytes ? std::string(reinterpret_cast<const char*>(bytes.get()), static_cast<std::size_t>(size)) : "";
}

}  // namespace earthtop::fuzz
