// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/closed_form/mean_precession.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "earthtop/elementary.hpp"

namespace earthtop {
namespace {

using Q = float128;
using L = float80;
using Constants = BasicTopConstants<Q>;

/// The motion seen from the pole next to it, u = pole (1 - v): (dv/dt)^2 = steepness (v - least)(greatest - v)(v - third) .
template <class T>
struct Way {
  T least, width;       ///< v lies between `least` and `least + width`
  T far_least;          ///< least distance from the other pole
  T third;              ///< the third root
  T steepness;          ///< gravity x pole
  T at_pole, at_other;  ///< vertical - axial u at the two poles
  T near, far;          ///< slowness(v) at the poles: the third root may be next to one
  T slowness(T v) const { return T(1) / real::sqrt(steepness * (v - third)); }
};

Way<L> narrowed(const Way<Q>& w) {
  const auto to = [](Q x) { return static_cast<L>(x); };
  return {to(w.least),   to(w.width),    to(w.far_least), to(w.third), to(w.steepness),
          to(w.at_pole), to(w.at_other), to(w.near),      to(w.far)};
}

/// Sums over half a period in equal steps of the phase: of the time, and of the azimuth less half a turn for each pole.
template <class T>
struct Sums {
  T time = T(0), beside = T(0);
};
template <class T>
Sums<T> sums(const Way<T>& way, int count) {
  const T of_near = way.at_pole * way.near * way.near, of_far = way.at_other * way.far * way.far;
  Sums<T> all;
  for (int k = 0; k < count; ++k) {
    const T sine = real::sin(real::pi<T>() * (T(k) + T(0.5)) / T(2 * count));
    const T g = way.slowness(way.least + way.width * sine * sine);
    all.time += g;
    all.beside += way.steepness * g * g * (of_far / (g + way.far) - of_near / (g + way.near)) / T(2);
  }
  return all;
}

/// The largest root u, which is at least 1. Newton's method comes down to it from above, where the cubic is convex.
Q largest_root(const Constants& c) {
  const Q energy = c.energy(), vertical = c.vertical();
  const Q square = energy + c.axial * c.axial, linear = Q(2) * vertical * c.axial - c.gravity;
  const Q constant = energy - vertical * vertical;
  Q u = Q(1) + std::max({real::abs(square), real::abs(linear), real::abs(constant)}) / c.gravity;
  for (int i = 0; i < 400; ++i) {
    const Q value = ((c.gravity * u - square) * u + linear) * u + constant;
    const Q slope = (Q(3) * c.gravity * u - Q(2) * square) * u + linear;
    if (!(slope > Q(0))) break;
    const Q next = u - value / slope;
    if (!(next < u)) break;
    u = next;
  }
  return u;
}

std::optional<Way<Q>> way_of(const Constants& c) {
  const Q u = largest_root(c), vertical = c.vertical();
  if (!real::isfinite(u)) return std::nullopt;
  const Q linear = Q(2) * vertical * c.axial - c.gravity, constant = c.energy() - vertical * vertical;
  const bool is_up = linear / c.gravity + constant / (c.gravity * u) > Q(0);  // the sign of the other two roots' sum
  const Q pole = is_up ? Q(1) : Q(-1);
  const Constants::Pole &near = is_up ? c.up : c.down, &other = is_up ? c.down : c.up;
  const Q cubic = -pole * c.gravity, square = -Q(2) * cubic - near.energy - c.axial * c.axial;
  const Q slope_at_pole = Q(2) * near.energy - Q(2) * pole * c.axial * near.vertical;
  Q third = Q(1) - pole * u;
  for (int i = 0; i < 3; ++i) {
    const Q value = ((cubic * third + square) * third + slope_at_pole) * third - near.vertical * near.vertical;
    const Q slope = (Q(3) * cubic * third + Q(2) * square) * third + slope_at_pole;
    const Q next = third - value / slope;
    if (!real::isfinite(next) || (next > Q(0)) != (third > Q(0))) break;
    third = next;
  }
  // The cubic's values at the poles are the squares of the angular momenta there.
  const Q product = near.vertical * near.vertical / (cubic * third), sum = (slope_at_pole / cubic - product) / third;
  const Q half = real::sqrt(std::max(Q(0), sum * sum / Q(4) - product)), greatest = sum / Q(2) + half;
  const Q least = product / greatest;
  const Q far_least = other.vertical * other.vertical / (cubic * (third - Q(2))) / (Q(2) - least);
  return Way<Q>{least,
                Q(2) * half,
                far_least,
                third,
                -cubic,
                near.vertical,
                other.vertical,
                Q(1) / real::sqrt(cubic * third),
                Q(1) / real::sqrt(cubic * (third - Q(2)))};
}

/// The mean rates from sums in this arithmetic, which doubles their number until they converge.
/// @returns nothing where a period is infinite
template <class T>
std::optional<MeanRates> rates_along(const Way<T>& way) {
  // Passing a pole turns the azimuth by half a turn, to the side that the angular momentum there says.
  const auto half_turn = [](T momentum) { return momentum > T(0) ? T(0.5) : T(-0.5); };
  const T turns = half_turn(way.at_pole) + half_turn(way.at_other);
  const auto resolving = [&](T distance) {  // exp(-30) is then left of the peak there
    return 15 * real::sqrt(static_cast<double>((distance + way.width) / distance));
  };
  // Near a separatrix the third root is a small distance from where the axis turns.
  const T nearest = std::min(real::abs(way.third - way.least), real::abs(way.third - way.least - way.width));
  const double magnified = std::max(1.0, static_cast<double>((way.least + way.width) / nearest));
  constexpr int kFewest = 16, kMost = 1 << 14;
  constexpr double kRoundings = 64, kUnit = real::epsilon<double>();
  MeanRates rates;
  for (int count = kFewest; count <= kMost; count *= 2) {
    const Sums<T> all = sums(way, count);
    if (!real::isfinite(all.time) || !(all.time > T(0)) || !real::isfinite(all.beside)) return std::nullopt;
    const MeanRates before = rates;
    const T nutation = T(count) / all.time;
    rates.nutation_rad_s = static_cast<double>(nutation);
    rates.precession_rad_s = static_cast<double>(turns * nutation + all.beside / all.time);
    rates.parts = std::max({double(count), resolving(way.least), resolving(way.far_least)});
    const double rounding = kRoundings * magnified * static_cast<double>(real::epsilon<T>()) * rates.nutation_rad_s +
                            kUnit * std::abs(rates.precession_rad_s);
    const double change = std::abs(rates.precession_rad_s - before.precession_rad_s);
    rates.precession_bound_rad_s = change + rounding;
    // The error falls as the square of what one doubling changes.
    constexpr double kConverged = 1e-9;
    if (count > kFewest && change <= kConverged * rates.nutation_rad_s &&
        std::abs(rates.nutation_rad_s - before.nutation_rad_s) <= kConverged * rates.nutation_rad_s) {
      const double squared = change / rates.nutation_rad_s * change;
      rates.precession_bound_rad_s = rounding + squared;
      if (squared <= rounding) return rates;
    }
  }
  return rates;
}

}  // namespace

std::optional<MeanRates> mean_rates(const BasicTopConstants<float128>& given) {
  Constants c = given;
  if (c.gravity == Q(0)) return std::nullopt;
  if (c.gravity < Q(0)) {  // u is then that of the other end of the axis
    c.gravity = -c.gravity, c.axial = -c.axial;
    std::swap(c.up, c.down);
  }
  if (c.up.vertical == Q(0) || c.down.vertical == Q(0)) return std::nullopt;
  const std::optional<Way<Q>> way = way_of(c);
  if (!way) return std::nullopt;
  std::optional<MeanRates> rates = rates_along(narrowed(*way));
  constexpr double kExact = 4 * real::epsilon<double>(), kKnown = 0.01;
  const auto within = [&](double part) { return rates->precession_bound_rad_s <= part * std::abs(rates->precession_rad_s); };
  // The precession of a fast top is far smaller than the nutation, of which it is the rest.
  if (rates && !within(kExact) && rates->parts < 1 << 10) rates = rates_along(*way);
  if (!rates || !within(kKnown)) return std::nullopt;
  return rates;
}

std::optional<MeanRates> mean_rates(const TopConstants& c) {
  return mean_rates(BasicTopConstants<float128>{
      Q(c.axial), Q(c.gravity), {Q(c.up.energy), Q(c.up.vertical)}, {Q(c.down.energy), Q(c.down.vertical)}});
}

}  // namespace earthtop
