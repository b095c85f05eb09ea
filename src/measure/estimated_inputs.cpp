// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/estimated_inputs.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

#include "earthtop/frames/earth.hpp"
#include "input/pointers.hpp"
#include "input/suggest.hpp"
#include "scenario/fields.hpp"
#include "scene/examine.hpp"

namespace earthtop::measure {
namespace {

constexpr std::size_t kMostEstimates = 8;
constexpr std::string_view kVerticalRate = "omega_sin_latitude_rad_s";
constexpr double kDegreesPerRad = 180 / std::numbers::pi;

struct NamedInput {
  std::string_view name, pointer;
};
constexpr NamedInput kNamedInputs[] = {{"rotation_rate_rad_s", "/earth/rotation_rate_rad_s"},
                                       {"latitude_deg", "/site/latitude_deg"},
                                       {"gravity_m_s2", "/site/gravity_m_s2"},
                                       {"spin_rad_s", "/release/spin_rad_s"},
                                       {"tilt_deg", "/release/tilt_deg"}};
constexpr std::string_view kRooms[] = {"/site/", "/earth/", "/body/", "/release/", "/contact/", "/platform/", "/effects/"};
constexpr std::string_view kAllowedNames =
    "allowed are omega_sin_latitude_rad_s, rotation_rate_rad_s, latitude_deg, gravity_m_s2, spin_rad_s, tilt_deg, and JSON "
    "pointers of numbers of site, earth, body, release, platform or effects, as /release/azimuth_deg";

[[noreturn]] void refuse_estimate(const std::string& name, std::string_view what) {
  throw ScenarioError("--estimate " + input::excerpt(name, 80), std::string(what));
}

/// The entry for a pointer in the table of the scenario's keys; null if the pointer does not lead to a number.
const input::Field* field_of(std::string_view pointer) {
  const input::PointerTarget target = input::pointer_target(scenario::fields(), pointer);
  return target.is_number ? target.field : nullptr;
}

/// The number at a pointer of a tree; none where there is no number.
std::optional<double> number_in(const input::Node& root, std::string_view pointer) {
  const input::Node* node = input::node_at(root, pointer);
  return node && node->kind == input::JsonKind::number ? std::optional(node->number) : std::nullopt;
}

double scale_of(double start, std::string_view unit, std::string_view pointer) {
  if (unit == "deg") return kDegreesPerRad;
  if (unit == "arcsec") return 3600 * kDegreesPerRad;
  if (pointer.ends_with("/rotation_rate_rad_s")) return std::max(std::abs(start), kEarthRateWgs84);
  return start != 0 ? std::abs(start) : 1;
}

}  // namespace

EstimatedInputs::EstimatedInputs(ScenarioSource source, const std::vector<std::pair<std::string, std::string>>& overrides,
                                 const Scene& base, const std::vector<std::string>& names)
    : document_(std::move(source), overrides), base_(base) {
  if (names.size() > kMostEstimates)
    refuse_estimate(names[kMostEstimates], fmt::format("at most {} numbers are estimated at once", kMostEstimates));
  for (const std::string& name : names) add(name);
  const auto has = [&](std::string_view pointer) {
    return std::any_of(list_.begin(), list_.end(), [&](const EstimatedInput& input) { return input.pointer == pointer; });
  };
  if (has("") && (has("/earth/rotation_rate_rad_s") || has("/site/latitude_deg")))
    refuse_estimate(std::string(kVerticalRate), "stands for the rotation rate and the latitude; estimate it, or these");
  if (has("/release/spin_rpm") && has("/release/spin_rad_s"))
    refuse_estimate("/release/spin_rpm", "is the spin in another unit; estimate it, or spin_rad_s");
}

void EstimatedInputs::add(const std::string& name) {
  const auto* named = std::find_if(std::begin(kNamedInputs), std::end(kNamedInputs),
                                   [&](const NamedInput& input) { return input.name == name; });
  const std::string pointer(named != std::end(kNamedInputs) ? named->pointer : name);
  for (const EstimatedInput& input : list_)
    if (input.name == name || input.pointer == pointer) refuse_estimate(name, "is asked for twice");
  if (name == kVerticalRate) return add_vertical_rate();
  if (!pointer.starts_with('/')) {
    std::vector<std::string_view> names = {kVerticalRate};
    for (const NamedInput& input : kNamedInputs) names.push_back(input.name);
    const auto meant = input::suggest(name, names);
    refuse_estimate(name, fmt::format("unknown; {}{}", kAllowedNames, meant ? fmt::format("; did you mean {}?", *meant) : ""));
  }
  const bool in_room = std::any_of(std::begin(kRooms), std::end(kRooms), [&](auto room) { return pointer.starts_with(room); });
  const input::Field* field = in_room ? field_of(pointer) : nullptr;
  if (!field) refuse_estimate(name, fmt::format("is no number that the motion depends on; {}", kAllowedNames));
  const double start = number_at(pointer, name);
  // A missing number may be one that this scenario must not have: the other of a pair, or a key of a part that it lacks.
  ScenarioReport report = examine(document_, {{pointer, start}});
  if (!report.scene) throw ScenarioError(std::move(report.errors), document_.file());
  list_.push_back({name, pointer, std::string(field->unit), start, scale_of(start, field->unit, pointer)});
}

void EstimatedInputs::add_vertical_rate() {
  if (!base_.site().follows_ellipsoid())
    refuse_estimate(std::string(kVerticalRate),
                    "with polar motion or a deflection of the vertical the latitude is not that of the Earth's rate; estimate "
                    "rotation_rate_rad_s or latitude_deg");
  const Vec3<double> axis_L = celestial_axis_L<double>(base_.site());
  northward_rate_rad_s_ = base_.rotation_rate_rad_s() * axis_L[1];
  const double scale = std::max(std::abs(base_.rotation_rate_rad_s()), kEarthRateWgs84);
  list_.push_back({std::string(kVerticalRate), "", "rad/s", base_.rotation_rate_rad_s() * axis_L[2], scale});
}

/// The number at a pointer: the one in the scenario's text, else the default in the table of keys, else the computed one.
/// @throws ScenarioError where there is none of these
double EstimatedInputs::number_at(const std::string& pointer, const std::string& name) const {
  if (const auto number = number_in(document_.root(), pointer)) return *number;
  const input::Field* field = field_of(pointer);
  if (field->kind == input::FieldKind::number) {
    double fallback = 0;
    const std::string_view text = field->fallback;
    if (std::from_chars(text.data(), text.data() + text.size(), fallback).ec == std::errc()) return fallback;
    if (const auto number = number_in(scenario::Document({"", canonical_json(base_.scenario())}).root(), pointer))
      return *number;
  }
  refuse_estimate(name, "is not in the scenario; write it there, with the value to start from");
}

std::optional<Scene> EstimatedInputs::scene(const std::vector<double>& values) const {
  std::vector<input::TreeChange> changes;
  std::optional<double> vertical_rate_rad_s;
  for (std::size_t i = 0; i < list_.size(); ++i) {
    if (!std::isfinite(values[i])) return std::nullopt;
    if (list_[i].pointer.empty())
      vertical_rate_rad_s = values[i];
    else
      changes.push_back({list_[i].pointer, values[i]});
  }
  const ScenarioReport varied = examine(document_, changes);
  if (!varied.scene || !vertical_rate_rad_s) return varied.scene;
  Scenario turned = varied.scene->scenario();
  turned.rotation_rate_rad_s = real::hypot(*vertical_rate_rad_s, northward_rate_rad_s_);
  turned.excess_length_of_day_ms = 0;
  turned.site.latitude_deg = real::atan2(*vertical_rate_rad_s, northward_rate_rad_s_) * kDegreesPerRad;
  return resolve(std::move(turned));
}

}  // namespace earthtop::measure
