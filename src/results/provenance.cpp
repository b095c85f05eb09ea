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

}  // namespace earthtop
