// SPDX-License-Identifier: GPL-3.0-or-later
/// Sine and cosine of an angle in degrees.
#pragma once

#include "earthtop/real.hpp"

namespace earthtop {

/// Sine and cosine of an angle in degrees; exact at every multiple of 90 degrees, so that e.g. at a pole the Earth's rotation
/// has no northward component at all.
template <class T>
SinCos<T> sin_cos_degrees(T degrees) {
  T r = real::fmod(degrees, T(360));  // exact
  int quadrant = 0;
  while (r > T(45)) r -= T(90), ++quadrant;
  while (r < T(-45)) r += T(90), --quadrant;
  const T radians = r * real::pi<T>() / T(180);
  const auto [s, c] = real::sin_cos(radians);
  switch (((quadrant % 4) + 4) % 4) {
    case 0: return {s, c};
    case 1: return {c, T(0) - s};
    case 2: return {T(0) - s, T(0) - c};
    default: return {T(0) - c, s};
  }
}

}  // namespace earthtop
