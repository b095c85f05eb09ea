// SPDX-License-Identifier: GPL-3.0-or-later
#include "input/schema.hpp"

#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "text/json.hpp"

namespace earthtop::input {
namespace {

using Json = nlohmann::ordered_json;

void add_range(Json& schema, const Range& range) {
  if (!std::isinf(range.least)) schema[range.least_excluded ? "exclusiveMinimum" : "minimum"] = range.least;
  if (!std::isinf(range.most)) schema["maximum"] = range.most;
}

Json array_of(int size, Json items) {
  return {{"type", "array"}, {"items", std::move(items)}, {"minItems", size}, {"maxItems", size}};
}

Json series_of(Json items) {
  return {{"type", "array"}, {"items", std::move(items)}, {"minItems", 1}, {"maxItems", kLongestSeries}};
}

class SchemaWriter {
 public:
  SchemaWriter(const FieldTable& table, SchemaRules rules) : table_(table), rules_(rules) {}

  Json of_object(std::string_view pattern) const {
    Json properties = Json::object(), needed = Json::array();
    for (const std::string_view key : table_.keys_below(pattern)) {
      const Field& field = *table_.find(fmt::format("{}/{}", pattern, key));
      Json schema = of_field(field);
      schema["description"] = field.unit.empty() ? std::string(field.doc) : fmt::format("{} ({})", field.doc, field.unit);
      if (!field.fallback.empty()) schema["default"] = json_of(field.fallback);
      properties[key] = std::move(schema);
      if (field.required) needed.push_back(key);
    }
    Json schema = {{"type", "object"},
                   {"properties", std::move(properties)},
                   {"patternProperties", {{"^(_|//)", true}}},
                   {"additionalProperties", false}};
    if (!needed.empty()) schema["required"] = std::move(needed);
    if (Json rules = rules_ ? rules_(pattern) : Json(); !rules.empty()) schema["allOf"] = std::move(rules);
    return schema;
  }

 private:
  Json of_field(const Field& field) const {
    Json number = {{"type", "number"}};
    add_range(number, field.range);
    Json words = {{"enum", split_words(field.words)}};
    switch (field.kind) {
      case FieldKind::object: return of_object(field.pointer);
      case FieldKind::object_or_word:
        if (field.words.empty()) return of_object(field.pointer);
        return {{"oneOf", Json::array({words, of_object(field.pointer)})}};
      case FieldKind::flag_or_object: {
        Json choices = Json::array({{{"type", "boolean"}}, of_object(field.pointer)});
        if (!field.words.empty()) choices.push_back(words);
        return {{"oneOf", choices}};
      }
      case FieldKind::list:
        return {{"type", "array"}, {"minItems", 1}, {"items", of_object(std::string(field.pointer) + "/*")}};
      case FieldKind::text: return {{"type", "string"}};
      case FieldKind::name: return {{"type", "string"}, {"pattern", "^[a-z0-9][a-z0-9-]{0,63}$"}};
      case FieldKind::word: return words;
      case FieldKind::flag: return {{"type", "boolean"}};
      case FieldKind::number: return number;
      case FieldKind::number_or_vector3: return {{"oneOf", Json::array({number, array_of(3, number)})}};
      case FieldKind::vector2: return array_of(2, number);
      case FieldKind::vector3: return array_of(3, number);
      case FieldKind::matrix3: return array_of(3, array_of(3, number));
      case FieldKind::numbers: return {{"type", "array"}, {"items", number}, {"minItems", 1}, {"maxItems", 4}};
      case FieldKind::series: return series_of(number);
      case FieldKind::points: return series_of(array_of(3, number));
      case FieldKind::changes:
        return {{"type", "array"}, {"minItems", 1}, {"items", {{"type", "string"}, {"pattern", "^/[^=]*="}}}};
      case FieldKind::anything: return Json::object();
    }
    return false;
  }

  const FieldTable& table_;
  SchemaRules rules_;
};

}  // namespace

std::string schema(const FieldTable& table, std::string_view about, SchemaRules rules) {
  Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"},
                 {"$id", fmt::format("earthtop-{}-1.json", table.name)},
                 {"title", fmt::format("earthtop {}", table.name)},
                 {"description", std::string(about) + " Keys that begin with _ or // are comments."}};
  schema.update(SchemaWriter(table, rules).of_object(""));
  return written(schema, 2) + '\n';
}

}  // namespace earthtop::input
