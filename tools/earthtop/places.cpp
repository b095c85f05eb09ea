// SPDX-License-Identifier: GPL-3.0-or-later
#include "places.hpp"

#include <fmt/core.h>

#include <filesystem>

#include "earthtop/error.hpp"

namespace earthtop::tool {

std::string place_of(const std::string& path) {
  namespace fs = std::filesystem;
  return fs::weakly_canonical(fs::absolute(path)).string();
}

void require_apart(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs, std::string_view what) {
  for (const std::string& output : outputs)
    for (const std::string& input : inputs) {
      if (output.empty() || input.empty() || input == "-") continue;
      const std::string place = place_of(output), read = place_of(input);
      if (place == read || place.starts_with(read + "/"))
        throw ScenarioError("", fmt::format("{} {}; write to another place", printable(output), what));
    }
}

}  // namespace earthtop::tool
