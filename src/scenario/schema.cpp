// SPDX-License-Identifier: GPL-3.0-or-later
#include "input/schema.hpp"

#include <nlohmann/json.hpp>

#include "earthtop/scenario/reference.hpp"
#include "scenario/fields.hpp"
#include "scenario/rules.hpp"

namespace earthtop {
namespace scenario {
namespace {

using Json = nlohmann::ordered_json;
using input::split_words;

Json required(std::string_view keys) { return {{"required", split_words(keys)}}; }
Json none_of(std::string_view keys) {
  Json any = Json::array();
  for (const std::string_view key : split_words(keys)) any.push_back(required(key));
  return {{"not", {{"anyOf", any}}}};
}
/// Returns the rule that exactly one of the keys is given.
Json exactly_one(std::string_view keys) {
  Json one = Json::array();
  for (const std::string_view key : split_words(keys)) one.push_back(required(key));
  return {{"oneOf", one}};
}
/// Returns the rule that a key is given with a value that satisfies the schema.
Json has(std::string_view key, Json schema) {
  Json rule = required(key);
  rule["properties"][std::string(key)] = std::move(schema);
  return rule;
}
/// Returns the rule that `then` holds if `key` is `word`, and `otherwise` if not.
Json when(std::string_view key, std::string_view word, Json then, Json otherwise = true) {
  return {{"if", has(key, {{"const", word}})}, {"then", std::move(then)}, {"else", std::move(otherwise)}};
}

Json solid_rules() {
  Json rules = Json::array({exactly_one("mass_kg|density_kg_m3")});
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

/// Returns the rules of keys that belong to words.   @param key  that has the word   @param keys  all that belong to one of them
/// @param left_out  the word that holds where `key` is left out; none where it must not be
template <class Rows>
Json rules_of_words(const char* key, const Rows& rows, std::string_view keys, std::string_view left_out = {}) {
  Json rules = Json::array();
  for (const auto& rule : rows) {
    Json properties = Json::object();
    for (const std::string_view one : split_words(keys))
      if (!input::lists(rule.allowed, one)) properties[one] = false;
    rules.push_back(when(key, rule.word, {{"properties", properties}, {"required", split_words(rule.required)}}));
    if (rule.word == left_out) rules.back()["if"].erase("required");  // and holds where the key is not there
  }
  return rules;
}
/// Returns the rules of a journey, beside those of its path's keys.
Json travel_rules() {
  Json rules = rules_of_words("path", kTravelPaths, kTravelKeys);
  rules.push_back(when("path", "table", true, exactly_one("speed_m_s|speed_kn")));
  rules.push_back({{"if", required("radius_m")}, {"then", has("figure", {{"const", "sphere"}})}});
  rules.push_back(when("reference", "at_rest", {{"not", has("eotvos", {{"const", "both"}})}}));
  return rules;
}

/// Returns the rules of a platform; one that turns with a course has an upright axis.
Json platform_rules() {
  Json rules = rules_of_words("motion", kMotionRules, kMotionKeys);
  const Json upright = Json::array({{{"const", 0}}, {{"const", 0}}, {{"exclusiveMinimum", 0}}});
  rules.push_back(when("motion", "course", {{"properties", {{"axis", {{"items", upright}}}}}}));
  return rules;
}

Json rotor_rules() {
  Json rules = rules_of_words("drive", kDriveRules, kDriveKeys, kDriveRules.front().word);
  rules.push_back(when("drive", "table", Json::object(), exactly_one("spin_rad_s|spin_rpm")));
  rules.push_back({{"if", has("coulomb_torque_N_m", {{"exclusiveMinimum", 0}})}, {"then", required("regularisation_rad_s")}});
  rules.push_back({{"if", required("regularisation_rad_s")}, {"then", required("coulomb_torque_N_m")}});
  return rules;
}

/// Returns the rules of a contact's coefficients, which belong to laws, and of its start.
Json contact_rules() {
  Json rules = Json::array();
  for (const ContactLawRule& rule : kContactLaws) {
    Json properties = Json::object();
    for (const std::string_view key : split_words(kContactLawKeys))
      if (!input::lists(rule.allowed, key)) properties[key] = false;
    if (rule.value == ContactLaw::rolling) {
      properties["start"] = {{"enum", Json::array({"rolling"})}};
      properties["tip_velocity_m_s"] = false;
    }
    rules.push_back(when("law", rule.word, {{"properties", properties}, {"required", split_words(rule.required)}}));
  }
  rules.push_back({{"not", required("start|tip_velocity_m_s")}});
  const Json rate = required("regularisation_rad_s");
  for (const char* key : {"spinning_friction_m", "rolling_resistance_m"})
    rules.push_back({{"if", has(key, {{"exclusiveMinimum", 0}})}, {"then", rate}});
  rules.push_back(
      {{"if", rate}, {"then", {{"anyOf", Json::array({required("spinning_friction_m"), required("rolling_resistance_m")})}}}});
  return rules;
}

/// Returns the rule that latitude is required if the Earth rotates, if gravity is computed from it, or if a journey begins there
/// and no table says where.
Json site_rule() {
  Json nothing_to_know = has("site", required("gravity_m_s2"));
  nothing_to_know.update(has("earth", has("rotation_rate_rad_s", {{"const", 0}})), true);
  nothing_to_know["required"] = {"site", "earth"};
  nothing_to_know["not"] = required("travel");
  const Json in_table = has("travel", has("path", {{"const", "table"}}));
  return {{"anyOf", Json::array({has("site", required("latitude_deg")), nothing_to_know, in_table})}};
}

/// Returns the rule that a vehicle turns with the course of a journey that has one.
Json vehicle_rule() {
  return {{"if", has("platform", has("motion", {{"const", "course"}}))},
          {"then", has("travel", {{"not", has("path", {{"const", "table"}})}})}};
}

/// Returns the rule that the release has one rate; with a rotor or moving masses in the body it may have none.
Json rate_rule() {
  constexpr std::string_view kOneRate = "spin_rad_s|spin_rpm|angular_velocity_body_rad_s";
  const Json still = {{"properties", {{"release", none_of(kOneRate)}}},
                      {"anyOf", Json::array({required("rotor"), required("moving_masses"), required("gimbals")})}};
  return {{"anyOf", Json::array({has("release", exactly_one(kOneRate)), still})}};
}

/// Returns the rule that a release in gimbals has their angles, and any other one an attitude.
Json gimbals_rule() {
  constexpr std::string_view kOfGimbals = "outer_angle_deg|inner_angle_deg|outer_rate_rad_s|inner_rate_rad_s";
  constexpr std::string_view kOfPivot =
      "tilt_deg|azimuth_deg|spin_angle_deg|quaternion_LB|angular_velocity_body_rad_s|spin_rad_s|spin_rpm|precession";
  Json in_gimbals = required("outer_angle_deg|inner_angle_deg"), on_pivot = exactly_one("tilt_deg|quaternion_LB");
  in_gimbals.update(none_of(kOfPivot)), on_pivot.update(none_of(kOfGimbals));
  return {{"if", required("gimbals")}, {"then", has("release", in_gimbals)}, {"else", has("release", on_pivot)}};
}

/// Returns the rules of a gimbal's axis: what acts on it needs it free, and its coefficients each other.
Json bearing_rules() {
  const Json positive = {{"exclusiveMinimum", 0}};
  const Json bare = none_of("viscous_torque_N_m_s|coulomb_torque_N_m|regularisation_rad_s|torsion_N_m_rad|torsion_rest_deg");
  return Json::array({{{"if", has("locked", {{"const", true}})}, {"then", bare}},
                      {{"if", has("coulomb_torque_N_m", positive)}, {"then", required("regularisation_rad_s")}},
                      {{"if", required("regularisation_rad_s")}, {"then", required("coulomb_torque_N_m")}},
                      {{"if", required("torsion_rest_deg")}, {"then", required("torsion_N_m_rad")}}});
}
Json outer_rules() {
  Json rules = bearing_rules();
  const Json whole = required("mass_kg|inertia");
  for (const char* key : {"mass_kg", "center_of_mass_m", "inertia"}) rules.push_back({{"if", required(key)}, {"then", whole}});
  return rules;
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

/// Returns the rule that a tide is that of Moon and Sun, or one of given amplitude.
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

/// Returns the rule that only a method that composes flows allows a composition.
Json composition_rule() {
  Json rule = {{"properties", {{"composition", {{"enum", Json::array({to_string(Composition::automatic)})}}}}}};
  for (const MethodRow& row : kMethodRows)
    if (row.composes) rule = when("method", row.word, Json::object(), rule);
  return rule;
}

/// Returns the methods and tolerances that the precision allows, as in `check_precision`; the default precision is double.
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

/// Returns an object's rules that involve several of its keys; an empty array if there are none.
Json rules_of(std::string_view pattern) {
  if (pattern.empty()) return Json::array({site_rule(), vehicle_rule(), rate_rule(), gimbals_rule()});
  if (pattern == "/headline") return Json::array({{{"if", has("quantity", {{"pattern", "\\."}})}, {"then", none_of("at_s")}}});
  if (pattern == "/criteria/*") return criterion_rules();
  if (pattern == "/body") return Json::array({body_rule()});
  if (pattern == "/body/inertia") return Json::array({exactly_one("principal_kg_m2|matrix_kg_m2")});
  if (pattern == "/body/solids/*") return solid_rules();
  if (pattern == "/release") return Json::array({release_rule()});
  if (pattern == "/site") return Json::array({{{"dependencies", {{"gravity_m_s2", none_of("gravity_anomaly_m_s2")}}}}});
  if (pattern == "/motion")
    return Json::array(
        {{{"properties", {{"start_utc", {{"pattern", "^\\d{4}-\\d{2}-\\d{2}T\\d{2}:\\d{2}:\\d{2}([.]\\d+)?Z$"}}}}}}});
  if (pattern == "/effects/tide") return Json::array({tide_rule()});
  if (pattern == "/effects/unequal_support") return Json::array({exactly_one("kappa_N_m|periods_s")});
  if (pattern == "/effects/given_torque")
    return rules_of_words("course", kTorqueCourses, kCourseKeys, kTorqueCourses.front().word);
  if (pattern == "/travel") return travel_rules();
  if (pattern == "/travel/legs/*") return Json::array({{{"not", required("speed_m_s|speed_kn")}}});
  if (pattern == "/platform") return platform_rules();
  if (pattern == "/rotor") return rotor_rules();
  if (pattern == "/moving_masses/*") return rules_of_words("motion", kMassMotionRules, kMassMotionKeys);
  if (pattern == "/gimbals/outer") return outer_rules();
  if (pattern == "/gimbals/inner") return bearing_rules();
  if (pattern == "/gimbals/outer/inertia") return Json::array({exactly_one("principal_kg_m2|matrix_kg_m2")});
  if (pattern == "/contact") return contact_rules();
  if (pattern == "/numerics") return Json::array({numerics_rule(), composition_rule(), precision_rule()});
  return Json::array();
}

}  // namespace
}  // namespace scenario

std::string scenario_schema() {
  return input::schema(scenario::fields(),
                       "A top or gyroscope in a laboratory that turns with the Earth. Laboratory axes: East, North, Up; body "
                       "axis 3 is the spin axis.",
                       scenario::rules_of);
}

}  // namespace earthtop
