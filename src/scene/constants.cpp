// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/frames/site.hpp"
#include "scene/parts.hpp"

namespace earthtop {

std::vector<Constant> constants_of(const Scene& scene) {
  const std::string wgs84 = "WGS 84 [NIMA TR8350.2]";
  const std::string given = "scenario";
  const bool default_rate = scene.rotation_rate_rad_s() == kEarthRateWgs84;
  const Site& site = scene.site();
  const bool default_gravity = site.gravity_m_s2 == normal_gravity(site.latitude_deg, site.height_m);

  std::vector<Constant> constants = {
      {"earth_rotation_rate", scene.rotation_rate_rad_s(), "rad/s", default_rate ? wgs84 : given},
      {"apparent_gravity", site.gravity_m_s2, "m/s^2",
       default_gravity ? "WGS 84 normal gravity at latitude and height [GeographicLib]" : given}};
  if (default_gravity) {
    constants.push_back({"equatorial_radius", kEquatorialRadiusWgs84, "m", wgs84});
    constants.push_back({"inverse_flattening", kInverseFlatteningWgs84, "1", wgs84});
    constants.push_back({"geocentric_gravitational_constant", kGravitationalConstantWgs84, "m^3/s^2", wgs84});
    if (!default_rate) constants.push_back({"earth_rotation_rate_in_gravity", kEarthRateWgs84, "rad/s", wgs84});
  }
  return constants;
}

}  // namespace earthtop
