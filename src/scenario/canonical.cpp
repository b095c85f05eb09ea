// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "earthtop/scenario/scenario.hpp"

namespace earthtop {
namespace {

using Json = nlohmann::json;  // sorts keys; writes the shortest digits that read back

Json solid_json(const Solid& solid) {
  static constexpr const char* kShapes[] = {"disc", "cylinder", "ring", "cone", "sphere", "rod"};
  Json json = {{"shape", kShapes[static_cast<int>(solid.shape)]}, {"at_m", solid.at_m}};
  // Members that a shape does not have would be refused on reading back; 0 is their default where it does.
  if (solid.radius_m != 0) json["radius_m"] = solid.radius_m;
  if (solid.inner_radius_m != 0 || solid.shape == SolidShape::ring) json["inner_radius_m"] = solid.inner_radius_m;
  if (solid.length_m != 0) json["length_m"] = solid.length_m;
  if (solid.mass_kg) json["mass_kg"] = *solid.mass_kg;
  if (solid.density_kg_m3) json["density_kg_m3"] = *solid.density_kg_m3;
  return json;
}

Json body_json(const BodySpec& body) {
  if (!body.solids.empty()) {
    Json solids = Json::array();
    std::transform(body.solids.begin(), body.solids.end(), std::back_inserter(solids), solid_json);
    return {{"solids", solids}};
  }
  return {{"mass_kg", body.mass_kg},
          {"center_of_mass_m", body.center_of_mass_m},
          {"inertia",
           {{"about", body.inertia_about == InertiaAbout::pivot ? "pivot" : "center_of_mass"},
            {"matrix_kg_m2", body.inertia_kg_m2}}}};
}

Json precession_json(const ReleaseSpec& release) {
  switch (release.precession) {
    case Precession::none: return "none";
    case Precession::steady_slow: return "steady_slow";
    case Precession::steady_fast: return "steady_fast";
    case Precession::given: break;
  }
  return {{"rate_rad_s", release.precession_rate_rad_s}};
}

Json release_json(const ReleaseSpec& release) {
  Json json = {{"rates_relative_to", release.rates_relative_to == RatesRelativeTo::laboratory ? "laboratory" : "inertial"}};
  if (release.quaternion_LB) {
    const auto& q = *release.quaternion_LB;
    json["quaternion_LB"] = {{"w", q[0]}, {"x", q[1]}, {"y", q[2]}, {"z", q[3]}};
  } else {
    json["tilt_deg"] = release.tilt_deg;
    json["azimuth_deg"] = release.azimuth_deg;
    json["spin_angle_deg"] = release.spin_angle_deg;
  }
  if (release.angular_velocity_body_rad_s) {
    json["angular_velocity_body_rad_s"] = *release.angular_velocity_body_rad_s;
  } else {
    json["spin_rad_s"] = release.spin_rad_s;
    json["precession"] = precession_json(release);
  }
  return json;
}

Json platform_json(const PlatformSpec& platform) {
  Json json = {{"axis", platform.axis}, {"pivot_offset_m", platform.pivot_offset_m}};
  switch (platform.motion) {
    case PlatformMotion::ramp: json["acceleration_rad_s2"] = platform.acceleration_rad_s2; [[fallthrough]];
    case PlatformMotion::constant: json["rate_rad_s"] = platform.rate_rad_s; break;
    case PlatformMotion::harmonic:
      json["amplitude_rad"] = platform.amplitude_rad;
      json["frequency_hz"] = platform.frequency_hz;
      json["phase_deg"] = platform.phase_deg;
      break;
    case PlatformMotion::table:
      json["file"] = platform.file;
      json["file_sha256"] = platform.file_sha256;  // the table itself, as far as the run's identity goes
      break;
  }
  static constexpr const char* kMotions[] = {"constant", "ramp", "harmonic", "table"};
  json["motion"] = kMotions[static_cast<int>(platform.motion)];
  return json;
}

Json numerics_json(const Scenario& scenario) {
  const IntegrationOptions& options = scenario.numerics;
  Json json = {{"method", std::string(to_string(options.method))},
               {"observer", std::string(to_string(options.observer))},
               {"model", std::string(to_string(options.form))},
               {"precision", std::string(to_string(scenario.precision))}};
  if (options.step_s)
    json["step_s"] = *options.step_s;
  else if (!is_exact(options.method))
    json["relative_tolerance"] = options.relative_tolerance;
  if (options.composition != Composition::automatic) json["composition"] = std::string(to_string(options.composition));
  return json;
}

Json tide_json(const TideSpec& tide) {
  if (tide.given)
    return {{"amplitude_m_s2", tide.amplitude_m_s2}, {"frequency_hz", tide.frequency_hz}, {"phase_deg", tide.phase_deg}};
  return {{"gravimetric_factor", tide.options.gravimetric_factor}, {"tilt_factor", tide.options.tilt_factor}};
}

/// Effects that are off are left out: a scene of before they were known keeps its identity.
Json effects_json(const EffectsSpec& effects) {
  Json json = {{"coriolis", effects.coriolis}, {"centrifugal", effects.centrifugal}, {"transverse", effects.transverse}};
  const AppliedTorquesSpec& applied = effects.applied;
  if (applied.viscous_N_m_s != 0) json["viscous_torque_N_m_s"] = applied.viscous_N_m_s;
  if (applied.quadratic_N_m_s2 != 0) json["quadratic_torque_N_m_s2"] = applied.quadratic_N_m_s2;
  if (applied.coulomb_N_m != 0) json["coulomb_torque_N_m"] = applied.coulomb_N_m;
  if (applied.air_drag) {
    static constexpr const char* kFlows[] = {"auto", "laminar", "turbulent"};
    json["air_drag"] = {{"disc_radius_m", applied.air_drag->disc_radius_m},
                        {"density_kg_m3", applied.air_drag->density_kg_m3},
                        {"kinematic_viscosity_m2_s", applied.air_drag->kinematic_viscosity_m2_s},
                        {"flow", kFlows[static_cast<int>(applied.air_drag->flow)]}};
  }
  if (applied.gravity_gradient) switch (applied.gravity_gradient->field) {
      case GradientField::radial: json["gravity_gradient"] = true; break;
      case GradientField::normal: json["gravity_gradient"] = "normal"; break;
      case GradientField::given: json["gravity_gradient"] = {{"gm_over_r3_s2", applied.gravity_gradient->gm_over_r3_s2}};
    }
  if (effects.tide) json["tide"] = tide_json(*effects.tide);
  if (effects.automatic) json["select"] = "auto";
  if (applied.gimbal) json["gimbal"] = {{"damping_N_m_s", applied.gimbal->damping_N_m_s}};
  return json;
}

}  // namespace

std::string canonical_json(const Scenario& scenario) {
  Json json = {{"$schema", "earthtop-scenario-1.json"},
               {"name", scenario.name},
               {"site",
                {{"latitude_deg", scenario.site.latitude_deg},
                 {"longitude_deg", scenario.site.longitude_deg},
                 {"height_m", scenario.site.height_m},
                 {"gravity_m_s2", scenario.site.gravity_m_s2}}},
               {"earth", {{"rotation_rate_rad_s", scenario.rotation_rate_rad_s}}},
               {"body", body_json(scenario.body)},
               {"release", release_json(scenario.release)},
               {"motion", {{"duration_s", scenario.duration_s}, {"output_step_s", scenario.output_step_s}}},
               {"effects", effects_json(scenario.effects)},
               {"numerics", numerics_json(scenario)}};
  const Site& site = scenario.site;
  if (site.pole.x_arcsec != 0 || site.pole.y_arcsec != 0)
    json["effects"]["polar_motion"] = {{"x_arcsec", site.pole.x_arcsec}, {"y_arcsec", site.pole.y_arcsec}};
  if (site.deflection.north_arcsec != 0 || site.deflection.east_arcsec != 0)
    json["effects"]["deflection_of_vertical"] = {{"north_arcsec", site.deflection.north_arcsec},
                                                 {"east_arcsec", site.deflection.east_arcsec}};
  if (scenario.start_utc) json["motion"]["start_utc"] = *scenario.start_utc;
  if (scenario.accuracy_rad) json["accuracy"]["drift_rad"] = *scenario.accuracy_rad;
  if (scenario.ledger) json["numerics"]["ledger"] = std::string(to_string(*scenario.ledger));
  if (scenario.platform) json["platform"] = platform_json(*scenario.platform);
  if (scenario.threshold_rad) json["report"]["threshold_rad"] = *scenario.threshold_rad;
  if (scenario.uncertainty)
    for (std::size_t i = 0; i < kInputNames.size(); ++i)
      json["uncertainty"][std::string(kInputNames[i])] = (*scenario.uncertainty)[i];
  else if (scenario.sensitivities)
    json["report"]["sensitivities"] = true;
  return json.dump();
}

}  // namespace earthtop
