// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of a scenario that need its scene: whether the release exists, whether effects and method fit, what the run costs.
#include "scene/examine.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "earthtop/scenario/support.hpp"
#include "earthtop/scene/scene.hpp"
#include "scene/plausibility.hpp"
#include "scene/support_laws.hpp"
#include "text/number_words.hpp"

namespace earthtop {
namespace {

using input::Section;

/// Checks that the release exists: a steady precession may not, depending on the body and gravity.
/// @returns whether the release exists
bool check_start(const Section& release, const Scene& scene) {
  try {
    if (scene.release<double>().w_XB_B.allFinite()) return true;
    release.refuse("precession", "no steady precession: its rate is too large for a double");
  } catch (const ScenarioError& error) {
    for (const Diagnostic& diagnostic : error.diagnostics()) release.refuse("precession", diagnostic.message);
  }
  return false;
}

void check_effects(const Section& effects, const Scene& scene) {
  const Scenario& scenario = scene.scenario();
  constexpr double kLongestTide_s = 3.2e7;  // computing the tide's series for this time takes a second or two
  if (scenario.effects.tide && !scenario.effects.tide->given && scenario.duration_s > kLongestTide_s)
    effects.refuse("tide",
                   "of Moon and Sun is computed for at most 3.2e7 s, a year; take a shorter duration, or a given amplitude");
  if (scenario.effects.automatic && !scene.support().no_effect_sizes.empty())
    effects.refuse_key("select", fmt::format("sizes the effects for a top on a fixed pivot, and is not available with {}; name "
                                             "the effects instead",
                                             scene.support().pointer));
}

void check_method(const Section& numerics, const Scene& scene) {
  if (const auto reason = precision_refusal(scene.scenario().precision)) numerics.refuse("precision", *reason);
  if (const auto& reason = scene.method_refusal()) numerics.refuse("method", *reason);
}

/// Checks the cost of a scene without other errors: its estimate takes the whole scene.
void check_cost(const Section& root, const Scene& scene) {
  if (scene.scenario().numerics.step_s) return;
  try {
    scene.require_affordable();
  } catch (const ScenarioError& error) {
    constexpr std::string_view kEffects = "/effects/", kContact = "/contact/";
    for (const Diagnostic& diagnostic : error.diagnostics())
      if (diagnostic.pointer.starts_with(kEffects))
        root.section("effects").refuse_key(diagnostic.pointer.substr(kEffects.size()), diagnostic.message);
      else if (diagnostic.pointer.starts_with(kContact))
        root.section("contact").refuse_key(diagnostic.pointer.substr(kContact.size()), diagnostic.message);
      else
        root.section("motion").refuse("duration_s", diagnostic.message);
  }
}

/// Warns of a gravity that is given, and held over a journey on which that of the Earth changes.
void warn_of_gravity(const Section& site, const Scene& scene) {
  const Model<double>& model = scene.model<double>();
  if (scene.scenario().travel->has_normal_gravity || model.mass_moment_B.isZero(0) || !site.has("gravity_m_s2")) return;
  constexpr double kFar_deg = 1, kDegree = std::numbers::pi / 180;
  constexpr int kLooks = 64;
  double change_deg = 0;
  for (int i = 1; i <= kLooks; ++i) {
    const double t = scene.scenario().duration_s * i / kLooks;
    change_deg = std::max(change_deg, std::abs(model.journey.at(JourneyPart::place, t)[0]) / kDegree);
  }
  if (change_deg > kFar_deg)
    site.warn("gravity_m_s2",
              fmt::format("holds along the whole journey, which leads {} deg to the North or South; leave it out for "
                          "normal gravity, which changes with the latitude",
                          told_apart(change_deg, kFar_deg, 3).first));
}

/// Checks that a journey can be made to its end. @returns whether that is so
bool check_journey(const Section& root, const Scene& scene) {
  if (!scene.scenario().travel) return true;
  try {
    warn_of_gravity(root.section("site"), scene);
    return true;
  } catch (const ScenarioError& error) {
    for (const Diagnostic& diagnostic : error.diagnostics()) root.refuse_key("travel", diagnostic.message);
    return false;
  }
}

void check_scene(const Section& root, const Scene& scene) {
  if (!check_journey(root, scene)) return;
  if (!check_start(root.section("release"), scene)) return;
  laws_of(scene).check(root, scene);
  check_effects(root.section("effects"), scene);
  check_method(root.section("numerics"), scene);
}

}  // namespace

ScenarioReport examine(const scenario::Document& document, const std::vector<input::TreeChange>& changes) {
  scenario::Decoded decoded = document.decode(changes);
  if (!decoded.is_whole) return {std::nullopt, decoded.findings.count(), decoded.errors()};
  const Scene scene(std::move(decoded.scenario));
  const input::Findings& findings = decoded.findings;
  if (decoded.has_start) check_scene(decoded.section(), scene);
  if (decoded.has_start && findings.empty()) check_cost(decoded.section(), scene);
  warn_of_implausible(decoded.section(), scene);
  ScenarioReport report{std::nullopt, findings.count(), decoded.errors(), findings.warnings(decoded.text)};
  if (!findings.empty()) return report;
  report.scenario = scene.scenario();
  report.scene = scene;
  return report;
}

std::optional<Scene> varied_scene(const scenario::Document& document, const std::vector<input::TreeChange>& changes) {
  scenario::Decoded decoded = document.decode(changes);
  if (!decoded.is_whole) return std::nullopt;
  Scene scene(std::move(decoded.scenario));
  if (decoded.has_start) check_scene(decoded.section(), scene);
  if (!decoded.findings.empty()) return std::nullopt;
  return scene;
}

ScenarioReport examine_scenario(const ScenarioSource& source, const Overrides& overrides) {
  return examine(scenario::Document(source, overrides));
}

Scene parse_scene(const ScenarioSource& source, const Overrides& overrides) {
  ScenarioReport report = examine_scenario(source, overrides);
  if (!report.scene) throw ScenarioError(std::move(report.errors), source.file);
  return *std::move(report.scene);
}

Scenario parse_scenario(const ScenarioSource& source, const Overrides& overrides) {
  return parse_scene(source, overrides).scenario();
}

}  // namespace earthtop
