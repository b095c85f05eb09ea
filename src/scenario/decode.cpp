// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenario/decode.hpp"

#include <fmt/core.h>

#include <filesystem>

#include "earthtop/model/release.hpp"
#include "input/check.hpp"
#include "input/overrides.hpp"
#include "input/reader.hpp"
#include "scenario/document.hpp"
#include "scenario/fields.hpp"
#include "scenario/keys.hpp"
#include "scenario/plausibility.hpp"
#include "scenario/reading.hpp"

namespace earthtop {
namespace scenario {
namespace {

void decode_name(const Section& root, const std::string& file, Scenario& scenario) {
  Reading codec(root);
  description_keys(codec, scenario);
  if (root.has("name")) return;
  if (file.empty() || file == "<stdin>") return;
  const std::string stem = std::filesystem::path(file).stem().string();
  if (input::is_name(stem))
    scenario.name = stem;
  else
    root.missing("name",
                 fmt::format("is missing, and the file's stem \"{}\" cannot stand in; give a name of 1 to 64 of a-z, 0-9 "
                             "and '-', not beginning with '-'",
                             excerpt(stem)));
}

void decode_headline(const Section& root, Scenario& scenario) {
  if (!root.has("headline")) return;
  const Section given = root.section("headline");
  Reading codec(given);
  HeadlineSpec headline;
  headline_keys(codec, headline);
  if (!codec.complete()) return;
  scenario.headline = headline;
  if (headline.quantity == "drift.threshold_time_s" && !root.section("report").has("threshold_rad"))
    given.refuse("quantity", "there is no threshold to pass; give /report/threshold_rad");
  if (!headline.at_s || !(scenario.duration_s > 0)) return;
  if (headline.quantity.find('.') != std::string::npos)
    given.refuse_key("at_s", "belongs to a column of trajectory.csv; a figure of summary.json has no time");
  else if (!is_output_time(*headline.at_s, scenario.duration_s, scenario.output_step_s))
    given.warn("at_s", "is not the time of a row, a multiple of output_step_s within the duration: nothing is held against it");
}

/// @returns whether gravity is known
bool decode_site(const Section& root, Scenario& scenario) {
  const Section site = root.section("site"), earth = root.section("earth");
  const bool gravity_given = site.has("gravity_m_s2");
  if (!site.has("latitude_deg") && !(gravity_given && earth.number("rotation_rate_rad_s") == 0.0))
    site.missing("latitude_deg",
                 "is missing; must be a number from -90 to 90 (deg), unless the rotation rate is 0 and gravity_m_s2 "
                 "is given");
  Reading earth_codec(earth), codec(site);
  scenario.nominal_rate_rad_s = 0;  // where it has been refused
  earth_keys(earth_codec, scenario);
  scenario.rotation_rate_rad_s = scenario.nominal_rate_rad_s;
  site_keys(codec, scenario);
  if (gravity_given && site.has("gravity_anomaly_m_s2"))
    site.refuse_key("gravity_anomaly_m_s2",
                    "is counted from normal gravity, and gravity_m_s2 is given; leave one of the two out");
  if (gravity_given) return site.number("gravity_m_s2").has_value();
  if (!site.number("latitude_deg") || !site.number("height_m")) return false;
  scenario.site.gravity_m_s2 =
      normal_gravity(scenario.site.latitude_deg, scenario.site.height_m) + scenario.gravity_anomaly_m_s2;
  return true;
}

/// A steady precession may not exist; whether it does needs the body and gravity.
/// @returns whether there is a start
bool check_start(const Section& release, const Scenario& scenario) {
  try {
    const auto start = make_release<double>(scenario.release, make_body<double>(scenario.body), scenario.site.gravity_m_s2);
    if (start.w_XB_B.allFinite()) return true;
    release.refuse("precession", "no steady precession: its rate is too large for a double");
  } catch (const ScenarioError& error) {
    for (const Diagnostic& diagnostic : error.diagnostics()) release.refuse("precession", diagnostic.message);
  }
  return false;
}

void check_cost(const Section& root, const Scenario& scenario) {
  try {
    require_affordable(scenario);
  } catch (const ScenarioError& error) {
    constexpr std::string_view kEffects = "/effects/";
    for (const Diagnostic& diagnostic : error.diagnostics())
      if (diagnostic.pointer.starts_with(kEffects))
        root.section("effects").refuse_key(diagnostic.pointer.substr(kEffects.size()), diagnostic.message);
      else
        root.section("motion").refuse("duration_s", diagnostic.message);
  }
}

void check_method(const Section& numerics, const Scenario& scenario) {
  if (const auto reason = method_refusal(scenario.numerics.method, scenario)) numerics.refuse("method", *reason);
}

void decode(const Section& root, const ScenarioSource& source, Scenario& scenario) {
  decode_name(root, source.file, scenario);
  const bool gravity = decode_site(root, scenario);
  const auto body = root.require("body") ? decode_body(root.section("body")) : std::nullopt;
  const auto release = root.require("release") ? decode_release(root.section("release")) : std::nullopt;
  if (body) scenario.body = *body;
  if (release) scenario.release = *release;
  const bool starts = body && release && gravity && check_start(root.section("release"), scenario);
  decode_motion(root.section("motion"), scenario);
  if (root.has("platform")) scenario.platform = decode_platform(root.section("platform"), source, scenario.duration_s);
  Reading accuracy(root.section("accuracy")), report(root.section("report"));
  accuracy.key("drift_rad", scenario.accuracy_rad);
  decode_effects(root, scenario);
  if (starts) check_effects(root.section("effects"), scenario);
  decode_numerics(root.section("numerics"), scenario);
  if (starts) check_method(root.section("numerics"), scenario);
  decode_headline(root, scenario);
  scenario.criteria = decode_criteria(root);
  report_keys(report, scenario);
  if (root.has("uncertainty")) {
    Reading uncertainty(root.section("uncertainty"));
    uncertainty_keys(uncertainty, scenario.uncertainty.emplace());
    scenario.sensitivities = true;
  }
  if (starts && scenario.duration_s > 0 && !scenario.numerics.step_s) check_cost(root, scenario);
  warn_of_implausible(root, scenario);
}

}  // namespace

Document::Document(ScenarioSource source, const std::vector<std::pair<std::string, std::string>>& overrides)
    : source_(std::move(source)) {
  const input::ReadOutcome outcome = input::read_json(text(), "", false, root_, findings_);
  // After a syntax error the rest would be guesswork.
  is_whole_ = outcome != input::ReadOutcome::not_json && outcome != input::ReadOutcome::refused;
  if (is_whole_ && root_.kind == input::JsonKind::object) apply_overrides(root_, overrides, findings_);
}

std::string_view Document::text() const {
  std::string_view text = source_.text;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  return text;
}

ScenarioReport Document::examine(const std::vector<input::TreeChange>& changes) const {
  if (!is_whole_) return {std::nullopt, findings_.count(), findings_.errors(text()), {}};
  input::Findings findings = findings_;
  Node root = root_;
  if (root.kind == input::JsonKind::object) input::apply_changes(root, changes, findings);
  check_structure(root, findings, fields());
  Scenario scenario;
  decode(Section(root, findings, fields()), source_, scenario);
  ScenarioReport report{std::nullopt, findings.count(), findings.errors(text()), findings.warnings(text())};
  if (findings.empty()) report.scenario = std::move(scenario);
  return report;
}

}  // namespace scenario

ScenarioReport examine_scenario(const ScenarioSource& source,
                                const std::vector<std::pair<std::string, std::string>>& overrides) {
  return scenario::Document(source, overrides).examine();
}

Scenario parse_scenario(const ScenarioSource& source, const std::vector<std::pair<std::string, std::string>>& overrides) {
  ScenarioReport report = examine_scenario(source, overrides);
  if (!report.scenario) throw ScenarioError(std::move(report.errors), source.file);
  return *std::move(report.scenario);
}

}  // namespace earthtop
