// SPDX-License-Identifier: GPL-3.0-or-later
// Puts the estimates of a fit into the text of its scenario.
#include <fmt/core.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "earthtop/measure/measurement.hpp"
#include "earthtop/scene/scene.hpp"
#include "input/text_edit.hpp"
#include "measure/estimated_inputs.hpp"
#include "text/json.hpp"

namespace earthtop {
namespace measure {
namespace {

std::string with_number(const std::string& text, std::string_view pointer, double number) {
  return input::with_value(text, pointer, fmt::format("{}", number));
}

/// The scenario that a text is, in the place where it will be. @throws ScenarioError where it is none
Scenario read_in_place(const ScenarioSource& source, const std::string& text, const std::string& file) {
  ScenarioReport report = examine_scenario({file, text, source.may_name_files});
  if (!report.scenario) throw ScenarioError(std::move(report.errors), file);
  return std::move(*report.scenario);
}

/// Puts in what inputs without a place of their own in the text have changed: a component of the Earth's rate changes rate and
/// latitude, a ratio of moments the body.
std::string with_combined_inputs(std::string text, const Scenario& wanted,
                                 const std::function<Scenario(const std::string&)>& read) {
  const Scenario before = read(text);
  const auto put = [&](std::string_view pointer, double now, double number) {
    if (now != number) text = with_number(text, pointer, number);
  };
  put("/earth/rotation_rate_rad_s", before.rotation_rate_rad_s, wanted.rotation_rate_rad_s);
  put("/site/latitude_deg", before.site.latitude_deg, wanted.site.latitude_deg);
  put("/effects/excess_length_of_day_ms", before.excess_length_of_day_ms, wanted.excess_length_of_day_ms);
  if (before.gravity_anomaly_m_s2 != wanted.gravity_anomaly_m_s2)
    text = input::without_member(text, "/site/gravity_anomaly_m_s2");
  put("/site/gravity_m_s2", read(text).site.gravity_m_s2, wanted.site.gravity_m_s2);  // by default it follows the latitude
  if (before.body != wanted.body) text = input::with_value(text, "/body", written(json_of(canonical_json(wanted)).at("body")));
  return text;
}

/// The claims of a text on its scenario's own numbers, which are others now.
constexpr std::string_view kClaims[] = {"/headline", "/criteria"};

/// Requires that two scenarios differ at most in their claims and their names: without one in the text a scenario has its file's.
void require_alike(Scenario there, const Scenario& wanted) {
  there.name = wanted.name;
  there.headline = wanted.headline;
  there.criteria = wanted.criteria;
  if (there != wanted)
    throw ScenarioError("", "the scenario would be a different one there: does it name a file in its own directory?");
}

}  // namespace
}  // namespace measure

void require_writable_scenario(const ScenarioSource& source, const std::vector<std::pair<std::string, std::string>>& overrides,
                               const std::string& file) {
  using namespace measure;
  const Scenario scenario = parse_scenario(source, overrides);
  require_alike(read_in_place(source, changed_text(source.text, overrides), file), scenario);
}

std::string fitted_scenario(const ScenarioSource& source, const std::vector<std::pair<std::string, std::string>>& overrides,
                            const MeasurementReport& report, const std::string& file) {
  using namespace measure;
  if (!report.fitted) throw ScenarioError("", "there is no fit whose estimates could be written");
  std::vector<std::string> names;
  std::vector<double> values;
  for (const ParameterEstimate& estimate : report.estimates) {
    names.push_back(estimate.name);
    values.push_back(*estimate.estimate);
  }
  const EstimatedInputs inputs(source, overrides, parse_scene(source, overrides), names);
  const std::optional<Scene> scene = inputs.scene(values);
  if (!scene) throw ScenarioError("", "no scenario has these estimates");
  const Scenario& fitted = scene->scenario();

  std::vector<std::pair<std::string, std::string>> estimates;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (const std::string& pointer = inputs.list()[i].pointer; !pointer.empty())
      estimates.emplace_back(pointer, fmt::format("{}", values[i]));
  std::string text = changed_text(changed_text(source.text, overrides), estimates);
  for (const std::string_view key : kClaims) text = input::without_member(text, key);
  text = with_combined_inputs(text, fitted, [&](const std::string& now) { return read_in_place(source, now, file); });
  require_alike(read_in_place(source, text, file), fitted);
  return text;
}

}  // namespace earthtop
