// SPDX-License-Identifier: GPL-3.0-or-later
// Changes of a study's store that leave it a database, and damage that may not.
#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "earthtop/error.hpp"
#include "fuzz/mutation.hpp"
#include "fuzz/properties.hpp"
#include "study/store.hpp"
#include "text/json.hpp"

namespace earthtop::fuzz {
namespace {

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

std::string odd_sql(Random& random) {
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
  return one_of(random, kValues);
}

constexpr const char* kWithoutChecksums =
    "ALTER TABLE point DROP COLUMN row_checksum; DELETE FROM study WHERE key IN ('facts_checksum', 'contents')";

std::string change(sqlite3* database, Random& random) {
  const auto columns = names(database, "SELECT name FROM pragma_table_info('point')");
  const auto facts = names(database, "SELECT key FROM study");
  const auto numbers = names(database, "SELECT number FROM point");
  const auto name_in = [&](const std::vector<std::string>& list) {
    return list.empty() ? std::string("x") : one_of(random, list);
  };
  const std::string column = quoted(name_in(columns)), number = numbers.empty() ? "0" : one_of(random, numbers);
  switch (below(random, 12)) {
    case 0: return fmt::format("UPDATE study SET value = {} WHERE key = '{}'", odd_sql(random), name_in(facts));
    case 1: {  // one character of a fact
      const std::string fact = name_in(facts);
      const std::size_t at = 1 + below(random, 1500);
      return fmt::format(
          "UPDATE study SET value = substr(value, 1, {0}) || char({1}) || substr(value, {0} + 2) WHERE key = '{2}'", at,
          32 + below(random, 95), fact);
    }
    case 2: return fmt::format("DELETE FROM study WHERE key = '{}'", name_in(facts));
    case 3: return fmt::format("DELETE FROM point WHERE number = {}", number);
    case 4: return fmt::format("UPDATE point SET number = {} WHERE number = {}", odd_sql(random), number);
    case 5: return fmt::format("ALTER TABLE point DROP COLUMN {}", column);
    case 6: return fmt::format("ALTER TABLE point RENAME COLUMN {} TO {}", column, quoted(name_in(columns) + "x"));
    case 7:
      return fmt::format("ALTER TABLE point ADD COLUMN {} DEFAULT {}", quoted("c" + std::to_string(random() % 3)),
                         odd_sql(random));
    case 8:  // a store from before there were checksums, of which everything is believed
      return kWithoutChecksums;
    case 9: return fmt::format("CREATE VIEW v{} AS SELECT * FROM point; DROP TABLE study", random() % 3);
    default: return fmt::format("UPDATE point SET {} = {} WHERE number = {}", column, odd_sql(random), number);
  }
}

std::string bytes_of(sqlite3* database) {
  sqlite3_int64 size = 0;
  const std::unique_ptr<unsigned char, decltype(&sqlite3_free)> bytes(sqlite3_serialize(database, "main", &size, 0),
                                                                      &sqlite3_free);
  return bytes ? std::string(reinterpret_cast<const char*>(bytes.get()), static_cast<std::size_t>(size)) : "";
}

/// Changes what is there. Half of the stores lose their checksums first: of the others every change is noticed.
std::string changed_in_place(sqlite3* database, Random& random) {
  const auto run = [&](const std::string& sql) { sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr); };
  if (one_in(random, 2)) run(kWithoutChecksums);
  for (std::size_t times = 1 + below(random, 3); times > 0; --times) run(change(database, random));
  return bytes_of(database);
}

// A store that the program itself makes: of the same study or of another one, of the same points or of more.

using study::Facts;

Facts facts_of(sqlite3* database) {
  Facts facts;
  const auto keys = names(database, "SELECT key FROM study ORDER BY key"),
             values = names(database, "SELECT value FROM study ORDER BY key");
  for (std::size_t i = 0; i < std::min(keys.size(), values.size()); ++i) facts[keys[i]] = values[i];
  return facts;
}

study::Value odd_point_value(Random& random) {
  static const std::vector<double> kNumbers = {
      0, -0.0, 1, -1, 0.5, 45, 1e-300, 5e-324, 1e18, 1e300, 1.7976931348623157e308, -1.7976931348623157e308};
  if (one_in(random, 8)) return {};
  if (one_in(random, 4)) return odd_words(random);
  return one_of(random, kNumbers);
}

/// The points of a table, by the place of its columns.
std::vector<study::PointResult> points_of(sqlite3* database, const Study& study, Random& random) {
  constexpr int kBefore = 4;  // number, status, reason, scenario
  std::vector<study::PointResult> points;
  sqlite3_stmt* statement = nullptr;
  if (sqlite3_prepare_v2(database, "SELECT * FROM point ORDER BY rowid", -1, &statement, nullptr) == SQLITE_OK)
    while (sqlite3_step(statement) == SQLITE_ROW) {
      const auto word = [&](int at) {
        const auto* text = sqlite3_column_text(statement, at);
        return text ? std::string(reinterpret_cast<const char*>(text)) : std::string();
      };
      const auto value = [&](std::size_t place) -> study::Value {
        const int at = kBefore + static_cast<int>(place);
        switch (sqlite3_column_type(statement, at)) {
          case SQLITE_NULL: return at < sqlite3_column_count(statement) ? study::Value() : odd_point_value(random);
          case SQLITE_INTEGER:
          case SQLITE_FLOAT: return sqlite3_column_double(statement, at);
          default: return word(at);
        }
      };
      study::PointResult& point = points.emplace_back();
      point.number = static_cast<std::uint64_t>(sqlite3_column_int64(statement, 0));
      point.status = word(1), point.reason = word(2), point.scenario_sha256 = word(3);
      for (std::size_t i = 0; i < study.axes.size(); ++i) point.axis_values.push_back(value(i));
      for (std::size_t i = 0; i < study.quantities.size(); ++i) point.values.push_back(value(study.axes.size() + i));
    }
  sqlite3_finalize(statement);
  return points;
}

void change_points(std::vector<study::PointResult>& points, Random& random) {
  if (points.empty()) return;
  if (one_in(random, 3)) {  // more points, few or so many that pages show them otherwise
    const std::size_t count = points.size() + (one_in(random, 40) ? 1001 : below(random, 40));
    while (points.size() < count) {
      points.push_back(points[below(random, points.size())]);
      points.back().number = points.size() - 1;
      for (auto* list : {&points.back().axis_values, &points.back().values})
        for (study::Value& value : *list)
          if (auto* number = std::get_if<double>(&value)) *number *= 1 + 0.01 * static_cast<double>(below(random, 200));
    }
  }
  for (std::size_t times = below(random, 4); times > 0; --times) {
    study::PointResult& point = points[below(random, points.size())];
    switch (below(random, 5)) {
      case 0:
        point.number =
            one_of(random, std::array<std::uint64_t, 6>{0, 1, 63, 1U << 20U, std::uint64_t{1} << 53U, ~std::uint64_t{0}});
        break;
      case 1:
        point.status = one_of(random, std::array{"completed", "refused", "accuracy_not_reached", "interrupted", "", "<b>"});
        break;
      case 2: point.reason = odd_words(random); break;
      case 3:
        if (!point.axis_values.empty()) point.axis_values[below(random, point.axis_values.size())] = odd_point_value(random);
        break;
      default:
        if (!point.values.empty()) point.values[below(random, point.values.size())] = odd_point_value(random);
    }
  }
}

/// The text of another study: of another design, with another axis or fit, or changed anywhere.
std::string changed_study(const std::string& text, Random& random) {
  using Json = nlohmann::ordered_json;
  static const std::vector<std::string> kDesigns = {R"({"kind": "grid"})",
                                                    R"({"kind": "one_at_a_time"})",
                                                    R"({"kind": "random", "points": 9})",
                                                    R"({"kind": "latin_hypercube", "points": 5, "seed": 7})",
                                                    R"({"kind": "sobol", "points": 6})",
                                                    R"({"kind": "sobol", "points": 3, "indices": true})"};
  static const std::vector<std::string> kAxes = {
      R"({"name": "spin", "pointer": "/release/spin_rad_s", "log_range": {"from": 50, "to": 800, "points": 3}})",
      R"({"name": "latitude", "pointer": "/site/latitude_deg", "range": {"from": -90, "to": 90, "points": 4}})",
      R"({"name": "two", "pointers": ["/release/tilt_deg", "/release/azimuth_deg"], "values": [[1, 2], [3, 4]]})",
      R"({"name": "word", "pointer": "/release/rates_relative_to", "values": ["laboratory", "inertial", null, true]})"};
  static const std::vector<std::string> kFits = {"linear", "sin_latitude", "cos_latitude", "logarithmic", "power_law"};
  Json json = Json::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains("axes") || !json["axes"].is_array() || json["axes"].empty())
    return changed_text(text, random);
  if (!json.contains("fits")) json["fits"] = Json::array();
  if (!json.contains("design")) json["design"] = Json::object();
  Json& axes = json["axes"];  // from here on no member is added: the others would move
  switch (below(random, 5)) {
    case 0: json["design"] = json_of(one_of(random, kDesigns)); break;
    case 1: axes[below(random, axes.size())] = json_of(one_of(random, kAxes)); break;
    case 2: axes.push_back(json_of(one_of(random, kAxes))); break;
    case 3:
      if (json["fits"].is_array() && axes[0].is_object() && axes[0].contains("name"))
        json["fits"].push_back({{"kind", one_of(random, kFits)},
                                {"axis", axes[0]["name"]},
                                {"quantity", one_of(random, std::array{"a", "drift.axis_final_rad"})}});
      break;
    default: return changed_text(text, random);
  }
  return written_replacing(json);
}

/// @returns none where the database holds no study that can be read
std::optional<std::string> made_anew(sqlite3* database, Random& random) {
  Facts facts = facts_of(database);
  const ScenarioSource base{facts["base_file"], facts["base"]};
  const auto study_of = [&](const std::string& text) -> std::optional<Study> {
    try {
      return parse_study({"fuzz.json", text}, base);
    } catch (const ScenarioError&) {
      return std::nullopt;
    }
  };
  std::optional<Study> study = study_of(facts["study"]);
  for (std::size_t times = below(random, 4); study && times > 0; --times)
    if (auto other = study_of(changed_study(study->text, random))) study = std::move(other);
  if (!study) return std::nullopt;
  auto points = points_of(database, *study, random);
  change_points(points, random);
  const auto file = Scratch::empty() / "anew.sqlite";
  {
    study::Store store = study::Store::create(file, *study, {});
    store.begin();
    for (const study::PointResult& point : points) store.insert(point);
    store.commit();
    store.finish();
  }
  return content_of(file);
}

/// Changes a fact, so that the checksum of all of them still fits.
void change_fact(sqlite3* database, Random& random) {
  const auto facts = names(database, "SELECT key FROM study WHERE key NOT IN ('facts_checksum', 'contents')");
  if (facts.empty()) return;
  const auto run = [&](const std::string& sql) { sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr); };
  run(fmt::format("UPDATE study SET value = {} WHERE key = '{}'", odd_sql(random), one_of(random, facts)));
  run(fmt::format("UPDATE study SET value = '{}' WHERE key = 'facts_checksum'", study::facts_checksum(facts_of(database))));
}

}  // namespace

std::string mutated_store(std::string_view input, std::uint32_t seed) {
  Random random(seed);
  Database database = open(input);
  if (!database) return "";
  if (one_in(random, 2)) return changed_in_place(database.get(), random);
  const auto made = made_anew(database.get(), random);
  if (!made) return "";
  if (!one_in(random, 4)) return *made;
  database = open(*made);
  change_fact(database.get(), random);
  return bytes_of(database.get());
}

std::string damaged_store(std::string_view input, std::uint32_t seed) {
  Random random(seed);
  constexpr std::size_t kHeader = 100;
  if (input.size() < kHeader) return "";
  // No change here has checksums that fit it: a repair would keep it.
  if (const Database database = one_in(random, 3) ? open(input) : nullptr) return changed_in_place(database.get(), random);
  std::string bytes(input);
  const std::size_t stated = static_cast<unsigned char>(bytes[16]) * 256U + static_cast<unsigned char>(bytes[17]);
  const std::size_t page = stated >= 512 && stated <= bytes.size() ? stated : 512, pages = bytes.size() / page;
  for (std::size_t times = 1 + below(random, 2); times > 0 && bytes.size() >= page; --times) {
    const std::size_t at = std::min(below(random, pages) * page, bytes.size() - page),
                      from = std::min(below(random, pages) * page, bytes.size() - page);
    switch (below(random, 8)) {
      case 0: bytes.replace(at, page, page, '\0'); break;
      case 1: bytes.replace(at, page, bytes.substr(from, page)); break;
      case 2: bytes.resize(at + (one_in(random, 2) ? 0 : below(random, page))); break;
      case 3: bytes += bytes.substr(from, one_in(random, 2) ? page : below(random, page)); break;
      case 4: bytes[below(random, kHeader)] = static_cast<char>(random()); break;
      case 5: bytes[at + below(random, 12)] = static_cast<char>(random()); break;  // the head of a page
      case 6: bytes.replace(at + below(random, page * 7 / 8), page / 8, page / 8, '\xFF'); break;
      default: bytes[at + below(random, page)] ^= static_cast<char>(1U << below(random, 8));
    }
  }
  return bytes;
}

}  // namespace earthtop::fuzz
