// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "earthtop/scenario/reference.hpp"
#include "scenario/fields.hpp"
#include "scenario/rules.hpp"
#include "text/json.hpp"

namespace earthtop {
namespace scenario {
namespace {

using Json = nlohmann::ordered_json;

Json required(std::string_view keys) { return {{"required", split_words(keys)}}; }
Json none_of(std::string_view keys) {
  Json any = Json::array();
  for (const std::string_view key : split_words(keys)) any.push_back(required(key));
  return {{"not", {{"anyOf", any}}}};
}
Json exactly_one(std::string_view a, std::string_view b) { return {{"oneOf", Json::array({required(a), required(b)})}}; }
/// Whether a key stands there with a value that obeys the schema.
Json has(std::string_view key, Json schema) {
  Json rule = required(key);
  rule["properties"][std::string(key)] = std::move(schema);
  return rule;
}
/// Where `key` is `word`, `then` holds.
Json when(std::string_view key, std::string_view word, Json then, Json otherwise = true) {
  return {{"if", has(key, {{"const", word}})}, {"then", std::move(then)}, {"else", std::move(otherwise)}};
}

Json solid_rules() {
  Json rules = Json::array({exactly_one("mass_kg", "density_kg_m3")});
  for (const ShapeRule& rule : kShapeRules) {
    Json properties = Json::object(), needed = Json::array();
    const auto member = [&](std::string_view key, Need need) {
      if (need == Need::none) properties[key] = false;
      if (need == Need::required) needed.push_back(key);
    };
    member("radius_m", rule.radius);
    member("inner_radius_m", rule.inner_radius);
    member("length_m", rule.length);
    if (rule.length == Need::required) properties["length_m"] = {{"exclusiveMinimum", 0}};
    rules.push_back(when("shape", rule.word, {{"properties", properties}, {"required", needed}}));
  }
  return rules;
}

Json platform_rules() {
  Json rules = Json::array();
  for (const MotionRule& rule : kMotionRules) {
    Json properties = Json::object();
    const auto allowed = split_words(rule.allowed);
    for (const std::string_view key : split_words(kMotionKeys))
      if (std::find(allowed.begin(), allowed.end(), key) == allowed.end()) properties[key] = false;
    rules.push_back(when("motion", rule.word, {{"properties", properties}, {"required", split_words(rule.required)}}));
  }
  return rules;
}

/// Latitude is needed where the Earth turns, or where gravity is computed from it.
Json site_rule() {
  Json nothing_to_know = has("site", required("gravity_m_s2"));
  nothing_to_know.update(has("earth", has("rotation_rate_rad_s", {{"const", 0}})), true);
  nothing_to_know["required"] = {"site", "earth"};
  return {{"anyOf", Json::array({has("site", required("latitude_deg")), nothing_to_know})}};
}

Json body_rule() {
  Json given = required("mass_kg|center_of_mass_m|inertia"), solids = required("solids");
  given.update(none_of("solids"));
  solids.update(none_of("mass_kg|center_of_mass_m|inertia"));
  return {{"oneOf", Json::array({given, solids})}};
}

Json release_rule() {
  return {{"dependencies",
           {{"quaternion_LB", none_of("azimuth_deg|spin_angle_deg")}, {"angular_velocity_body_rad_s", none_of("precession")}}}};
}

/// Of Moon and Sun, or of given amplitude.
Json tide_rule() {
  Json harmonic = required("frequency_hz");
  harmonic.update(none_of("gravimetric_factor|tilt_factor"));
  return {{"dependencies",
           {{"amplitude_m_s2", harmonic},
            {"frequency_hz", Json::array({"amplitude_m_s2"})},
            {"phase_deg", Json::array({"amplitude_m_s2"})}}}};
}

Json numerics_rule() {
  Json fixed_step = required("step_s");
  fixed_step.update(none_of("relative_tolerance"));
  Json rule = none_of("step_s");
  for (const MethodRow& row : kMethodRows)
    if (is_exact(row.method)) rule = when("method", row.word, none_of("step_s|relative_tolerance"), rule);
  for (const MethodRow& row : kMethodRows) {
    if (row.step_s == Need::none) continue;
    const Json one_of_two = {{"not", required("step_s|relative_tolerance")}};
    rule = when("method", row.word, row.step_s == Need::required ? fixed_step : one_of_two, rule);
  }
  return rule;
}

/// Another method than one that composes flows leaves nothing to choose.
Json composition_rule() {
  Json rule = {{"properties", {{"composition", {{"enum", Json::array({to_string(Composition::automatic)})}}}}}};
  for (const MethodRow& row : kMethodRows)
    if (row.composes) rule = when("method", row.word, Json::object(), rule);
  return rule;
}

/// What the precision allows, as in `decode_precision`; double where none is given.
Json precision_rule() {
  const auto allowed = [](Precision precision) -> Json {
    Json methods = Json::array();
    for (const Method method : methods_by(&MethodRow::place_in_menus))
      if (is_built(method, precision)) methods.push_back(to_string(method));
    return {
        {"properties", {{"method", {{"enum", methods}}}, {"relative_tolerance", {{"minimum", least_tolerance(precision)}}}}}};
  };
  return when("precision", "float128", allowed(Precision::bits113),
              when("precision", "long_double", allowed(Precision::bits64), allowed(Precision::bits53)));
}

Json criterion_rules() {
  Json rules = Json::array();
  for (const CriterionRule& rule : kCriterionRules) {
    Json properties = Json::object();
    const auto allowed = split_words(rule.allowed);
    for (const std::string_view key : split_words(kCriterionKeys))
      if (std::find(allowed.begin(), allowed.end(), key) == allowed.end()) properties[key] = false;
    if (!rule.quantities.empty()) properties["quantity"] = {{"enum", split_words(rule.quantities)}};
    rules.push_back(when("kind", rule.word, {{"properties", properties}, {"required", split_words(rule.required)}}));
  }
  return rules;
}

/// Rules of an object that involve more than one of its keys; an empty array where there are none.
Json rules_of(std::string_view pattern) {
  if (pattern.empty()) return Json::array({site_rule()});
  if (pattern == "/headline") return Json::array({{{"if", has("quantity", {{"pattern", "\\."}})}, {"then", none_of("at_s")}}});
  if (pattern == "/criteria/*") return criterion_rules();
  if (pattern == "/body") return Json::array({body_rule()});
  if (pattern == "/body/inertia") return Json::array({exactly_one("principal_kg_m2", "matrix_kg_m2")});
  if (pattern == "/body/solids/*") return solid_rules();
  if (pattern == "/release")
    return Json::array(
        {exactly_one("tilt_deg", "quaternion_LB"), exactly_one("spin_rad_s", "angular_velocity_body_rad_s"), release_rule()});
  if (pattern == "/site") return Json::array({{{"dependencies", {{"gravity_m_s2", none_of("gravity_anomaly_m_s2")}}}}});
  if (pattern == "/motion")
    return Json::array(
        {{{"properties", {{"start_utc", {{"pattern", "^\\d{4}-\\d{2}-\\d{2}T\\d{2}:\\d{2}:\\d{2}([.]\\d+)?Z$"}}}}}}});
  if (pattern == "/effects/tide") return Json::array({tide_rule()});
  if (pattern == "/platform") return platform_rules();
  if (pattern == "/numerics") return Json::array({numerics_rule(), composition_rule(), precision_rule()});
  return Json::array();
}

void add_range(Json& schema, const Range& range) {
  if (!std::isinf(range.least)) schema[range.least_excluded ? "exclusiveMinimum" : "minimum"] = range.least;
  if (!std::isinf(range.most)) schema["maximum"] = range.most;
}

Json of_object(std::string_view pattern);

Json of_three(Json items) { return {{"type", "array"}, {"items", std::move(items)}, {"minItems", 3}, {"maxItems", 3}}; }

Json of_field(const Field& field) {
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
    case FieldKind::list: return {{"type", "array"}, {"minItems", 1}, {"items", of_object(std::string(field.pointer) + "/*")}};
    case FieldKind::text: return {{"type", "string"}};
    case FieldKind::name: return {{"type", "string"}, {"pattern", "^[a-z0-9][a-z0-9-]{0,63}$"}};
    case FieldKind::word: return words;
    case FieldKind::flag: return {{"type", "boolean"}};
    case FieldKind::number: return number;
    case FieldKind::vector3: return of_three(number);
    case FieldKind::matrix3: return of_three(of_three(number));
    case FieldKind::numbers: return {{"type", "array"}, {"items", number}, {"minItems", 1}, {"maxItems", 4}};
    case FieldKind::changes:
      return {{"type", "array"}, {"minItems", 1}, {"items", {{"type", "string"}, {"pattern", "^/[^=]*="}}}};
    case FieldKind::anything: return Json::object();
  }
  return false;
}

Json of_object(std::string_view pattern) {
  Json properties = Json::object(), needed = Json::array();
  for (const std::string_view key : keys_below(pattern)) {
    const Field& field = *find_field(fmt::format("{}/{}", pattern, key));
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
  if (Json rules = rules_of(pattern); !rules.empty()) schema["allOf"] = std::move(rules);
  return schema;
}

}  // namespace
}  // namespace scenario

namespace {

std::string schema_of(std::string_view pattern, std::string_view id, std::string_view title, std::string_view description) {
  scenario::Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"},
                           {"$id", id},
                           {"title", title},
                           {"description", std::string(description) + " Keys that begin with _ or // are comments."}};
  schema.update(scenario::of_object(pattern));
  return written(schema, 2) + '\n';
}

}  // namespace

std::string scenario_schema() {
  return schema_of(
      "", "earthtop-scenario-1.json", "earthtop scenario",
      "A top or gyroscope in a laboratory that turns with the Earth. Laboratory axes: East, North, Up; body axis 3 "
      "is the spin axis.");
}

std::string study_schema() {
  return schema_of(scenario::kStudy, "earthtop-study-1.json", "earthtop study",
                   "A base scenario, axes along which its keys are changed, a design that chooses the points, and the "
                   "quantities to collect.");
}

std::string mapping_schema() {
  return schema_of(scenario::kMapping, "earthtop-mapping-1.json", "earthtop mapping",
                   "What the columns of another program's CSV file mean.");
}

std::string tolerances_schema() {
  return schema_of(scenario::kTolerances, "earthtop-tolerances-1.json", "earthtop tolerances",
                   "What a comparison lets pass, a quantity at a time.");
}

}  // namespace earthtop
