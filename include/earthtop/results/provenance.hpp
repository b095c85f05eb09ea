// SPDX-License-Identifier: GPL-3.0-or-later
/// Where a result comes from: the program and its build, the libraries, the constants, the identity of the scenario.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "earthtop/scene/scene.hpp"

namespace earthtop {

/// What was built, from what, and how.
struct BuildInfo {
  std::string version;
  std::string commit;  ///< of the source when it was configured, "-dirty" if it was changed; "unknown" outside git
  std::string compiler;
  std::string flags;
  std::vector<std::pair<std::string, std::string>> libraries;  ///< name, version of the headers
};
const BuildInfo& build_info();

/// A number that the result depends on.
struct Constant {
  std::string name;
  double value = 0;
  std::string unit;
  std::string source;
};

/// The Earth's rate and the apparent gravity, given or by default; the WGS 84 ellipsoid where that default was taken.
std::vector<Constant> constants_used(const Scene& scene);

}  // namespace earthtop
