// SPDX-License-Identifier: GPL-3.0-or-later
// Writes a scenario as JSON, each section with the same description that reads it.
#include "earthtop/scenario/scenario.hpp"
#include "scenario/fields.hpp"
#include "scenario/keys.hpp"
#include "scenario/travel_keys.hpp"
#include "scenario/writing.hpp"

namespace earthtop {
namespace scenario {
namespace {

nlohmann::json written_out(const Scenario& s) {
  nlohmann::json json = {{"$schema", "earthtop-scenario-1.json"}};
  Writing root(json);
  description_keys(root, s);
  if (s.headline) root.object("headline", true, [&](auto& below) { headline_keys(below, *s.headline); });
  root.list("criteria", s.criteria, [](auto& element, const auto& criterion) { criterion_keys(element, criterion); });
  root.object("site", true, [&](auto& below) { site_keys(below, s); });
  root.object("earth", true, [&](auto& below) { earth_keys(below, s); });
  if (s.travel)
    root.object("travel", true, [&](auto& below) {
      travel_keys(below, *s.travel);
      below.list("legs", s.travel->legs, [](auto& element, const auto& leg) { leg_keys(element, leg); });
    });
  root.object("body", true, [&](auto& below) {
    if (s.body.solids.empty()) return body_keys(below, s.body);
    below.list("solids", s.body.solids, [](auto& element, const auto& solid) { solid_keys(element, solid); });
  });
  if (s.rotor) root.object("rotor", true, [&](auto& below) { rotor_keys(below, *s.rotor); });
  if (s.gimbals) root.object("gimbals", true, [&](auto& below) { gimbals_keys(below, *s.gimbals); });
  root.list("moving_masses", s.moving_masses, [](auto& element, const auto& mass) { moving_mass_keys(element, mass); });
  root.object("release", true, [&](auto& below) {
    below.word("rates_relative_to", s.release.rates_relative_to, kRateFrames);
    if (s.release.gimbals) return gimbal_release_keys(below, *s.release.gimbals);
    attitude_keys(below, s.release);
    rates_keys(below, s.release);
  });
  root.object("motion", true, [&](auto& below) { motion_keys(below, s); });
  if (s.platform) root.object("platform", true, [&](auto& below) { platform_keys(below, *s.platform); });
  if (s.instrument) root.object("instrument", true, [&](auto& below) { instrument_keys(below, *s.instrument); });
  if (s.contact) root.object("contact", true, [&](auto& below) { contact_keys(below, *s.contact); });
  root.object("effects", true, [&](auto& below) {
    orientation_keys(below, s);
    torque_keys(below, s.effects);
    tide_key(below, s.effects.tide);
  });
  root.object("numerics", true, [&](auto& below) { numerics_keys(below, s); });
  root.object("accuracy", true, [&](auto& below) { below.key("drift_rad", s.accuracy_rad); });
  root.object("report", true, [&](auto& below) { report_keys(below, s); });
  if (s.uncertainty) root.object("uncertainty", true, [&](auto& below) { uncertainty_keys(below, *s.uncertainty); });
  return json;
}

}  // namespace
}  // namespace scenario

std::string canonical_json(const Scenario& scenario) { return scenario::written_out(scenario).dump(); }

std::string identity_json(const Scenario& scenario) {
  nlohmann::json json = scenario::written_out(scenario);
  for (const std::string_view key : describing_keys()) json.erase(std::string(key));
  return json.dump();
}

std::vector<std::string_view> describing_keys() {
  std::vector<std::string_view> keys;
  for (const input::Field& field : scenario::fields().fields)
    if (field.describes_only) keys.push_back(field.key());
  return keys;
}

}  // namespace earthtop
