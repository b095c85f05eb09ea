// SPDX-License-Identifier: GPL-3.0-or-later
/// Numbers that a scenario may give in either of two units.
#pragma once

#include <algorithm>
#include <string_view>
#include <vector>

namespace earthtop {

struct TwoUnits {
  std::string_view si, other;  ///< JSON pointers of the two keys
};
inline constexpr TwoUnits kInTwoUnits[] = {{"/release/spin_rad_s", "/release/spin_rpm"},
                                           {"/travel/speed_m_s", "/travel/speed_kn"}};

/// Returns the pointers of the numbers that changes of a scenario replace by one in another unit, as a change of the same key would. If
/// changes give both, both stay, and the decoder refuses them.
/// @param pointer_of  gives the JSON pointer of a change
template <class Changes, class PointerOf>
std::vector<std::string_view> replaced_units(const Changes& changes, const PointerOf& pointer_of) {
  const auto gives = [&](std::string_view pointer) {
    return std::any_of(changes.begin(), changes.end(), [&](const auto& change) { return pointer_of(change) == pointer; });
  };
  std::vector<std::string_view> replaced;
  for (const TwoUnits& number : kInTwoUnits)
    if (gives(number.si) != gives(number.other)) replaced.push_back(gives(number.si) ? number.other : number.si);
  return replaced;
}

}  // namespace earthtop
