// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/plausibility.hpp"

#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "earthtop/model/body.hpp"
#include "scene/support_laws.hpp"
#include "text/number_words.hpp"

namespace earthtop {
namespace {

using input::Section;

constexpr double kDegree = std::numbers::pi / 180;

/// Returns whether a value is a round number of degrees written in radians, e.g. 0.7853982 for 45.
bool is_round_in_radians(double value) {
  const double degrees = value / kDegree;
  return std::abs(degrees) > 0.5 && std::abs(degrees - std::round(degrees)) < 1e-5 * std::abs(degrees);
}

void warn_of_radians(const Section& section, std::string_view key, double most) {
  const auto value = section.has(key) ? section.number(key) : std::nullopt;
  if (!value || std::abs(*value) > most) return;
  if (is_round_in_radians(*value))
    section.warn(key, fmt::format("{} is {:.6g} degrees in radians; the unit here is degrees", *value, *value / kDegree));
  else if (key == "latitude_deg" && *value != 0 && std::abs(*value) < std::numbers::pi / 2)
    section.warn(
        key, fmt::format("{} degrees is close to the equator; if these are radians, write {:.6g}", *value, *value / kDegree));
}

bool is_earth(double rotation_rate_rad_s) { return std::abs(std::abs(rotation_rate_rad_s) / kEarthRateWgs84 - 1) < 0.01; }

void warn_of_site(const Section& root, const Scene& scene, bool has_weight) {
  const Section site = root.section("site"), earth = root.section("earth");
  warn_of_radians(site, "latitude_deg", std::numbers::pi / 2);
  for (const auto& [unit, factor] :
       {std::pair("degrees per hour", 3600 / kDegree), std::pair("degrees per second", 1 / kDegree)})
    if (earth.has("rotation_rate_rad_s") && is_earth(scene.rotation_rate_rad_s() / factor))
      earth.warn("rotation_rate_rad_s", fmt::format("is the Earth's rate in {}; in rad/s it is 7.292115e-5", unit));
  const auto gravity = site.has("gravity_m_s2") ? site.number("gravity_m_s2") : std::nullopt;
  const auto height = site.number("height_m");
  if (!gravity || *gravity == 0 || !height || !has_weight || !is_earth(scene.rotation_rate_rad_s())) return;
  // The least and largest gravity at sea level, with anomalies, are reduced to the height as normal gravity is.
  const double decrease = normal_gravity(45, 0) - normal_gravity(45, *height);
  const double least = 9.76 - decrease, most = 9.84 - decrease;
  if (*gravity < least || *gravity > most)
    site.warn("gravity_m_s2",
              fmt::format("{} m/s^2 is not found on the Earth at this height, where it is between {} and {}; leave it out "
                          "for normal gravity",
                          *gravity, least_text(least, 4), most_text(most, 4)));
}

/// Warns of grams or millimetres in place of SI units, which show as an impossible density or distance from the pivot.
void warn_of_body(const Section& section, const Scene& scene, double spin_rad_s, bool in_rpm) {
  const BodySpec& spec = scene.scenario().body;
  const Body<double>& body = scene.body<double>();
  const double arm = norm(body.p_PBcm_B);
  const double radius = std::sqrt(std::max(0.0, body.I_BBcm_B().trace() / 2 / body.mass));  // radius of gyration (m)
  const std::string_view place = section.has("solids") ? "solids" : "inertia";
  constexpr double kPointBob = 1e-3;  // below this share of the arm the body is taken as a point, with no density
  if (!std::isfinite(radius)) return;
  if (radius > kPointBob * arm) {
    // A ball has the least density of all bodies with this mass and radius of gyration; its radius is 1.3 times the latter. The
    // densest metal has 2.26e4 kg/m^3; a metre of thin wire comes out at 0.1.
    const double wide = 1.3 * radius, density = body.mass / (4.0 / 3.0 * std::numbers::pi * wide * wide * wide);
    if (density > 2.5e4)
      section.warn(place, fmt::format("{:.3g} kg with a radius of gyration of {:.3g} m is denser than any matter (about {:.1g} "
                                      "kg/m^3); are these grams, or another unit than kg m^2?",
                                      body.mass, radius, density));
    else if (density < 0.01)
      section.warn(place, fmt::format("{:.3g} kg with a radius of gyration of {:.3g} m is thinner than air (about {:.1g} "
                                      "kg/m^3); are these millimetres, or another unit than kg m^2?",
                                      body.mass, radius, density));
  }
  // Only a pendulum, which has no spin, may be long. Where mass and moments are in grams and millimetres too, the body looks like a
  // large one; what tells is that a large body does not spin far out on a lever, many times faster than it would swing.
  constexpr double kLongLever = 20, kFaster = 10;
  const double swing = std::sqrt(scene.site().gravity_m_s2 / std::max(arm, 1e-300));  // of a point at the end of the lever
  const bool is_small = radius < 0.05 && (arm > 10 || (arm > 1 && spin_rad_s != 0));
  const bool spins_far_out = arm > 1 && arm > kLongLever * radius && std::abs(spin_rad_s) > kFaster * swing;
  if (is_small || spins_far_out)
    section.warn(section.has("solids") ? "solids" : "center_of_mass_m",
                 fmt::format("the centre of mass is {:.3g} m from the pivot, {:.3g} times the radius of gyration; are these "
                             "millimetres?",
                             arm, arm / radius));
  for (std::size_t i = 0; i < spec.solids.size(); ++i) {
    const auto density = spec.solids[i].density_kg_m3;
    if (density && *density < 25)
      section.element("solids", i)
          .warn("density_kg_m3",
                fmt::format("{} kg/m^3 is the density of a foam; are these g/cm^3 (write {})?", *density, *density * 1000));
  }
  constexpr double kFastestRim = 2000;  // m/s: carbon fibre bursts below this
  if (std::abs(spin_rad_s) * radius > kFastestRim)
    section.warn(place, fmt::format("at {:.4g} rad/s its rim would move at about {:.2g} m/s and burst{}", spin_rad_s,
                                    std::abs(spin_rad_s) * radius,
                                    in_rpm ? ""
                                           : fmt::format("; is the spin in revolutions per minute (then it is {:.4g} rad/s)?",
                                                         spin_rad_s * std::numbers::pi / 30)));
}

}  // namespace

void warn_of_implausible(const Section& root, const Scene& scene) {
  const BodySpec& body = scene.scenario().body;
  const ReleaseSpec& given = scene.scenario().release;
  const bool has_body = body.mass_kg > 0 || !body.solids.empty();
  warn_of_site(root, scene, has_body && norm(scene.body<double>().p_PBcm_B) > 0);
  const Section release = root.section("release");
  for (const std::string_view key : {"tilt_deg", "azimuth_deg", "spin_angle_deg"})
    warn_of_radians(release, key, 2 * std::numbers::pi);
  const auto& rates = given.angular_velocity_body_rad_s;
  const double spin = rates ? real::hypot((*rates)[0], (*rates)[1], (*rates)[2]) : given.spin_rad_s;
  if (has_body) warn_of_body(root.section("body"), scene, spin, release.has("spin_rpm"));
  if (has_body) laws_of(scene).warn(root, scene);
}

}  // namespace earthtop
