// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/known_rate.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "earthtop/frames/earth.hpp"
#include "earthtop/scenario/inputs.hpp"

namespace earthtop::measure {
namespace {

constexpr double kRelativeErrorOfEarthRate = 1e-8;
constexpr double kStillTheEarth = 1e-6;  // a rate that differs by more from the Earth's is another one

/// The standard error that the scenario states; 0 where it states none. @param input  one of kInputNames
double stated(const Scene& scene, std::string_view input) {
  const auto& uncertainty = scene.scenario().uncertainty;
  return uncertainty ? (*uncertainty)[static_cast<std::size_t>(std::ranges::find(kInputNames, input) - kInputNames.begin())]
                     : 0;
}

bool is_earths(const Scene& scene) {
  return std::abs(std::abs(scene.rotation_rate_rad_s()) - kEarthRateWgs84) <= kStillTheEarth * kEarthRateWgs84;
}

double error_of_whole_rate(const Scene& scene) {
  if (const double error = stated(scene, "rotation_rate_rad_s"); error > 0) return error;
  return is_earths(scene) ? kRelativeErrorOfEarthRate * std::abs(scene.rotation_rate_rad_s()) : 0;
}

}  // namespace

std::optional<KnownRate> known_rate(const Scene& scene, const EstimatedInput& input) {
  const double of_rate = error_of_whole_rate(scene);
  if (input.pointer == "/earth/rotation_rate_rad_s") return KnownRate{input.start, of_rate, is_earths(scene)};
  if (input.combined != CombinedInput::vertical_rate && input.combined != CombinedInput::northward_rate) return std::nullopt;
  const Vec3<double> axis_L = celestial_axis_L<double>(scene.site());
  const bool is_vertical = input.combined == CombinedInput::vertical_rate;
  // sin(latitude) grows with the latitude by cos(latitude), and cos(latitude) falls by sin(latitude).
  const double share = is_vertical ? axis_L[2] : axis_L[1], slope = is_vertical ? axis_L[1] : axis_L[2];
  const double of_latitude = stated(scene, "latitude_deg") * (std::numbers::pi / 180);
  const double by_latitude = scene.rotation_rate_rad_s() * slope * of_latitude, by_rate = share * of_rate;
  return KnownRate{input.start, std::sqrt(by_latitude * by_latitude + by_rate * by_rate), is_earths(scene)};
}

}  // namespace earthtop::measure
