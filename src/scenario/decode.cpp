// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenario/decode.hpp"

#include <fmt/core.h>

#include <filesystem>

#include "scenario/check.hpp"
#include "scenario/overrides.hpp"
#include "scenario/reader.hpp"
#include "scenario/reading.hpp"

namespace earthtop::scenario {
namespace {

void decode_name(const Section& root, const std::string& file, Scenario& scenario) {
  scenario.title = root.word("title").value_or("");
  if (root.has("name")) {
    scenario.name = root.word("name").value_or(scenario.name);
    return;
  }
  if (file.empty() || file == "<stdin>") return;
  const std::string stem = std::filesystem::path(file).stem().string();
  if (is_scenario_name(stem))
    scenario.name = stem;
  else
    root.missing("name",
                 fmt::format("is missing, and the file's stem \"{}\" cannot stand in; give a name of 1 to 64 of a-z, 0-9 "
                             "and '-', not beginning with '-'",
                             excerpt(stem)));
}

void decode_headline(const Section& root, Scenario& scenario) {
  scenario.purpose = root.word("purpose").value_or("");
  if (!root.has("headline")) return;
  const Section given = root.section("headline");
  for (const std::string_view key : {"quantity", "value", "tolerance", "origin"}) given.require(key);
  const auto quantity = given.word("quantity"), origin = given.word("origin");
  const auto value = given.number("value"), tolerance = given.number("tolerance"), at = given.number("at_s");
  if (!quantity || !origin || !value || !tolerance) return;
  scenario.headline = HeadlineSpec{*quantity, at, *value, *tolerance, *origin};
  if (*quantity == "drift.threshold_time_s" && !root.section("report").has("threshold_rad"))
    given.refuse("quantity", "there is no threshold to pass; give /report/threshold_rad");
  if (!at || !(scenario.duration_s > 0)) return;
  if (quantity->find('.') != std::string::npos)
    given.refuse_key("at_s", "belongs to a column of trajectory.csv; a figure of summary.json has no time");
  else if (!is_output_time(*at, scenario.duration_s, scenario.output_step_s))
    given.warn("at_s", "is not the time of a row, a multiple of output_step_s within the duration: nothing is held against it");
}

/// @returns whether gravity is known
bool decode_site(const Section& root, Scenario& scenario) {
  const Section site = root.section("site");
  const auto rate = root.section("earth").number("rotation_rate_rad_s");
  const auto latitude = site.number("latitude_deg"), longitude = site.number("longitude_deg"), height = site.number("height_m");
  const auto gravity = site.number("gravity_m_s2");
  const bool gravity_given = site.has("gravity_m_s2");
  if (!site.has("latitude_deg") && !(gravity_given && rate == 0.0))
    site.missing("latitude_deg",
                 "is missing; must be a number from -90 to 90 (deg), unless the rotation rate is 0 and gravity_m_s2 "
                 "is given");
  scenario.rotation_rate_rad_s = rate.value_or(0);
  scenario.site = {latitude.value_or(0), longitude.value_or(0), height.value_or(0), gravity.value_or(0)};
  if (gravity_given && site.has("gravity_anomaly_m_s2"))
    site.refuse_key("gravity_anomaly_m_s2",
                    "is counted from normal gravity, and gravity_m_s2 is given; leave one of the two out");
  if (gravity_given) return gravity.has_value();
  if (!latitude || !height) return false;
  scenario.gravity_anomaly_m_s2 = site.number("gravity_anomaly_m_s2").value_or(0);
  scenario.site.gravity_m_s2 = normal_gravity(*latitude, *height) + scenario.gravity_anomaly_m_s2;
  return true;
}

std::array<double, kInputNames.size()> decode_uncertainty(const Section& uncertainty) {
  std::array<double, kInputNames.size()> standard_errors = {};
  for (std::size_t i = 0; i < kInputNames.size(); ++i) standard_errors[i] = uncertainty.number(kInputNames[i]).value_or(0);
  return standard_errors;
}

/// @returns whether body, release and gravity are known
bool decode(const Section& root, const ScenarioSource& source, Scenario& scenario) {
  decode_name(root, source.file, scenario);
  const bool gravity = decode_site(root, scenario);
  const auto body = root.require("body") ? decode_body(root.section("body")) : std::nullopt;
  const auto release = root.require("release") ? decode_release(root.section("release")) : std::nullopt;
  if (body) scenario.body = *body;
  if (release) scenario.release = *release;
  decode_motion(root.section("motion"), scenario);
  if (root.has("platform")) scenario.platform = decode_platform(root.section("platform"), source, scenario.duration_s);
  scenario.accuracy_rad = root.section("accuracy").number("drift_rad");
  decode_effects(root, scenario);
  decode_numerics(root.section("numerics"), scenario);
  decode_headline(root, scenario);
  scenario.criteria = decode_criteria(root);
  scenario.threshold_rad = root.section("report").number("threshold_rad");
  scenario.sensitivities = root.section("report").flag("sensitivities").value_or(false) || root.has("uncertainty");
  if (root.has("uncertainty")) scenario.uncertainty = decode_uncertainty(root.section("uncertainty"));
  return body && release && gravity;
}

}  // namespace

Reading read_scenario(const ScenarioSource& source, const std::vector<std::pair<std::string, std::string>>& overrides) {
  Reading reading;
  reading.text = source.text;
  if (reading.text.starts_with("\xEF\xBB\xBF")) reading.text.remove_prefix(3);  // columns are counted behind it
  const ReadOutcome outcome = read_json(reading.text, "", false, reading.root, reading.findings);
  if (outcome == ReadOutcome::not_json || outcome == ReadOutcome::refused) return reading;
  reading.is_whole = true;
  if (reading.root.kind == JsonKind::object) apply_overrides(reading.root, overrides, reading.findings);
  check_structure(reading.root, reading.findings);
  reading.has_start = decode(reading.section(), source, reading.scenario);
  return reading;
}

}  // namespace earthtop::scenario
