// SPDX-License-Identifier: GPL-3.0-or-later
// Lists what a study can collect.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "earthtop/scene/scene.hpp"
#include "earthtop/study/study.hpp"
#include "results/figures.hpp"
#include "results/meanings.hpp"
#include "study/collect.hpp"
#include "study/design.hpp"
#include "study/json_text.hpp"

namespace earthtop {
namespace study {
namespace {

/// The scene of a study's first point that is not refused; none where the first thousand are.
std::optional<Scene> first_scene(const Study& study) {
  constexpr std::uint64_t kTried = 1000;
  const Collector collector(study);
  Design design(study);
  const std::uint64_t count = std::min(kTried, point_count(study).value_or(kTried));
  std::string refusal;
  for (std::uint64_t number = 0; number < count; ++number)
    if (auto scene = collector.scene(point_changes(study, design.point(number)), refusal)) return scene;
  return std::nullopt;
}

std::optional<Scene> scene_of(const ScenarioSource& source) {
  const Json json = Json::parse(source.text, nullptr, false, true);
  if (!json.is_object() || !json.contains("base")) return parse_scene(source);
  return first_scene(parse_study(source));
}

/// Parts of a summary that only some scenarios have, by the beginnings of their paths.
struct Part {
  std::string_view prefix;
  bool (*has)(const Scenario&);
};
constexpr Part kParts[] = {
    {"contact.", [](const Scenario& s) { return s.contact.has_value(); }},
    {"drift.tip_", [](const Scenario& s) { return s.contact.has_value(); }},
    {"rotor.", [](const Scenario& s) { return s.rotor.has_value(); }},
    {"drift.rotor_", [](const Scenario& s) { return s.rotor.has_value(); }},
    {"top.rotor_", [](const Scenario& s) { return s.rotor.has_value(); }},
    {"gimbal_events.", [](const Scenario& s) { return s.gimbals.has_value(); }},
    {"drift.outer_angle_", [](const Scenario& s) { return s.gimbals.has_value(); }},
    {"drift.inner_angle_", [](const Scenario& s) { return s.gimbals.has_value(); }},
    {"top.gimbals.", [](const Scenario& s) { return s.gimbals.has_value(); }},
    {"stops.", [](const Scenario& s) { return s.effects.applied.coulomb_N_m != 0; }},
    {"ledger.", [](const Scenario& s) { return s.ledger.has_value(); }},
    {"headline.", [](const Scenario& s) { return s.headline.has_value(); }},
    {"drift.digits.", [](const Scenario& s) { return s.precision != Precision::bits53; }},
    {"drift.threshold_", [](const Scenario& s) { return s.threshold_rad.has_value(); }},
    {"accuracy.", [](const Scenario& s) { return s.accuracy_rad.has_value(); }},
    {"selection.", [](const Scenario& s) { return s.effects.automatic; }},
    {"sensitivities.", [](const Scenario& s) { return s.sensitivities; }},
    {"uncertainty.", [](const Scenario& s) { return s.uncertainty.has_value(); }},
};

/// Whether a document has something at a dotted path.
bool has_at(const Json& document, std::string_view path) {
  std::string pointer = "/" + std::string(path);
  std::replace(pointer.begin(), pointer.end(), '.', '/');
  return document.contains(Json::json_pointer(pointer));
}

}  // namespace
}  // namespace study

std::vector<CollectablePath> collectable_paths(const std::optional<ScenarioSource>& source) {
  using namespace study;
  std::optional<Scene> scene;
  Json written;
  constexpr std::string_view kScenario = "scenario.";
  if (source) scene = scene_of(*source);
  if (scene) {
    RunResult result;
    result.scene = *scene;
    written = summary_part(result, "scenario");
  }
  std::vector<CollectablePath> list;
  for (std::string& path : summary_paths()) {
    const bool of_scenario = path.starts_with(kScenario);
    const auto lacks = [&](const Part& part) { return path.starts_with(part.prefix) && !part.has(scene->scenario()); };
    if (scene && (of_scenario ? !has_at(written, path.substr(kScenario.size()))
                              : std::any_of(std::begin(kParts), std::end(kParts), lacks)))
      continue;
    std::string unit = unit_of_path(path), meaning = meaning_of_path(path);
    list.push_back({std::move(path), std::move(unit), std::move(meaning)});
  }
  return list;
}

}  // namespace earthtop
