// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/scenario/reference.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "earthtop/error.hpp"
#include "input/pointers.hpp"
#include "input/schema.hpp"
#include "scenario/document.hpp"
#include "scenario/fields.hpp"
#include "scenario/rules.hpp"
#include "text/json.hpp"

namespace earthtop {
namespace scenario {
namespace {

using Json = nlohmann::ordered_json;
using input::Field, input::FieldKind;

/// Returns whether a word allows a key. @param keys  those that some words allow and others do not
template <class Rows>
bool allowed_by(const Rows& rows, std::string_view keys, const std::string& word, std::string_view key) {
  return !input::lists(keys, key) || input::lists(row_of_word(rows, word).allowed, key);
}

/// Returns whether a key of the outer gimbal or of an axis is allowed: what acts on an axis acts on none that is locked, a rest belongs to
/// a spring, and a centre of mass to a mass.
bool belongs_to_gimbal(std::string_view key, const Json& given) {
  constexpr std::string_view kOnFreeAxes = "viscous_torque_N_m_s|coulomb_torque_N_m|torsion_N_m_rad|torsion_rest_deg";
  if (input::lists(kOnFreeAxes, key) && given.value("locked", false)) return false;
  if (key == "torsion_rest_deg") return given.value("torsion_N_m_rad", 0.0) != 0;
  return key != "center_of_mass_m" || given.contains("mass_kg");
}

/// Returns whether a key is allowed together with the keys of `given`, so that its default may be written.
bool belongs(std::string_view pattern, std::string_view key, const Json& given) {
  constexpr std::string_view kOfGimbals = "outer_rate_rad_s|inner_rate_rad_s",
                             kOfPivot = "azimuth_deg|spin_angle_deg|precession";
  if (pattern == "/gimbals/outer" || pattern == "/gimbals/inner") return belongs_to_gimbal(key, given);
  if (input::lists(given.contains("outer_angle_deg") ? kOfPivot : kOfGimbals, key)) return false;
  if (key == "precession") return !given.contains("angular_velocity_body_rad_s");
  if (key == "azimuth_deg" || key == "spin_angle_deg") return !given.contains("quaternion_LB");
  if (key == "relative_tolerance")
    return !given.contains("step_s") && given.value("method", "") != "closed_form" &&
           given.value("precision", "double") == "double";
  if (pattern == "/travel")
    return key == "radius_m" ? given.value("figure", "wgs84") == "sphere"
                             : allowed_by(kTravelPaths, kTravelKeys, given.value("path", "rhumb"), key);
  if (given.contains("law")) return allowed_by(kContactLaws, kContactLawKeys, given.at("law"), key);
  if (given.contains("axes")) return allowed_by(kTorqueCourses, kCourseKeys, given.value("course", "constant"), key);
  if (given.contains("axial_kg_m2")) return allowed_by(kDriveRules, kDriveKeys, given.value("drive", "none"), key);
  if (given.contains("motion") && given.at("motion").is_string())
    return allowed_by(kMotionRules, kMotionKeys, given.at("motion"), key);
  return true;
}

bool is_about_original(std::string_view pointer) {
  return pointer == "/headline" || pointer == "/purpose" || pointer == "/criteria";
}

/// Returns the values of `given` and the defaults of its missing keys, in the table's order, each after a comment.
Json annotated(const Json& given, std::string_view pattern) {
  Json filled = Json::object();
  for (const std::string_view key : fields().keys_below(pattern)) {
    const Field& field = *fields().find(fmt::format("{}/{}", pattern, key));
    const bool stands = given.contains(key);
    if (is_about_original(field.pointer) || (!stands && field.fallback.empty())) continue;
    if (!stands && !belongs(pattern, key, given)) continue;
    const Json value = stands ? given.at(key) : json_of(field.fallback);
    if (!stands && value == Json::object() && fields().keys_below(field.pointer).empty()) continue;
    std::string comment(field.doc);
    if (key != "$schema" && field.kind != FieldKind::object) comment += "; " + allowed_values(field);
    if (key != "$schema") filled[fmt::format("_{}", key)] = comment;
    if (value.is_object()) {
      Json below = annotated(value, field.pointer);
      if (below.empty())
        filled.erase(fmt::format("_{}", key));
      else
        filled[key] = std::move(below);
    } else {
      filled[key] = value;
    }
  }
  return filled;
}

/// Writes JSON as dump(2) does, but keeps a list of numbers on one line.
void lay_out(std::string& text, const Json& json, std::size_t depth) {
  const bool is_flat = std::none_of(json.begin(), json.end(), [](const Json& j) { return j.is_structured(); });
  if (!json.is_structured() || json.empty()) {
    text += written(json);
    return;
  }
  const bool on_lines = json.is_object() || !is_flat;
  text += json.is_object() ? '{' : '[';
  const char* separator = "";
  for (const auto& [key, value] : json.items()) {
    text += separator;
    separator = on_lines ? "," : ", ";
    if (on_lines) text.append(1, '\n').append(2 * depth + 2, ' ');
    if (json.is_object()) text.append(written(key)).append(": ");
    lay_out(text, value, depth + 1);
  }
  if (on_lines) text.append(1, '\n').append(2 * depth, ' ');
  text += json.is_object() ? '}' : ']';
}

bool is_one_value(FieldKind kind) { return kind != FieldKind::object && kind != FieldKind::list; }

/// Pointers of the keys that a bare name can mean.
std::vector<std::string> pointers_called(std::string_view name) {
  // Their keys are meant only where no other section has the name: standard errors, which nobody means, and the parts that came after
  // 1.0, before which the name had one meaning.
  constexpr std::string_view kSecond[] = {"/uncertainty/", "/rotor/", "/gimbals/", "/moving_masses/", "/travel/"};
  std::vector<std::string> found, first;
  for (const input::Field& field : fields().fields) {
    if (field.key() != name || field.pointer.find('*') != field.pointer.npos) continue;
    found.emplace_back(field.pointer);
    if (std::ranges::none_of(kSecond, [&](std::string_view section) { return field.pointer.starts_with(section); }))
      first.emplace_back(field.pointer);
  }
  std::vector<std::string>& meant = first.empty() ? found : first;
  const auto depth = [](const std::string& pointer) { return std::ranges::count(pointer, '/'); };
  std::ptrdiff_t least = std::numeric_limits<std::ptrdiff_t>::max();
  for (const std::string& pointer : meant) least = std::min(least, depth(pointer));
  std::erase_if(meant,
                [&](const std::string& pointer) { return depth(pointer) > least; });  // the body's mass, not that of its part
  return meant;
}

}  // namespace
}  // namespace scenario

std::string scenario_reference_markdown() { return input::reference_markdown(scenario::fields()); }

std::string annotated_scenario(const ScenarioSource& source) {
  const scenario::Document document(source);
  if (const scenario::Decoded decoded = document.decode(); !decoded.findings.empty())
    throw ScenarioError(decoded.errors(), source.file);
  std::string text;
  scenario::lay_out(text, scenario::annotated(json_of(source.text), ""), 0);
  return text + '\n';
}

std::string advice_on_key(const std::string& name) { return input::unknown_key(scenario::fields(), name, "").advice; }

std::vector<std::string> scenario_pointers() {
  std::vector<std::string> pointers;
  for (const input::Field& field : scenario::fields().fields) {
    if (!scenario::is_one_value(field.kind)) continue;
    std::string pointer(field.pointer);
    if (const auto star = pointer.find('*'); star != std::string::npos) pointer[star] = '0';
    pointers.push_back(std::move(pointer));
  }
  return pointers;
}

std::string scenario_pointer(std::string_view key) {
  if (key.starts_with('/')) return std::string(key);
  if (key.find_first_of("/.") != key.npos) {
    std::string pointer = "/" + std::string(key);
    if (key.find('/') == key.npos) std::replace(pointer.begin(), pointer.end(), '.', '/');
    return pointer;
  }
  const std::vector<std::string> found = scenario::pointers_called(key);
  if (found.size() == 1) return found.front();
  if (!found.empty())
    throw ScenarioError("", fmt::format("several sections have \"{}\"; say which: {}", key, fmt::join(found, ", ")));
  const std::string advice = advice_on_key(std::string(key));
  throw ScenarioError(
      "", fmt::format("no key of a scenario is called \"{}\"{}{}", printable(key), advice.empty() ? "" : "; ", advice));
}

}  // namespace earthtop
