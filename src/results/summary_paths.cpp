// SPDX-License-Identifier: GPL-3.0-or-later
// Checks the paths of members of summary.json. A summary can have the members in the table of figures, and its copy of the
// scenario can have any key of a scenario. These keys are found by writing scenarios, made up here, that have everything.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "earthtop/error.hpp"
#include "earthtop/scenario/reference.hpp"
#include "input/pointers.hpp"
#include "input/suggest.hpp"
#include "results/figures.hpp"
#include "results/meanings.hpp"

namespace earthtop {
namespace {

using Json = nlohmann::ordered_json;

/// The number of made-up scenarios. A scenario has one of several alternatives in some places; among so many, each occurs.
constexpr int kKinds = 5;

BodySpec any_body(int kind) {
  BodySpec body;
  if (kind > 0) body.solids = {{SolidShape::ring, 1, 1, 1, 1.0, 1.0, 0}};
  return body;
}

ReleaseSpec any_release(int kind) {
  ReleaseSpec release;
  release.precession = kind == 0 ? Precession::given : Precession::none;
  if (kind > 1) release.quaternion_LB = {1, 0, 0, 0};
  if (kind > 2) release.angular_velocity_body_rad_s = {0, 0, 1};
  return release;
}

/// With each of the laws that have keys of their own, and both ways to start.
ContactSpec any_contact(int kind) {
  constexpr ContactLaw kLaws[kKinds] = {ContactLaw::viscous, ContactLaw::viscous_load, ContactLaw::coulomb,
                                        ContactLaw::contensou, ContactLaw::rolling};
  ContactSpec contact;
  contact.law = kLaws[kind];
  contact.sliding_viscosity_N_s_m = contact.sliding_viscosity_s_m = contact.friction_coefficient = contact.patch_radius_m = 1;
  contact.spinning_friction_m = contact.rolling_resistance_m = contact.regularisation_rad_s = 1;
  contact.static_coefficient = contact.max_tilt_deg = 1;
  if (kind == 0) contact.start = ContactStart::tip_velocity;
  return contact;
}

MovingMassSpec any_mass(int kind) {
  MovingMassSpec mass;
  mass.motion = kind == 0   ? MassMotion::circle
                : kind == 1 ? MassMotion::harmonic
                : kind == 2 ? MassMotion::waypoints
                            : MassMotion::table;
  mass.times_s = {0, 1};
  mass.points_m = {{0, 0, 0}, {0, 0, 1}};
  return mass;
}
/// A scenario with every optional key; where only one of several alternatives is possible, `kind` decides which one.
Scenario any_scenario(int kind) {
  Scenario scenario;
  scenario.body = any_body(kind);
  scenario.release = any_release(kind);
  scenario.duration_s = scenario.output_step_s = 1;
  scenario.title = scenario.purpose = "a text";
  scenario.headline = HeadlineSpec{"drift_axis_rad", 0.0, 0, 1, ""};
  scenario.criteria = {{CriterionKind::value, "drift_axis_rad", {"/motion/duration_s=1"}, {0}, 0.0, 0.0, 0.0, "", true}};
  scenario.excess_length_of_day_ms = 1;
  if (kind == 0) scenario.gravity_anomaly_m_s2 = 1;
  scenario.site.pole = {1, 1};
  scenario.site.deflection = {1, 1};
  scenario.start_utc = "2026-01-01T00:00:00Z";
  scenario.rotor = RotorSpec{1, 1, 1, {0, 0, 1}, {0, 0, 0}, 1, RotorDrive::none, 1, 1, 1, 1, 1, 1, 1};
  scenario.gimbals.emplace().ring = any_body(kind);
  scenario.moving_masses = {any_mass(kind)};
  scenario.platform = PlatformSpec{};
  scenario.platform->motion = static_cast<PlatformMotion>(kind % 4);
  scenario.travel = TravelSpec{};
  const bool first = kind == 0;
  scenario.effects.tide.emplace().given = first;
  scenario.effects.automatic = true;
  scenario.effects.applied = {
      1, 1, 1, AirDragSpec{}, GravityGradientSpec{first ? GradientField::given : GradientField::radial}, GimbalSpec{}};
  AppliedTorquesSpec& applied = scenario.effects.applied;
  applied.unequal_support.emplace();
  if (first) applied.unequal_support->periods_s = {1, 2};
  applied.given_torque.emplace().course = static_cast<TorqueCourse>(kind % 3);
  applied.air_force.emplace();
  if (first) scenario.numerics.step_s = 1;
  scenario.numerics.composition = Composition::rkn6;
  scenario.precision = Precision::bits113;
  scenario.contact = any_contact(kind);
  scenario.ledger = LedgerObserver::laboratory;
  scenario.threshold_rad = scenario.accuracy_rad = 1;
  scenario.sensitivities = true;
  if (kind < 2) scenario.uncertainty.emplace().fill(1);
  return scenario;
}

/// Whether an array is a list, whose number of elements depends on the run. Arrays of numbers are vectors or matrices instead,
/// of the same size in every run.
bool is_list(const Json& array) { return !array.empty() && !array.front().is_number() && !array.front().is_array(); }

/// Adds the members of `more` to `all`. A list keeps one element, which gets the members of all elements.
void join(Json& all, Json more) {
  if (more.is_object()) {
    if (!all.is_object()) all = Json::object();
    for (auto& [key, value] : more.items()) join(all[key], std::move(value));
  } else if (more.is_array()) {
    if (!all.is_array()) all = Json::array();
    const bool list = is_list(more);
    for (std::size_t i = 0; i < more.size(); ++i) join(all[list ? 0 : i], std::move(more[i]));
  } else if (!all.is_structured()) {
    all = std::move(more);
  }
}

/// An example of a member's value, in the member's form.
Json example_of(const SummaryMember& member) {
  Json example;
  RunResult result;
  switch (member.form) {
    case MemberForm::value: return "";
    case MemberForm::vector: return {0, 0, 0};
    case MemberForm::words: return Json::array({""});
    case MemberForm::object: return Json::object();
    case MemberForm::list: return Json::array({Json::object()});
    case MemberForm::document:
      result.drift.secular.emplace().azimuth_oscillation_rad = 0;  // a member is asked for only where its object is there
      for (int kind = 0; kind < kKinds; ++kind) {
        result.scene = resolve(any_scenario(kind));
        join(example, member.value(result, 0));
      }
      return example;
  }
  return example;
}

const Json& every_member() {
  static const Json all = [] {
    Json document = Json::object();
    for (const SummaryMember& member : summary_members()) {
      std::string pointer = "/" + std::string(member.path);
      std::replace(pointer.begin(), pointer.end(), '.', '/');
      std::replace(pointer.begin(), pointer.end(), '*', '0');
      document[Json::json_pointer(pointer)] = example_of(member);
    }
    return document;
  }();
  return all;
}

/// The paths of a result's members with a name that are nearest to the document's top; the copy of the scenario has others.
std::vector<std::string> members_called(std::string_view name) {
  std::vector<std::string> found = summary_paths();
  std::erase_if(found, [&](const std::string& each) {
    return each.starts_with("scenario.") || !each.ends_with("." + std::string(name));
  });
  const auto depth = [](const std::string& each) { return std::ranges::count(each, '.'); };
  std::ptrdiff_t least = std::numeric_limits<std::ptrdiff_t>::max();
  for (const std::string& each : found) least = std::min(least, depth(each));
  std::erase_if(found, [&](const std::string& each) { return depth(each) > least; });
  return found;
}

/// The path of the first member with this name, wherever it stands; empty where there is none.
std::string place_of(std::string_view name, const Json& at, const std::string& path) {
  if (!at.is_object()) return "";
  for (const auto& [key, value] : at.items()) {
    std::string below = path.empty() ? key : fmt::format("{}.{}", path, key);
    if (key == name) return below;
    if (std::string found = place_of(name, value, below); !found.empty()) return found;
  }
  return "";
}

std::string no_member(const Json& object, const std::string& path, std::string_view name) {
  std::vector<std::string_view> names;
  for (const auto& item : object.items()) names.emplace_back(item.key());
  std::string text = fmt::format("summary.json never has \"{}\"{}", name, path.empty() ? "" : fmt::format(" in {}", path));
  const std::vector<std::string> places = path.empty() ? members_called(name) : std::vector<std::string>{};
  if (places.size() > 1) return text + fmt::format("; say which: {}", fmt::join(places, ", "));
  if (const std::string elsewhere = place_of(name, every_member(), ""); !elsewhere.empty())
    return text + fmt::format("; did you mean \"{}\"", elsewhere);
  if (const auto meant = input::suggest(name, names))
    return text + fmt::format("; did you mean \"{}{}{}\"", path, path.empty() ? "" : ".", *meant);
  return text + fmt::format("; there are: {}", fmt::join(names, ", "));
}

}  // namespace

std::vector<std::string> summary_paths() {
  std::vector<std::string> paths;
  const auto walk = [&paths](const auto& self, const Json& at, const std::string& path) -> void {
    if (at.is_structured() && !at.empty()) {
      if (at.is_object())
        for (const auto& [key, value] : at.items()) {
          // No path leads to a name with a dot, and the version of the format is no result.
          if (key.find_first_of(".$ ") == std::string::npos)
            self(self, value, path.empty() ? key : fmt::format("{}.{}", path, key));
        }
      else
        for (std::size_t i = 0; i < at.size(); ++i) self(self, at[i], fmt::format("{}.{}", path, i));
    } else if (!path.empty()) {
      paths.push_back(path);
    }
  };
  walk(walk, every_member(), "");
  return paths;
}

std::optional<std::string> summary_path_fault(std::string_view path) {
  const Json* at = &every_member();
  std::string so_far;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    const std::string_view step = path.substr(begin, end - begin);
    begin = end + 1;
    if (at->is_object() && at->empty()) return std::nullopt;  // the names of its members depend on the run
    if (at->is_object()) {
      const auto member = at->find(step);
      if (member == at->end()) return no_member(*at, so_far, step);
      at = &*member;
    } else if (at->is_array() && !at->empty()) {
      const bool list = is_list(*at);
      const std::size_t size = list ? static_cast<std::size_t>(-1) : at->size();
      const auto index = input::array_index(step, size);
      if (!index)
        return list ? fmt::format("{} is a list, to be followed by a number of at least 0, not by \"{}\"", so_far, step)
                    : fmt::format("{} has {} elements, and is to be followed by a number from 0 to {}, not by \"{}\"", so_far,
                                  size, size - 1, step);
      at = &(*at)[list ? 0 : *index];
    } else {
      return fmt::format("{} has no members in summary.json, so there is no \"{}\"", so_far, step);
    }
    so_far += so_far.empty() ? "" : ".";
    so_far += step;
  }
  return std::nullopt;
}

std::string summary_path(std::string_view given) {
  std::string path(given);
  if (path.starts_with('/')) {
    path.erase(0, 1);
    std::replace(path.begin(), path.end(), '/', '.');
    return path;
  }
  if (path.find('.') != path.npos || every_member().contains(path)) return path;
  const std::vector<std::string> found = members_called(path);
  if (found.size() == 1) return found.front();
  if (!found.empty()) return path;
  try {
    std::string of_scenario = "scenario" + scenario_pointer(path);
    std::replace(of_scenario.begin(), of_scenario.end(), '/', '.');
    return of_scenario;
  } catch (const ScenarioError&) {
    return path;
  }
}

}  // namespace earthtop
