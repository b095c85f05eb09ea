// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <string_view>

namespace earthtop {

/// Returns the pointer of the spin that changes of a scenario replace by one in another unit, as a change of the same key would;
/// empty where they do not. If changes give both, both stay, and the decoder refuses them.
/// @param pointer_of  gives the JSON pointer of a change
template <class Changes, class PointerOf>
std::string_view replaced_spin(const Changes& changes, const PointerOf& pointer_of) {
  constexpr std::string_view kRadians = "/release/spin_rad_s", kRevolutions = "/release/spin_rpm";
  const auto gives = [&](std::string_view pointer) {
    return std::any_of(changes.begin(), changes.end(), [&](const auto& change) { return pointer_of(change) == pointer; });
  };
  if (gives(kRadians) == gives(kRevolutions)) return {};
  return gives(kRadians) ? kRevolutions : kRadians;
}

}  // namespace earthtop
