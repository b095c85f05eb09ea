// SPDX-License-Identifier: GPL-3.0-or-later
#include "places.hpp"

#include <filesystem>

namespace earthtop::tool {

std::vector<std::string> files_of(const std::string& file, const Scenario& scenario) {
  std::vector<std::string> files = {file};
  if (scenario.platform && !scenario.platform->file.empty())
    files.push_back((std::filesystem::path(file).parent_path() / scenario.platform->file).string());
  return files;
}

}  // namespace earthtop::tool
