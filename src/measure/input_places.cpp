// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/input_places.hpp"

#include <numbers>

namespace earthtop::measure {

std::vector<InputPlace> places_of(const InputRow& input) {
  std::vector<InputPlace> places = {{input.name(), 1}};
  if (!input.of.empty()) places.push_back({input.of, 1});
  if (input.of == "/release/spin_rad_s") {
    places.push_back({"/release/spin_rpm", 30 / std::numbers::pi});
    places.push_back({"/release/angular_velocity_body_rad_s/2", 1});
  }
  if (input.of == "/travel/speed_m_s") places.push_back({"/travel/speed_kn", 3600.0 / 1852});
  return places;
}

}  // namespace earthtop::measure
