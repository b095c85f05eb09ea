// SPDX-License-Identifier: GPL-3.0-or-later
/// The scenarios that are built into the program.
#pragma once

#include <span>
#include <string_view>

namespace earthtop::tool {

struct Example {
  std::string_view name;
  std::string_view text;  ///< contents of the file, unchanged
};

/// The scenarios of scenarios/, in alphabetical order.
std::span<const Example> examples();
/// The scenarios of scenarios/hard/, which state criteria.
std::span<const Example> hard_cases();
/// The studies of scenarios/studies/. Their bases are files of the two above, or are in them.
std::span<const Example> shipped_studies();

}  // namespace earthtop::tool
