// SPDX-License-Identifier: GPL-3.0-or-later
#include "places.hpp"

#include <filesystem>

namespace earthtop::tool {

std::vector<std::string> files_of(const std::string& file, const Scenario& scenario) {
  std::vector<std::string> files = {file};
  for (const FiledTable* table : tables_of(scenario))
    files.push_back((std::filesystem::path(file).parent_path() / table->file).string());
  return files;
}

}  // namespace earthtop::tool
