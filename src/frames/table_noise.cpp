// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "earthtop/elementary.hpp"
#include "earthtop/frames/site.hpp"
#include "earthtop/frames/travel_spec.hpp"

namespace earthtop {

std::array<double, 3> metres_a_unit(const TravelSpec& spec) {
  const double radius = spec.figure == TravelFigure::sphere ? spec.radius_m : kEquatorialRadiusWgs84;
  const double metres_a_degree = radius * std::numbers::pi / 180;
  return {metres_a_degree, metres_a_degree * real::cos(spec.table[0].rows->value.front() * std::numbers::pi / 180), 1};
}

double noise_of_table_m_s2(const TravelSpec& spec) {
  if (!spec.table[0].rows) return 0;
  const std::vector<double>& t = spec.table[0].rows->t_s;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < t.size(); ++i) nearest = std::min(nearest, t[i] - t[i - 1]);
  const std::array<double, 3> metres = metres_a_unit(spec);
  std::array<double, 3> sigma_m{};
  for (std::size_t i = 0; i < metres.size(); ++i) {
    const AngleTable& column = *spec.table[i].rows;
    const bool changes = std::ranges::any_of(column.value, [&](double x) { return x != column.value.front(); });
    if (changes) sigma_m[i] = column.last_digit * metres[i];
  }
  return 6 * real::hypot(sigma_m[0], sigma_m[1], sigma_m[2]) / (nearest * nearest);
}

}  // namespace earthtop
