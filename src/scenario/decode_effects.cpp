// SPDX-License-Identifier: GPL-3.0-or-later
// Which torques act, and what they need of the rest of the scene.
#include <fmt/core.h>

#include <array>
#include <cmath>

#include "earthtop/frames/earth_orientation.hpp"
#include "input/suggest.hpp"
#include "scenario/decode.hpp"

namespace earthtop::scenario {
namespace {

AirDragSpec decode_air_drag(const Section& air) {
  AirDragSpec spec;
  air.require("disc_radius_m");
  spec.disc_radius_m = air.number("disc_radius_m").value_or(1);
  spec.density_kg_m3 = air.number("density_kg_m3").value_or(spec.density_kg_m3);
  spec.kinematic_viscosity_m2_s = air.number("kinematic_viscosity_m2_s").value_or(spec.kinematic_viscosity_m2_s);
  const auto flow = air.word("flow");
  if (flow == "laminar") spec.flow = DiscFlow::laminar;
  if (flow == "turbulent") spec.flow = DiscFlow::turbulent;
  return spec;
}

std::optional<GravityGradientSpec> decode_gradient(const Section& effects) {
  if (effects.is_object("gravity_gradient")) {
    const Section given = effects.section("gravity_gradient");
    given.require("gm_over_r3_s2");
    return GravityGradientSpec{GradientField::given, given.number("gm_over_r3_s2").value_or(0)};
  }
  if (effects.is_word("gravity_gradient")) return GravityGradientSpec{GradientField::normal, 0};
  if (effects.flag("gravity_gradient").value_or(false)) return GravityGradientSpec{};
  return std::nullopt;
}

std::optional<GimbalSpec> decode_gimbal(const Section& effects) {
  if (effects.is_object("gimbal")) return GimbalSpec{effects.section("gimbal").number("damping_N_m_s").value_or(0)};
  if (effects.flag("gimbal").value_or(false)) return GimbalSpec{};
  return std::nullopt;
}

/// What is looked up by the date needs one.
void require_start(const Section& effects, std::string_view key, const Section& motion) {
  if (!motion.has("start_utc"))
    effects.refuse(key, "is looked up by the date; give /motion/start_utc, or the values themselves");
}

std::optional<TideSpec> decode_tide(const Section& effects, const Section& motion) {
  TideSpec tide;
  const Section given = effects.section("tide");
  if (effects.is_object("tide")) {
    tide.given = given.has("amplitude_m_s2");
    tide.options.gravimetric_factor = given.number("gravimetric_factor").value_or(1);
    tide.options.tilt_factor = given.number("tilt_factor").value_or(1);
    if (tide.given) {
      given.require("frequency_hz");
      for (const std::string_view key : {"gravimetric_factor", "tilt_factor"})
        if (given.has(key))
          given.refuse_key(key, "belongs to the tide of Moon and Sun, not to one of given amplitude; leave it out");
      tide.amplitude_m_s2 = given.vector("amplitude_m_s2").value_or(tide.amplitude_m_s2);
      tide.frequency_hz = given.number("frequency_hz").value_or(0);
      tide.phase_deg = given.number("phase_deg").value_or(0);
      return tide;
    }
    for (const std::string_view key : {"frequency_hz", "phase_deg"})
      if (given.has(key)) given.refuse_key(key, "belongs to a tide of given amplitude; give amplitude_m_s2, or leave it out");
  } else if (!effects.flag("tide").value_or(false)) {
    return std::nullopt;
  }
  require_start(effects, "tide", motion);
  return tide;
}

/// Pole, length of day and plumb line: what they make of the Earth's rate in laboratory axes.
void decode_orientation(const Section& effects, const Section& motion, Scenario& scenario) {
  if (effects.is_object("polar_motion")) {
    const Section pole = effects.section("polar_motion");
    for (const std::string_view key : {"x_arcsec", "y_arcsec"}) pole.require(key);
    scenario.site.pole = {pole.number("x_arcsec").value_or(0), pole.number("y_arcsec").value_or(0)};
  } else if (effects.flag("polar_motion").value_or(false)) {
    require_start(effects, "polar_motion", motion);
    if (scenario.start_utc) scenario.site.pole = secular_pole(julian_epoch_year(*parse_utc(*scenario.start_utc)));
  }
  const Section deflection = effects.section("deflection_of_vertical");
  scenario.site.deflection = {deflection.number("north_arcsec").value_or(0), deflection.number("east_arcsec").value_or(0)};
  scenario.excess_length_of_day_s = effects.number("excess_length_of_day_ms").value_or(0) * 1e-3;
  if (scenario.excess_length_of_day_s != 0)
    scenario.rotation_rate_rad_s = earth_rate_with_length_of_day(scenario.rotation_rate_rad_s, scenario.excess_length_of_day_s);
}

}  // namespace

void decode_effects(const Section& root, Scenario& scenario) {
  const Section effects = root.section("effects"), motion = root.section("motion");
  if (const auto start = motion.word("start_utc")) {
    if (parse_utc(*start))
      scenario.start_utc = *start;
    else
      motion.refuse("start_utc", fmt::format("is \"{}\"; must be an instant of UTC, YYYY-MM-DDThh:mm:ssZ", excerpt(*start)));
  }
  EffectsSpec& spec = scenario.effects;
  spec.automatic = root.is_word("effects") || effects.has("select");
  if (spec.automatic && !scenario.accuracy_rad && !root.section("accuracy").has("drift_rad")) {
    constexpr const char* kNeeded = "\"auto\" chooses by the drift error asked for; give /accuracy/drift_rad";
    root.is_word("effects") ? root.refuse("effects", kNeeded) : effects.refuse("select", kNeeded);
  }
  decode_orientation(effects, motion, scenario);
  spec.tide = decode_tide(effects, motion);
  spec.coriolis = effects.flag("coriolis").value_or(true);
  spec.centrifugal = effects.flag("centrifugal").value_or(true);
  spec.transverse = effects.flag("transverse").value_or(true);
  AppliedTorquesSpec& applied = spec.applied;
  applied.viscous_N_m_s = effects.number("viscous_torque_N_m_s").value_or(0);
  applied.quadratic_N_m_s2 = effects.number("quadratic_torque_N_m_s2").value_or(0);
  applied.coulomb_N_m = effects.number("coulomb_torque_N_m").value_or(0);
  if (effects.has("air_drag")) applied.air_drag = decode_air_drag(effects.section("air_drag"));
  applied.gravity_gradient = decode_gradient(effects);
  applied.gimbal = decode_gimbal(effects);
}

}  // namespace earthtop::scenario
