// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/mistakes.hpp"

#include <cmath>
#include <numbers>

#include "earthtop/elementary.hpp"
#include "earthtop/frames/earth.hpp"

namespace earthtop::compare {
namespace {

constexpr double kOneDegree = std::numbers::pi / 180;
constexpr double kSolarDay_s = 86400;

/// The Earth's rate along North and Up (rad/s).
struct EarthRate {
  double north = 0, up = 0;
};

EarthRate earth_rate(const Scene& scene) {
  const Vec3<double> axis_L = celestial_axis_L<double>(scene.site());
  return {scene.rotation_rate_rad_s() * axis_L[1], scene.rotation_rate_rad_s() * axis_L[2]};
}

/// Sets the Earth's rate. One that points to the South is that of an Earth that turns the other way.
void put_earth_rate(Scenario& scenario, const EarthRate& rate) {
  const double sign = rate.north < 0 ? -1 : 1;
  scenario.rotation_rate_rad_s = sign * real::hypot(rate.north, rate.up);
  scenario.site.latitude_deg = real::atan2(sign * rate.up, sign * rate.north) / kOneDegree;
}

std::optional<Scenario> with_earth_rate(const Scene& scene, const EarthRate& rate) {
  if (scene.rotation_rate_rad_s() == 0) return std::nullopt;
  Scenario scenario = resolved_scenario(scene);
  put_earth_rate(scenario, rate);
  return scenario;
}

std::optional<Scenario> without_earth(const Scene& scene) {
  if (scene.rotation_rate_rad_s() == 0) return std::nullopt;
  Scenario scenario = resolved_scenario(scene);
  scenario.rotation_rate_rad_s = 0;
  return scenario;
}

std::optional<Scenario> without_journey(const Scene& scene) {
  if (!scene.scenario().travel) return std::nullopt;
  Scenario scenario = resolved_scenario(scene);
  scenario.travel.reset();
  return scenario;
}

std::optional<Scenario> wrong_way(const Scene& scene) {
  const EarthRate rate = earth_rate(scene);
  return with_earth_rate(scene, {-rate.north, -rate.up});
}

std::optional<Scenario> without_coriolis(const Scene& scene) {
  if (scene.rotation_rate_rad_s() == 0 || !scene.scenario().effects.coriolis) return std::nullopt;
  Scenario scenario = resolved_scenario(scene);
  scenario.effects.coriolis = false;
  scenario.numerics.method = Method::automatic;
  return scenario;
}

std::optional<Scenario> other_rates(const Scene& scene) {
  if (scene.rotation_rate_rad_s() == 0) return std::nullopt;
  Scenario scenario = resolved_scenario(scene);
  RatesRelativeTo& relative_to = scenario.release.rates_relative_to;
  relative_to = relative_to == RatesRelativeTo::laboratory ? RatesRelativeTo::inertial : RatesRelativeTo::laboratory;
  return scenario;
}

std::optional<Scenario> laboratory_taken_as_inertial(const Scene& scene) {
  return scene.scenario().release.rates_relative_to == RatesRelativeTo::laboratory ? other_rates(scene) : std::nullopt;
}
std::optional<Scenario> inertial_taken_as_laboratory(const Scene& scene) {
  return scene.scenario().release.rates_relative_to == RatesRelativeTo::inertial ? other_rates(scene) : std::nullopt;
}

std::optional<Scenario> solar_day(const Scene& scene) {
  if (scene.rotation_rate_rad_s() == 0) return std::nullopt;
  Scenario scenario = resolved_scenario(scene);
  scenario.rotation_rate_rad_s = std::copysign(2 * std::numbers::pi / kSolarDay_s, scene.rotation_rate_rad_s());
  return scenario;
}

std::optional<Scenario> latitude_in_radians(const Scene& scene) {
  const double latitude = scene.scenario().site.latitude_deg, rate = scene.rotation_rate_rad_s();
  return with_earth_rate(scene, {rate * real::cos(latitude), rate * real::sin(latitude)});
}

std::optional<Scenario> opposite_latitude(const Scene& scene) {
  const EarthRate rate = earth_rate(scene);
  return rate.up == 0 ? std::nullopt : with_earth_rate(scene, {rate.north, -rate.up});
}

std::optional<Scenario> azimuth_from_east(const Scene& scene) {
  if (scene.scenario().release.quaternion_LB || scene.scenario().release.gimbals) return std::nullopt;
  Scenario scenario = resolved_scenario(scene);
  scenario.release.azimuth_deg = 90 - scenario.release.azimuth_deg;
  return scenario;
}

std::optional<Scenario> moments_about(const Scene& scene, InertiaAbout about) {
  Scenario scenario = resolved_scenario(scene);
  if (!scenario.body.solids.empty() || scenario.body.inertia_about == about) return std::nullopt;
  scenario.body.inertia_about = about;
  return scenario;
}
std::optional<Scenario> moments_about_center(const Scene& scene) { return moments_about(scene, InertiaAbout::center_of_mass); }
std::optional<Scenario> moments_about_pivot(const Scene& scene) { return moments_about(scene, InertiaAbout::pivot); }

constexpr Mistake kMistakes[] = {
    {"without the Earth's rotation", without_earth},
    {"in a laboratory that stays at the place of the release", without_journey},
    {"of an Earth that turns the other way (the Coriolis torque has the wrong sign)", wrong_way},
    {"without the Coriolis torque", without_coriolis},
    {"in which the rates at the release, which are relative to the laboratory, were taken as inertial",
     laboratory_taken_as_inertial},
    {"in which the rates at the release, which are inertial, were taken as relative to the laboratory",
     inertial_taken_as_laboratory},
    {"of an Earth that turns once in a solar day (86400 s), and not in a sidereal one", solar_day},
    {"at a latitude in degrees that was taken as radians", latitude_in_radians},
    {"at the opposite latitude, in the other hemisphere", opposite_latitude},
    {"with an azimuth that was counted from East", azimuth_from_east},
    {"with moments of inertia, which are about the pivot, taken as about the centre of mass", moments_about_center},
    {"with moments of inertia, which are about the centre of mass, taken as about the pivot", moments_about_pivot},
};

bool has_angles(const Scene& scene) { return !scene.scenario().release.quaternion_LB && !scene.scenario().release.gimbals; }

constexpr Suspect kSuspects[] = {
    {"gravity", "m/s^2", 0, [](const Scene& scene) { return std::optional(scene.site().gravity_m_s2); },
     [](Scenario& scenario, double value) { scenario.site.gravity_m_s2 = value; }},
    {"the Earth's rate times sin(latitude)", "rad/s", 0,
     [](const Scene& scene) { return scene.rotation_rate_rad_s() != 0 ? std::optional(earth_rate(scene).up) : std::nullopt; },
     [](Scenario& scenario, double value) {
       put_earth_rate(scenario, {earth_rate(Scene(scenario)).north, value});
     }},
    {"the Earth's rate times cos(latitude)", "rad/s", 0,
     [](const Scene& scene) {
       return scene.rotation_rate_rad_s() != 0 ? std::optional(earth_rate(scene).north) : std::nullopt;
     },
     [](Scenario& scenario, double value) {
       put_earth_rate(scenario, {value, earth_rate(Scene(scenario)).up});
     }},
    {"the spin at the release", "rad/s", 0,
     [](const Scene& scene) -> std::optional<double> {
       const ReleaseSpec& release = scene.scenario().release;
       if (release.gimbals) return std::nullopt;
       return release.angular_velocity_body_rad_s ? (*release.angular_velocity_body_rad_s)[2] : release.spin_rad_s;
     },
     [](Scenario& scenario, double value) {
       ReleaseSpec& release = scenario.release;
       (release.angular_velocity_body_rad_s ? (*release.angular_velocity_body_rad_s)[2] : release.spin_rad_s) = value;
     }},
    {"the tilt at the release", "degrees", 1 / kOneDegree,
     [](const Scene& scene) { return has_angles(scene) ? std::optional(scene.scenario().release.tilt_deg) : std::nullopt; },
     [](Scenario& scenario, double value) { scenario.release.tilt_deg = value; }},
    {"the azimuth at the release", "degrees", 1 / kOneDegree,
     [](const Scene& scene) { return has_angles(scene) ? std::optional(scene.scenario().release.azimuth_deg) : std::nullopt; },
     [](Scenario& scenario, double value) { scenario.release.azimuth_deg = value; }},
    {"the moment of inertia about body axis 3", "kg m^2", 0,
     [](const Scene& scene) {
       const BodySpec& body = scene.scenario().body;
       return body.solids.empty() ? std::optional(body.inertia_kg_m2[2][2]) : std::nullopt;
     },
     [](Scenario& scenario, double value) { scenario.body.inertia_kg_m2[2][2] = value; }},
};

}  // namespace

std::span<const Mistake> mistakes() { return kMistakes; }
std::span<const Suspect> suspects() { return kSuspects; }

Scenario resolved_scenario(const Scene& scene) {
  Scenario scenario = scene.scenario();
  scenario.site = scene.site();
  scenario.gravity_anomaly_m_s2 = 0;
  scenario.rotation_rate_rad_s = scene.rotation_rate_rad_s();
  scenario.excess_length_of_day_ms = 0;
  return scenario;
}

}  // namespace earthtop::compare
