// SPDX-License-Identifier: GPL-3.0-or-later
/// Where a result comes from: the program and its build, the libraries, the constants, the identity of the scenario.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "earthtop/scene/scene.hpp"

namespace earthtop {

/// The program's version, its source, and how it was built.
struct BuildInfo {
  std::string version;
  std::string commit;  ///< commit of the source at configuration, with "-dirty" if it was changed; "unknown" outside git
  std::string compiler;
  std::string flags;
  std::vector<std::pair<std::string, std::string>> libraries;  ///< name and version of the headers
};
const BuildInfo& build_info();

/// The constants that a result of the scene depends on.
inline const std::vector<Constant>& constants_used(const Scene& scene) { return scene.constants(); }

}  // namespace earthtop
