// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/closed_form/mean_precession.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "closed_form/complex.hpp"
#include "earthtop/elementary.hpp"

namespace earthtop {
namespace {

/// (du/dt)^2 as a cubic of the distance v from a pole, u = pole (1 - v): the two roots between which v moves, by their mean and the
/// square of half their distance, and the third. Next to a pole, v and (vertical - axial u) are far smaller than what 1 - u^2 and
/// the constants are differences of.
struct Roots {
  double middle, half_squared, third;
  double pole;     ///< 1 or -1
  double at_pole;  ///< vertical - axial u at the pole
};

/// The largest root u, which is at least 1. Newton's method comes down to it from above, where the cubic is convex.
double largest_root(const TopConstants& c) {
  const double square = c.energy + c.axial * c.axial, linear = 2 * c.vertical * c.axial - c.gravity;
  const double constant = c.energy - c.vertical * c.vertical;
  double u = 1 + std::max({std::abs(square), std::abs(linear), std::abs(constant)}) / c.gravity;
  for (int i = 0; i < 200; ++i) {
    const double value = ((c.gravity * u - square) * u + linear) * u + constant;
    const double slope = (3 * c.gravity * u - 2 * square) * u + linear;
    if (!(slope > 0)) break;
    const double next = u - value / slope;
    if (!(next < u)) break;
    u = next;
  }
  return u;
}

std::optional<Roots> roots_of(const TopConstants& c) {
  const double u = largest_root(c);
  if (!std::isfinite(u)) return std::nullopt;
  const double linear = 2 * c.vertical * c.axial - c.gravity, constant = c.energy - c.vertical * c.vertical;
  const double pole = linear / c.gravity + constant / (c.gravity * u) > 0 ? 1 : -1;  // the sign of the other two roots' sum
  const double energy = c.energy - pole * c.gravity, at_pole = c.vertical - pole * c.axial;
  const double cubic = -pole * c.gravity, square = -2 * cubic - energy - c.axial * c.axial;
  const double slope_at_pole = 2 * energy - 2 * pole * c.axial * at_pole;
  double third = 1 - pole * u;
  for (int i = 0; i < 3; ++i) {
    const double value = ((cubic * third + square) * third + slope_at_pole) * third - at_pole * at_pole;
    const double slope = (3 * cubic * third + 2 * square) * third + slope_at_pole;
    const double next = third - value / slope;
    if (!std::isfinite(next) || (next > 0) != (third > 0)) break;
    third = next;
  }
  const double product = at_pole * at_pole / (cubic * third), sum = (slope_at_pole / cubic - product) / third;
  return Roots{sum / 2, sum * sum / 4 - product, third, pole, at_pole};
}

using C = Complex<double>;
C over(const C& a, const C& b) {
  const double size = b.re * b.re + b.im * b.im;
  return {(a.re * b.re + a.im * b.im) / size, (a.im * b.re - a.re * b.im) / size};
}
C root(const C& z) {
  const double size = real::hypot(z.re, z.im), re = std::sqrt((size + std::abs(z.re)) / 2);
  if (!(re > 0)) return {0, 0};
  return z.re >= 0 ? C{re, z.im / (2 * re)} : C{std::abs(z.im) / (2 * re), z.im < 0 ? -re : re};
}

}  // namespace

std::optional<MeanRates> mean_rates(const TopConstants& given) {
  TopConstants c = given;
  if (c.gravity == 0) return std::nullopt;
  if (c.gravity < 0) c.gravity = -c.gravity, c.axial = -c.axial;  // u is then that of the other end of the axis
  const std::optional<Roots> roots = roots_of(c);
  if (!roots) return std::nullopt;
  const double half = std::sqrt(std::abs(roots->half_squared));
  const bool real_roots = roots->half_squared >= 0;
  constexpr int kFewest = 16, kMost = 1 << 14;
  constexpr double kConverged = 1e-13;
  MeanRates before;
  for (int count = kFewest; count <= kMost; count *= 2) {
    double time = 0, azimuth = 0;
    for (int k = 0; k < count; ++k) {
      const double part = half * real::cos(std::numbers::pi * (k + 0.5) / count);
      const C v = real_roots ? C{roots->middle + part, 0} : C{roots->middle, part};
      const double gravity = roots->pole * c.gravity, axial = roots->pole * c.axial;
      const C dt = over({1, 0}, root({gravity * (v.re - roots->third), gravity * v.im}));
      const C sine_squared = {2 * v.re - (v.re * v.re - v.im * v.im), 2 * v.im * (1 - v.re)};
      time += dt.re;
      azimuth += (over({roots->at_pole + axial * v.re, axial * v.im}, sine_squared) * dt).re;
    }
    if (!std::isfinite(time) || !(time > 0) || !std::isfinite(azimuth)) return std::nullopt;
    const MeanRates rates{azimuth / time, count / time, count};
    if (count > kFewest && std::abs(rates.precession_rad_s - before.precession_rad_s) <= kConverged * rates.nutation_rad_s &&
        std::abs(rates.nutation_rad_s - before.nutation_rad_s) <= kConverged * rates.nutation_rad_s)
      return rates;
    before = rates;
  }
  return std::nullopt;
}

}  // namespace earthtop
