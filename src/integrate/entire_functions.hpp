// SPDX-License-Identifier: GPL-3.0-or-later
/// cos(x) and sin(x)/x as functions of z = x^2. As such they are entire functions: a rotation by a vector v needs z = v.v, no
/// square root and no division, and small angles keep their digits.
#pragma once

#include <cmath>

#include "earthtop/elementary.hpp"

namespace earthtop {

namespace entire {

/// c0 + c1 z + ... + c9 z^9, summed in pairs, which has a third of the latency of Horner's scheme.
inline double polynomial9(double z, const double (&c)[10]) {
  const double z2 = z * z, z4 = z2 * z2;
  const double low = (c[0] + c[1] * z) + z2 * (c[2] + c[3] * z);
  const double middle = (c[4] + c[5] * z) + z2 * (c[6] + c[7] * z);
  return low + z4 * (middle + z4 * (c[8] + c[9] * z));
}

/// Up to this z the first term that each series leaves out is below 1e-18.
constexpr double kSeriesLimit = 1;

/// cos(sqrt(z)), z >= 0: sum of (-z)^k / (2 k)!
inline double cosine(double z) {
  constexpr double c[10] = {1.0,
                            -1.0 / 2,
                            1.0 / 24,
                            -1.0 / 720,
                            1.0 / 40320,
                            -1.0 / 3628800,
                            1.0 / 479001600,
                            -1.0 / 87178291200,
                            1.0 / 20922789888000,
                            -1.0 / 6402373705728000};
  if (z <= kSeriesLimit) return polynomial9(z, c);
  return real::cos(std::sqrt(z));
}

/// sin(sqrt(z)) / sqrt(z), z >= 0: sum of (-z)^k / (2 k + 1)!
inline double sinc(double z) {
  constexpr double c[10] = {1.0,
                            -1.0 / 6,
                            1.0 / 120,
                            -1.0 / 5040,
                            1.0 / 362880,
                            -1.0 / 39916800,
                            1.0 / 6227020800,
                            -1.0 / 1307674368000,
                            1.0 / 355687428096000,
                            -1.0 / 121645100408832000};
  if (z <= kSeriesLimit) return polynomial9(z, c);
  const double x = std::sqrt(z);
  return real::sin(x) / x;
}

/// The derivative of `sinc` with respect to z: sum of (-1)^k k z^(k-1) / (2 k + 1)!
inline double sinc_slope(double z) {
  constexpr double c[10] = {-1.0 / 6,
                            2.0 / 120,
                            -3.0 / 5040,
                            4.0 / 362880,
                            -5.0 / 39916800,
                            6.0 / 6227020800,
                            -7.0 / 1307674368000,
                            8.0 / 355687428096000,
                            -9.0 / 121645100408832000,
                            0.0};
  if (z <= kSeriesLimit) return polynomial9(z, c);
  return (cosine(z) - sinc(z)) / (2 * z);
}

}  // namespace entire

}  // namespace earthtop
