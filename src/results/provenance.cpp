// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/results/provenance.hpp"

#include <GeographicLib/Config.h>
#include <erfaextra.h>
#include <fmt/core.h>
#include <gsl/gsl_version.h>
#include <sleef.h>

#include <Eigen/Core>
#include <boost/version.hpp>
#include <nlohmann/json.hpp>

#include "build_info.hpp"
#include "text/sha256.hpp"

namespace earthtop {

const BuildInfo& build_info() {
  static const BuildInfo info = {
      EARTHTOP_VERSION,
      EARTHTOP_COMMIT,
      EARTHTOP_COMPILER,
      EARTHTOP_FLAGS,
      {{"Boost", fmt::format("{}.{}.{}", BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100)},
       {"Eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
       {"GSL", GSL_VERSION},
       {"nlohmann-json",
        fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH)},
       {"fmt", fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)},
       {"GeographicLib", GEOGRAPHICLIB_VERSION_STRING},
       {"ERFA", eraVersion()},
       {"SLEEF", fmt::format("{}.{}.{}", SLEEF_VERSION_MAJOR, SLEEF_VERSION_MINOR, SLEEF_VERSION_PATCHLEVEL)},
       {"libmd", EARTHTOP_LIBMD_VERSION}}};
  return info;
}

std::string scenario_sha256(const Scenario& scenario) { return sha256_hex(identity_json(scenario)); }

std::vector<Constant> constants_used(const Scenario& scenario) {
  const std::string wgs84 = "WGS 84 [NIMA TR8350.2]";
  const std::string given = "scenario";
  const bool default_rate = scenario.rotation_rate_rad_s == kEarthRateWgs84;
  const Site& site = scenario.site;
  const bool default_gravity = site.gravity_m_s2 == normal_gravity(site.latitude_deg, site.height_m);

  std::vector<Constant> constants = {
      {"earth_rotation_rate", scenario.rotation_rate_rad_s, "rad/s", default_rate ? wgs84 : given},
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
