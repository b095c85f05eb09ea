// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of a scenario that need its scene: whether the release exists, whether effects and method fit, what the run costs.
#include "scene/examine.hpp"

#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "earthtop/model/release.hpp"
#include "earthtop/scene/scene.hpp"
#include "scene/examine_contact.hpp"
#include "scene/plausibility.hpp"

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

/// Checks that a gimbal that holds the axis level gets an axis that is level and a rate that keeps it level.
void check_gimbal(const Section& effects, const Scene& scene) {
  constexpr double kLevel = 1e-12;
  const Scenario& scenario = scene.scenario();
  const Release<double>& release = scene.release<double>();
  const Mat3<double> R_LB = rotation_matrix(release.q_LB);
  const Vec3<double> up_B = R_LB.row(2).transpose();
  if (scenario.platform) return effects.refuse_key("gimbal", "is not available on a platform; leave one of the two out");
  if (scenario.effects.applied.coulomb_N_m != 0)
    return effects.refuse_key("coulomb_torque_N_m", "is not available with a gimbal; give the gimbal a damping instead");
  if (std::abs(up_B[2]) > kLevel)
    return effects.refuse("gimbal", fmt::format("holds body axis 3 level, and the release tilts it by {:.6g} deg; give "
                                                "/release/tilt_deg 90, or leave the gimbal out",
                                                real::atan2(real::hypot(up_B[0], up_B[1]), up_B[2]) * 180 / std::numbers::pi));
  if (scenario.release.rates_relative_to == RatesRelativeTo::inertial)
    return effects.refuse(
        "gimbal",
        "holds body axis 3 level in the laboratory, and rates that are the same in inertial space would let it "
        "leave the level; give /release/rates_relative_to \"laboratory\"");
  const double leaving = release.w_XB_B.dot(up_B.cross(Vec3<double>::UnitZ()));
  if (std::abs(leaving) > kLevel * norm(release.w_XB_B))
    effects.refuse("gimbal", fmt::format("holds body axis 3 level, and the release turns it out of the level at {:.6g} rad/s; "
                                         "give rates about axis 3 and Up only",
                                         std::abs(leaving)));
}

/// Checks what the effects require of the release, of the platform and of one another.
void check_effects(const Section& effects, const Scene& scene) {
  const Scenario& scenario = scene.scenario();
  const AppliedTorquesSpec& applied = scenario.effects.applied;
  if (applied.gimbal && !scenario.contact) check_gimbal(effects, scene);
  constexpr double kLongestTide_s = 3.2e7;  // computing the tide's series for this time takes a second or two
  if (scenario.effects.tide && !scenario.effects.tide->given && scenario.duration_s > kLongestTide_s)
    effects.refuse("tide",
                   "of Moon and Sun is computed for at most 3.2e7 s, a year; take a shorter duration, or a given amplitude");
  if (applied.coulomb_N_m != 0 && scenario.platform && !scenario.contact)
    effects.refuse_key("coulomb_torque_N_m", "is not available on a platform; leave one of the two out");
}

/// Refuses what is made for a fixed pivot only.
void check_beside_contact(const Section& root, const Scene& scene) {
  if (!scene.scenario().contact) return;
  if (scene.scenario().effects.automatic)
    root.section("effects").refuse_key(
        "select", "sizes the effects for a top on a fixed pivot, and is not available with /contact; name the effects instead");
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

void check_scene(const Section& root, const Scene& scene) {
  if (!check_start(root.section("release"), scene)) return;
  if (scene.scenario().contact) check_contact(root, scene);
  check_effects(root.section("effects"), scene);
  check_beside_contact(root, scene);
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
