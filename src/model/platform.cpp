// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/model/platform.hpp"

#include <stdexcept>

#include "earthtop/frames/earth.hpp"

namespace earthtop {

template <class T>
Platform<T> make_platform(const PlatformSpec& spec, const Journey<T>& journey) {
  Platform<T> platform;
  for (int i = 0; i < 3; ++i) {
    platform.turn.axis[i] = T(spec.axis[static_cast<std::size_t>(i)]);
    platform.pivot_offset_P[i] = T(spec.pivot_offset_m[static_cast<std::size_t>(i)]);
  }
  platform.turn.axis /= norm(platform.turn.axis);
  switch (spec.motion) {
    case PlatformMotion::constant: platform.turn.rate = T(spec.rate_rad_s); break;
    case PlatformMotion::ramp:
      platform.turn.rate = T(spec.rate_rad_s);
      platform.turn.acceleration = T(spec.acceleration_rad_s2);
      break;
    case PlatformMotion::harmonic:
      platform.turn.amplitude = T(spec.amplitude_rad);
      platform.turn.frequency = T(spec.frequency_hz);
      platform.turn.phase = T(spec.phase_deg) * real::pi<T>() / T(180);
      break;
    case PlatformMotion::table:
      if (!spec.table.rows) throw std::invalid_argument("platform motion \"table\": there is no table");
      platform.turn.table = std::make_shared<const AngleSpline<T>>(*spec.table.rows);
      break;
    case PlatformMotion::course:
      if (journey.empty()) throw std::invalid_argument("platform motion \"course\": there is no journey");
      platform.turn.journey = std::make_shared<const Journey<T>>(journey);
      break;
  }
  return platform;
}
template Platform<double> make_platform(const PlatformSpec&, const Journey<double>&);
template Platform<float80> make_platform(const PlatformSpec&, const Journey<float80>&);
template Platform<float128> make_platform(const PlatformSpec&, const Journey<float128>&);

}  // namespace earthtop
