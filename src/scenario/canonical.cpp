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
  else if (options.method != Method::closed_form)
    json["relative_tolerance"] = options.relative_tolerance;
  if (options.composition != Composition::automatic) json["composition"] = std::string(to_string(options.composition));
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
               {"effects",
                {{"coriolis", scenario.effects.coriolis},
                 {"centrifugal", scenario.effects.centrifugal},
                 {"transverse", scenario.effects.transverse}}},
               {"numerics", numerics_json(scenario)}};
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
