// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/estimated_inputs.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

#include "earthtop/frames/earth.hpp"
#include "earthtop/model/body.hpp"
#include "earthtop/scenario/inputs.hpp"
#include "earthtop/scenario/reference.hpp"
#include "input/pointers.hpp"
#include "input/suggest.hpp"
#include "measure/spoken_input.hpp"
#include "scenario/fields.hpp"
#include "scenario/replaced_units.hpp"
#include "scene/examine.hpp"
#include "scene/moved_input.hpp"

namespace earthtop::measure {
namespace {

constexpr double kDegreesPerRad = 180 / std::numbers::pi;

struct CombinedName {
  std::string_view name;
  CombinedInput combined;
  std::string_view unit;
};
constexpr CombinedName kCombinedNames[] = {{"omega_sin_latitude_rad_s", CombinedInput::vertical_rate, "rad/s"},
                                           {"omega_cos_latitude_rad_s", CombinedInput::northward_rate, "rad/s"},
                                           {"inertia_ratio", CombinedInput::inertia_ratio, ""},
                                           {"center_of_mass_m", CombinedInput::center_of_mass, "m"}};
constexpr std::string_view kRooms[] = {"/site/",    "/earth/",    "/body/",    "/rotor/",         "/gimbals/",    "/release/",
                                       "/contact/", "/platform/", "/effects/", "/moving_masses/", "/instrument/", "/travel/"};
constexpr std::string_view kAllowedNames =
    "allowed are omega_sin_latitude_rad_s, omega_cos_latitude_rad_s, rotation_rate_rad_s, latitude_deg, gravity_m_s2, "
    "spin_rad_s, tilt_deg, inertia_ratio, center_of_mass_m, and keys of numbers of site, earth, body, rotor, gimbals, "
    "moving_masses, release, contact, platform, travel, effects or instrument, as /release/azimuth_deg";

[[noreturn]] void refuse_estimate(const std::string& name, std::string_view what) {
  throw ScenarioError("--estimate " + input::excerpt(name, 80), std::string(what));
}

/// The pointer of the key that a name means; the name itself where it means none.
std::string pointer_of(const std::string& name) {
  try {
    return scenario_pointer(name);
  } catch (const ScenarioError&) {
    return name;
  }
}

/// The entry for a pointer in the table of the scenario's keys; null if the pointer does not lead to a number.
const input::Field* field_of(std::string_view pointer) {
  const input::PointerTarget target = input::pointer_target(scenario::fields(), pointer);
  return target.is_number ? target.field : nullptr;
}

double scale_of(double start, std::string_view unit, std::string_view pointer) {
  for (const InstrumentRow& row : kInstrument)
    if (row.pointer == pointer) return row.scale;
  if (unit == "deg") return kDegreesPerRad;
  if (unit == "arcsec") return 3600 * kDegreesPerRad;
  if (pointer.ends_with("/rotation_rate_rad_s")) return std::max(std::abs(start), kEarthRateWgs84);
  return start != 0 ? std::abs(start) : 1;
}

}  // namespace

bool is_estimable(std::string_view pointer) {
  const auto is_error = [&](const InstrumentRow& row) { return row.standard_error == pointer; };
  return field_of(pointer) && std::ranges::none_of(kInstrument, is_error) &&
         std::any_of(std::begin(kRooms), std::end(kRooms), [&](auto room) { return pointer.starts_with(room); });
}

std::optional<double> number_in(const input::Node& root, std::string_view pointer) {
  const input::Node* node = input::node_at(root, pointer);
  return node && node->kind == input::JsonKind::number ? std::optional(node->number) : std::nullopt;
}

EstimatedInputs::EstimatedInputs(ScenarioSource source, const std::vector<std::pair<std::string, std::string>>& overrides,
                                 const Scene& base, const std::vector<std::string>& names, std::size_t most)
    : document_(std::move(source), overrides), base_(base) {
  if (names.size() > most) refuse_estimate(names[most], fmt::format("at most {} numbers can be estimated at once", most));
  for (const std::string& name : names) add(name);
  refuse_conflicts();
}

/// Refuses inputs together with others that stand for the same numbers.
void EstimatedInputs::refuse_conflicts() const {
  const auto has = [&](std::string_view pointer) {
    return std::any_of(list_.begin(), list_.end(), [&](const EstimatedInput& input) { return input.pointer == pointer; });
  };
  for (const TwoUnits& number : kInTwoUnits)
    if (has(number.si) && has(number.other))
      refuse_estimate(std::string(number.other),
                      fmt::format("is {} in another unit; estimate either it or {}", spoken_input(number.si),
                                  number.si.substr(number.si.rfind('/') + 1)));
  if (!has("/earth/rotation_rate_rad_s") && !has("/site/latitude_deg")) return;
  for (const EstimatedInput& input : list_)
    if (input.combined == CombinedInput::vertical_rate || input.combined == CombinedInput::northward_rate)
      refuse_estimate(input.name, "stands for the rotation rate and the latitude; estimate either it or these");
}

void EstimatedInputs::add(const std::string& name) {
  if (std::ranges::any_of(kInputs, [&](const InputRow& r) { return r.kind == InputKind::pivot_offset && r.name() == name; }))
    refuse_estimate(name, "is no single number; estimate its parts, e.g. /platform/pivot_offset_m/0");
  // The inputs of the `uncertainty` block may be called by their names.
  const auto named = std::ranges::find_if(kInputs, [&](const InputRow& row) { return row.name() == name && !row.of.empty(); });
  const std::string pointer = named != kInputs.end() ? std::string(named->of) : pointer_of(name);
  for (const EstimatedInput& input : list_)
    if (input.name == name || input.pointer == pointer) refuse_estimate(name, "is asked for twice");
  for (const CombinedName& combined : kCombinedNames)
    if (combined.name == name) return add_combined(combined.combined, name);
  if (!pointer.starts_with('/')) {
    std::vector<std::string_view> names;
    for (const CombinedName& combined : kCombinedNames) names.push_back(combined.name);
    for (const InputRow& row : kInputs)
      if (!row.of.empty()) names.push_back(row.name());
    const auto meant = input::suggest(name, names);
    refuse_estimate(name, fmt::format("unknown; {}{}", kAllowedNames, meant ? fmt::format("; did you mean {}?", *meant) : ""));
  }
  const input::Field* field = is_estimable(pointer) ? field_of(pointer) : nullptr;
  if (!field)
    refuse_estimate(name, fmt::format("is not a number on which the motion or its readings depend; {}", kAllowedNames));
  const double start = number_at(pointer, name);
  // A missing number may be one that this scenario must not have: the other of a pair, or a key of a part that it lacks.
  const std::vector<input::TreeChange> same = {{pointer, start}};
  if (!varied_scene(document_, same)) throw ScenarioError(examine(document_, same).errors, document_.file());
  list_.push_back({named != kInputs.end() ? name : pointer, pointer, std::string(field->unit), start,
                   scale_of(start, field->unit, pointer)});
}

void EstimatedInputs::add_combined(CombinedInput combined, const std::string& name) {
  const auto* row = std::find_if(std::begin(kCombinedNames), std::end(kCombinedNames),
                                 [&](const CombinedName& candidate) { return candidate.combined == combined; });
  EstimatedInput input{name, "", std::string(row->unit), 0, 1, combined};
  if (combined == CombinedInput::vertical_rate || combined == CombinedInput::northward_rate) {
    if (!base_.site().follows_ellipsoid())
      refuse_estimate(
          name,
          "with polar motion or a deflection of the vertical, the latitude is not the one of the Earth's rate; estimate "
          "rotation_rate_rad_s or latitude_deg");
    const Vec3<double> axis_L = celestial_axis_L<double>(base_.site());
    northward_rate_rad_s_ = base_.rotation_rate_rad_s() * axis_L[1];
    vertical_rate_rad_s_ = base_.rotation_rate_rad_s() * axis_L[2];
    input.start = combined == CombinedInput::vertical_rate ? vertical_rate_rad_s_ : northward_rate_rad_s_;
    input.scale = std::max(std::abs(base_.rotation_rate_rad_s()), kEarthRateWgs84);
  } else {
    const Body<double>& body = base_.body<double>();
    const bool is_ratio = combined == CombinedInput::inertia_ratio;
    input.start = is_ratio ? body.I_BP_B(2, 2) / body.I_BP_B(0, 0) : norm(body.p_PBcm_B);
    input.scale = input.start != 0 ? input.start : std::sqrt(body.I_BP_B(2, 2) / body.mass);
  }
  list_.push_back(std::move(input));
}

/// The number at a pointer: the one in the scenario's text, else the default in the table of keys, else the computed one.
/// @throws ScenarioError where there is none of these
double EstimatedInputs::number_at(const std::string& pointer, const std::string& name) const {
  if (const auto number = number_in(document_.root(), pointer)) return *number;
  const input::Field* field = field_of(pointer);
  if (field->kind == input::FieldKind::number || field->kind == input::FieldKind::number_or_vector3) {
    double fallback = 0;
    const std::string_view text = field->fallback;
    if (std::from_chars(text.data(), text.data() + text.size(), fallback).ec == std::errc()) return fallback;
    if (const auto number = number_in(scenario::Document({"", canonical_json(base_.scenario())}).root(), pointer))
      return *number;
  }
  refuse_estimate(name, "is not in the scenario; add it there, with the value from which to start");
}

std::optional<double> EstimatedInputs::value_of(CombinedInput combined, const std::vector<double>& values) const {
  for (std::size_t i = 0; i < list_.size(); ++i)
    if (list_[i].combined == combined) return values[i];
  return std::nullopt;
}

/// Sets the Earth's rate and the latitude so that the rate has these vertical and northward components.
void EstimatedInputs::turn(Scenario& scenario, const std::vector<double>& values) const {
  const auto vertical = value_of(CombinedInput::vertical_rate, values);
  const auto northward = value_of(CombinedInput::northward_rate, values);
  if (!vertical && !northward) return;
  const double up = vertical.value_or(vertical_rate_rad_s_), north = northward.value_or(northward_rate_rad_s_);
  const double sign = north < 0 ? -1 : 1;  // a negative rate, so that the latitude stays between the poles
  scenario.rotation_rate_rad_s = sign * real::hypot(up, north);
  scenario.excess_length_of_day_ms = 0;
  scenario.site.latitude_deg = real::atan2(sign * up, sign * north) * kDegreesPerRad;
  scenario.gravity_anomaly_m_s2 = 0;  // gravity stays as it is, and does not follow the latitude
}

/// Sets the body's inertia ratio and the distance of its centre of mass. @returns whether such a body is possible
bool EstimatedInputs::reshape(Scenario& scenario, const Scene& scene, const std::vector<double>& values) const {
  const auto ratio = value_of(CombinedInput::inertia_ratio, values);
  const auto distance_m = value_of(CombinedInput::center_of_mass, values);
  if (!ratio && !distance_m) return true;
  Body<double> body = scene.body<double>();
  if (ratio) body.I_BP_B(2, 2) = *ratio * body.I_BP_B(0, 0);
  if (distance_m) {
    const double before_m = norm(body.p_PBcm_B);
    if (before_m > 0)
      body.p_PBcm_B *= *distance_m / before_m;
    else
      body.p_PBcm_B[2] = *distance_m;
  }
  set_body(scenario, scene, body);
  return body_violations(scenario.body, scenario.rotor || scenario.gimbals).empty();
}

std::optional<Scene> EstimatedInputs::scene(const std::vector<double>& values) const {
  std::vector<input::TreeChange> changes;
  bool is_combined = false;
  for (std::size_t i = 0; i < list_.size(); ++i) {
    if (!std::isfinite(values[i])) return std::nullopt;
    if (list_[i].combined != CombinedInput::none)
      is_combined = true;
    else
      changes.push_back({list_[i].pointer, values[i]});
  }
  std::optional<Scene> varied = varied_scene(document_, changes);
  if (!varied || !is_combined) return varied;
  Scenario changed = varied->scenario();
  turn(changed, values);
  if (!reshape(changed, *varied, values)) return std::nullopt;
  return resolve(std::move(changed));
}

}  // namespace earthtop::measure
