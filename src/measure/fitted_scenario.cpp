// SPDX-License-Identifier: GPL-3.0-or-later
// Puts the estimates of a fit into the text of its scenario.
#include <fmt/core.h>

#include "earthtop/measure/measurement.hpp"
#include "earthtop/scene/scene.hpp"
#include "input/text_edit.hpp"
#include "measure/estimated_inputs.hpp"

namespace earthtop {
namespace measure {
namespace {

using Overrides = std::vector<std::pair<std::string, std::string>>;

std::string with_overrides(std::string text, const Overrides& overrides) {
  for (const auto& [pointer, value] : overrides) text = input::with_value(text, pointer, value);
  return text;
}

std::string with_number(const std::string& text, std::string_view pointer, double number) {
  return input::with_value(text, pointer, fmt::format("{}", number));
}

/// The scenario that a text is, in the place where it will be. @throws ScenarioError where it is none
Scenario read_in_place(const ScenarioSource& source, const std::string& text, const std::string& file) {
  ScenarioReport report = examine_scenario({file, text, source.may_name_files});
  if (!report.scenario) throw ScenarioError(std::move(report.errors), file);
  return std::move(*report.scenario);
}

/// Whether two scenarios differ at most in their names: without one in the text a scenario has its file's.
bool are_alike(Scenario a, const Scenario& b) {
  a.name = b.name;
  return a == b;
}

}  // namespace
}  // namespace measure

void require_writable_scenario(const ScenarioSource& source, const std::vector<std::pair<std::string, std::string>>& overrides,
                               const std::string& file) {
  using namespace measure;
  const Scenario scenario = read_in_place(source, with_overrides(source.text, overrides), file);
  if (!are_alike(scenario, parse_scenario(source, overrides)))
    throw ScenarioError("", "the scenario would be another one there: does it name a file beside it?");
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

  std::string text = with_overrides(source.text, overrides);
  bool is_turned = false;  // whether components of the Earth's rate were estimated
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string& pointer = inputs.list()[i].pointer;
    if (pointer.empty())
      is_turned = true;
    else
      text = with_number(text, pointer, values[i]);
  }
  if (is_turned) {
    text = with_number(text, "/earth/rotation_rate_rad_s", fitted.rotation_rate_rad_s);
    text = with_number(text, "/site/latitude_deg", fitted.site.latitude_deg);
    const Scenario written = read_in_place(source, text, file);
    if (written.site.gravity_m_s2 != fitted.site.gravity_m_s2)  // the default, which follows the latitude
      text = with_number(text, "/site/gravity_m_s2", fitted.site.gravity_m_s2);
    if (written.excess_length_of_day_ms != fitted.excess_length_of_day_ms)
      text = with_number(text, "/effects/excess_length_of_day_ms", fitted.excess_length_of_day_ms);
  }
  if (!are_alike(read_in_place(source, text, file), fitted))
    throw ScenarioError("", "no scenario's text has exactly these estimates");
  return text;
}

}  // namespace earthtop
