// SPDX-License-Identifier: GPL-3.0-or-later
/// Carlson's symmetric elliptic integrals by duplication, and Legendre's complete integrals from them. Relative errors are a
/// few eps in every scalar type.
///
/// B. C. Carlson, "Numerical computation of real or complex elliptic integrals", Numer. Algorithms 10 (1995) 13; DLMF 19.36.
#pragma once

#include <type_traits>

#include "earthtop/real.hpp"

namespace earthtop::elliptic {

/// eps^(1/8): if the deviations are smaller than this, a series truncated after the seventh order is exact to round-off.
template <class T>
T duplication_tolerance() {
  using real::sqrt;
  static const T tolerance = sqrt(sqrt(sqrt(real::epsilon<T>())));
  return tolerance;
}

template <class T>
T largest(T x, T y) {
  return x > y ? x : y;
}

/// R_C(x, y) = R_F(x, y, y), x >= 0, y > 0.
template <class T>
T carlson_rc(T x, T y) {
  const T tolerance = duplication_tolerance<T>();
  for (;;) {
    const T mean = (x + y + y) / T(3), s = (y - x) / (T(3) * mean);  // s = (y - mean) / mean
    if (real::abs(s) < tolerance) {
      const T series =
          T(3) / T(10) + s * (T(1) / T(7) + s * (T(3) / T(8) + s * (T(9) / T(22) + s * (T(159) / T(208) + s * (T(9) / T(8))))));
      return (T(1) + s * s * series) / real::sqrt(mean);
    }
    const T lambda = T(2) * real::sqrt(x) * real::sqrt(y) + y;
    x = (x + lambda) / T(4);
    y = (y + lambda) / T(4);
  }
}

/// R_F(x, y, z) = 1/2 integral_0^inf dt / sqrt((t + x)(t + y)(t + z)); no argument negative, at most one zero.
///
/// The deviations from the mean shrink exactly fourfold in each step, so that they are divided by the mean only at the end
/// (Carlson 1995, (2.4)). The steps end at deviations below eps^(1/12), because a series to the eleventh order follows:
/// 1/(2N + 1) times the N-th coefficient of (1 + E2 t^2 - E3 t^3)^(-1/2) (DLMF 19.19.7), whose next order is below eps / 20.
template <class T>
T carlson_rf(T x, T y, T z) {
  constexpr T per_tolerance = std::is_same_v<T, float128> ? T(650) : std::is_same_v<T, float80> ? T(39) : T(21);
  T mean = (x + y + z) / T(3), scale = T(1);
  const T dx = mean - x, dy = mean - y;
  const T far = per_tolerance * largest(largest(real::abs(dx), real::abs(dy)), real::abs(dx + dy));
  for (; far * scale >= mean; scale /= T(4)) {
    const T rx = real::sqrt(x), ry = real::sqrt(y), rz = real::sqrt(z);
    const T lambda = rx * (ry + rz) + ry * rz;
    x = (x + lambda) / T(4);
    y = (y + lambda) / T(4);
    z = (z + lambda) / T(4);
    mean = (mean + lambda) / T(4);
  }
  const T shrink = scale / mean, X = dx * shrink, Y = dy * shrink, Z = -(X + Y);
  const T a = X * Y - Z * Z, b = X * Y * Z;  // E2 and E3
  const T even = a * (T(-1) / T(10) + a * (T(1) / T(24) + a * (T(-5) / T(208) + a * (T(35) / T(2176) + a * (T(-3) / T(256))))));
  const T once = T(1) / T(14) + a * (T(-3) / T(44) + a * (T(1) / T(16) + a * (T(-35) / T(608) + a * (T(315) / T(5888)))));
  const T twice = T(3) / T(104) + a * (T(-15) / T(272) + a * (T(5) / T(64)));
  const T thrice = T(5) / T(304) + a * (T(-35) / T(736));
  return (T(1) + (even + b * (once + b * (twice + b * thrice)))) / real::sqrt(mean);
}

/// The series that ends both R_D and R_J (DLMF 19.36.2), without its leading 1.
template <class T>
T third_kind_series(T E2, T E3, T E4, T E5) {
  return -T(3) * E2 / T(14) + E3 / T(6) + T(9) * E2 * E2 / T(88) - T(3) * E4 / T(22) - T(9) * E2 * E3 / T(52) +
         T(3) * E5 / T(26) - E2 * E2 * E2 / T(16) + T(3) * E3 * E3 / T(40) + T(3) * E2 * E4 / T(20) +
         T(45) * E2 * E2 * E3 / T(272) - T(9) * (E3 * E4 + E2 * E5) / T(68);
}

/// R_D(x, y, z) = R_J(x, y, z, z); x, y not negative, at most one of them zero, z > 0.
template <class T>
T carlson_rd(T x, T y, T z) {
  const T tolerance = duplication_tolerance<T>();
  T sum = T(0), factor = T(1);
  for (;;) {
    const T mean = (x + y + T(3) * z) / T(5);
    const T X = (mean - x) / mean, Y = (mean - y) / mean, Z = -(X + Y) / T(3);
    if (largest(largest(real::abs(X), real::abs(Y)), real::abs(Z)) < tolerance) {
      const T XY = X * Y, ZZ = Z * Z;
      const T series = third_kind_series<T>(XY - T(6) * ZZ, (T(3) * XY - T(8) * ZZ) * Z, T(3) * (XY - ZZ) * ZZ, XY * ZZ * Z);
      return T(3) * sum + factor * (T(1) + series) / (mean * real::sqrt(mean));
    }
    const T rx = real::sqrt(x), ry = real::sqrt(y), rz = real::sqrt(z);
    const T lambda = rx * (ry + rz) + ry * rz;
    sum += factor / (rz * (z + lambda));
    factor /= T(4);
    x = (x + lambda) / T(4);
    y = (y + lambda) / T(4);
    z = (z + lambda) / T(4);
  }
}

/// R_J(x, y, z, p) = 3/2 integral_0^inf dt / ((t + p) sqrt((t + x)(t + y)(t + z))); x, y, z not negative, at most one of them
/// zero, p > 0. The steps are those of Carlson's first algorithm (Numer. Math. 33 (1979) 1): its R_C has two positive sums as
/// arguments, whereas the later algorithm adds 1 to a number that may be close to -1.
template <class T>
T carlson_rj(T x, T y, T z, T p) {
  const T tolerance = duplication_tolerance<T>();
  T sum = T(0), factor = T(1);
  for (;;) {
    const T mean = (x + y + z + p + p) / T(5);
    const T X = (mean - x) / mean, Y = (mean - y) / mean, Z = (mean - z) / mean, P = -(X + Y + Z) / T(2);
    if (largest(largest(real::abs(X), real::abs(Y)), largest(real::abs(Z), real::abs(P))) < tolerance) {
      const T XYZ = X * Y * Z, E2 = X * Y + X * Z + Y * Z - T(3) * P * P;
      const T series = third_kind_series<T>(E2, XYZ + T(2) * E2 * P + T(4) * P * P * P,
                                            (T(2) * XYZ + E2 * P + T(3) * P * P * P) * P, XYZ * P * P);
      return T(3) * sum + factor * (T(1) + series) / (mean * real::sqrt(mean));
    }
    const T rx = real::sqrt(x), ry = real::sqrt(y), rz = real::sqrt(z);
    const T lambda = rx * (ry + rz) + ry * rz;
    const T alpha = p * (rx + ry + rz) + rx * ry * rz, beta = p + lambda;
    sum += factor * carlson_rc<T>(alpha * alpha, p * beta * beta);
    factor /= T(4);
    x = (x + lambda) / T(4);
    y = (y + lambda) / T(4);
    z = (z + lambda) / T(4);
    p = (p + lambda) / T(4);
  }
}

/// R_J(x, y, z, p) where y and z are conjugate complex numbers: the same steps, in which only the sum and the product of y and z appear.
/// @param x, p  x >= 0, p > 0   @param re, im  of y, which is no negative number
template <class T>
T carlson_rj_conjugate(T x, T re, T im, T p) {
  const T tolerance = duplication_tolerance<T>();
  T sum = T(0), factor = T(1);
  for (;;) {
    const T mean = (x + re + re + p + p) / T(5);
    const T X = (mean - x) / mean, half = (mean - re) / mean, P = -(X + half + half) / T(2), imaginary = im / mean;
    const T YZ = half * half + imaginary * imaginary;
    if (largest(largest(real::abs(X), real::abs(P)), real::sqrt(YZ)) < tolerance) {
      const T XYZ = X * YZ, E2 = T(2) * X * half + YZ - T(3) * P * P;
      const T series = third_kind_series<T>(E2, XYZ + T(2) * E2 * P + T(4) * P * P * P,
                                            (T(2) * XYZ + E2 * P + T(3) * P * P * P) * P, XYZ * P * P);
      return T(3) * sum + factor * (T(1) + series) / (mean * real::sqrt(mean));
    }
    // |y|, and the sum of the roots of y and z, twice the real part of one: without cancellation where re < 0.
    const T size = real::hypot(re, im), far = real::sqrt(T(2) * (size + real::abs(re)));
    const T roots = re < T(0) ? T(2) * real::abs(im) / far : far;
    const T rx = real::sqrt(x), lambda = rx * roots + size;
    const T alpha = p * (rx + roots) + rx * size, beta = p + lambda;
    sum += factor * carlson_rc<T>(alpha * alpha, p * beta * beta);
    factor /= T(4);
    x = (x + lambda) / T(4);
    re = (re + lambda) / T(4);
    im /= T(4);
    p = (p + lambda) / T(4);
  }
}

/// The complete integrals K, E and Pi (DLMF 19.25.1-2) of the parameter m = 1 - m1, m1 > 0. Pi is given p = 1 - n > 0, the
/// complement of the characteristic n.
template <class T>
T complete_k(T m1) {
  return carlson_rf<T>(T(0), m1, T(1));
}
template <class T>
T complete_e(T m1) {
  if (!(m1 > T(0))) return T(1);
  return m1 * (carlson_rd<T>(T(0), m1, T(1)) + carlson_rd<T>(T(0), T(1), m1)) / T(3);
}
template <class T>
T complete_pi(T m1, T p) {
  return complete_k<T>(m1) + (T(1) - p) * carlson_rj<T>(T(0), m1, T(1), p) / T(3);
}

}  // namespace earthtop::elliptic
