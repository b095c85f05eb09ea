// SPDX-License-Identifier: GPL-3.0-or-later
/// The shipped scenarios, by name.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "earthtop/scene/scene.hpp"

namespace earthtop::testing {

/// The files of scenarios/, sorted.
inline std::vector<std::filesystem::path> shipped_files() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(EARTHTOP_SCENARIOS))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

inline Scenario parse_file(const std::filesystem::path& file) { return parse_scenario(read_scenario_source(file.string())); }

}  // namespace earthtop::testing
