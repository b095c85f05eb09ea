// SPDX-License-Identifier: GPL-3.0-or-later
/// The unit of a quantity, taken from the ending of its name: "drift.axis_final_rad" -> "rad". All names of the program that
/// have a unit end with it.
#pragma once

#include <string_view>
#include <utility>

namespace earthtop {

/// @returns the unit as it is printed; empty for a pure number
inline std::string_view unit_of_name(std::string_view name) {
  using Ending = std::pair<std::string_view, std::string_view>;
  for (const auto& [ending, unit] :
       {Ending("_rad_s", "rad/s"), Ending("_m_s2", "m/s^2"), Ending("_kg_m2_s", "kg m^2/s"), Ending("_kg_m2", "kg m^2"),
        Ending("_m_s", "m/s"), Ending("_1_s", "1/s"), Ending("_N_m", "N m"), Ending("_rad", "rad"), Ending("_deg", "deg"),
        Ending("_kg", "kg"), Ending("_J", "J"), Ending("_s", "s"), Ending("_m", "m"), Ending("_hz", "Hz")})
    if (name.ends_with(ending)) return unit;
  return "";
}

}  // namespace earthtop
