// SPDX-License-Identifier: GPL-3.0-or-later
/// The shipped scenarios, inside the program.
#pragma once

#include <span>
#include <string_view>

namespace earthtop::tool {

struct Example {
  std::string_view name;
  std::string_view text;  ///< the file, byte for byte
};

/// Those of scenarios/, in alphabetical order.
std::span<const Example> examples();
/// Those of scenarios/hard/, which state criteria.
std::span<const Example> hard_cases();

}  // namespace earthtop::tool
