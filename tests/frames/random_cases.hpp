// SPDX-License-Identifier: GPL-3.0-or-later
/// Random cases that are the same on every platform, and comparisons that can print every scalar type.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <random>

#include "earthtop/frames/prescribed_motion.hpp"

namespace earthtop::test {

/// Random numbers from a fixed seed, which failing tests print. The mapping to doubles is written here, because the standard's
/// distributions differ between libraries.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {
    std::printf("[   seed   ] %llu\n", static_cast<unsigned long long>(seed));
  }
  /// A number in [low, high) with 53 random bits.
  double uniform(double low, double high) { return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53); }
  int integer(int low, int high) { return low + static_cast<int>(engine_() % static_cast<std::uint64_t>(high - low + 1)); }
  /// A vector with components in [-size, size).
  template <class T>
  Vec3<T> vector(double size = 1) {
    Vec3<T> v;
    for (int i = 0; i < 3; ++i) v[i] = T(uniform(-size, size));  // one statement each: the order of arguments is not fixed
    return v;
  }
  template <class T>
  Vec3<T> unit() {
    while (true) {
      const Vec3<T> v = vector<T>();
      const T n = norm(v);
      if (n > T(0.1)) return v / n;
    }
  }
  /// A random rotation; a `norm_of_q` other than 1 tests that the quaternion's norm does not affect the result.
  template <class T>
  Quaternion<T> quaternion(double norm_of_q = 1) {
    const Vec3<T> axis = unit<T>();
    const T half = T(uniform(-3, 3));
    return {T(norm_of_q) * real::cos(half), (T(norm_of_q) * real::sin(half)) * axis};
  }
  template <class T>
  Mat3<T> general_matrix(double size = 1) {
    Mat3<T> m;
    for (int i = 0; i < 3; ++i) m.row(i) = vector<T>(size).transpose();
    return m;
  }

 private:
  std::mt19937_64 engine_;
};

/// A turn about a random axis with all terms: angle, rate, ramp and harmonic.
template <class T>
PrescribedMotion<T> random_motion(Random& random) {
  PrescribedMotion<T> m;
  m.axis = random.unit<T>();
  m.angle0 = T(random.uniform(-3, 3));
  m.rate = T(random.uniform(-2, 2));
  m.acceleration = T(random.uniform(-2, 2));
  m.amplitude = T(random.uniform(0.1, 0.5));
  m.frequency = T(random.uniform(0.1, 0.5));
  m.phase = T(random.uniform(-3, 3));
  return m;
}
/// A W such that the n-th derivative of the attitude stays below W^n for |t| <= 1; for composed motions, add their bounds.
template <class T>
T derivative_bound(const PrescribedMotion<T>& m) {
  const T pulsation = T(2) * real::pi<T>() * m.frequency;
  return real::abs(m.rate) + real::abs(m.acceleration) + real::sqrt(real::abs(m.acceleration)) +
         pulsation * (T(1) + real::abs(m.amplitude));
}

/// Runs a check in every scalar type. A constant or function that is only exact to double precision shows in 113 bits, so long
/// double adds little and costs a third of the compile time: it is checked with the slow tests only.
template <class Check>
void for_each_scalar(const Check& check) {
  check(double{});
#ifdef EARTHTOP_EVERY_SCALAR
  check(static_cast<long double>(0));
#endif
  check(float128{});
}

template <class T>
::testing::AssertionResult at_most(T error, T bound) {
  if (error <= bound) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << static_cast<double>(error) << " is not at most " << static_cast<double>(bound);
}

template <class T>
::testing::AssertionResult close(T a, T b, T bound) {
  return at_most(real::abs(a - b), bound) << " (" << static_cast<double>(a) << " against " << static_cast<double>(b) << ")";
}

/// Compares two matrices of `rows` x `columns` numbers, stored by columns. It is compiled once for every scalar type, not for
/// every expression.
template <class T>
::testing::AssertionResult numbers_are_close(const T* a, const T* b, int rows, int columns, T bound) {
  for (int k = 0; k < rows * columns; ++k)
    if (!(real::abs(a[k] - b[k]) <= bound))
      return ::testing::AssertionFailure() << "component " << k % rows << "," << k / rows << ": " << static_cast<double>(a[k])
                                           << " against " << static_cast<double>(b[k]) << ", bound "
                                           << static_cast<double>(bound);
  return ::testing::AssertionSuccess();
}

/// Checks that every component of a is within `bound` of b; a NaN is never close.
template <class T, class A, class B>
::testing::AssertionResult close(const Eigen::MatrixBase<A>& a_expression, const Eigen::MatrixBase<B>& b_expression, T bound) {
  static_assert(int{A::RowsAtCompileTime} == int{B::RowsAtCompileTime} &&
                int{A::ColsAtCompileTime} == int{B::ColsAtCompileTime});
  const Eigen::Matrix<T, A::RowsAtCompileTime, A::ColsAtCompileTime> a = a_expression, b = b_expression;
  return numbers_are_close<T>(a.data(), b.data(), static_cast<int>(a.rows()), static_cast<int>(a.cols()), bound);
}

/// Checks that all numbers are exactly the same, apart from a zero's sign. (gtest's EXPECT_EQ cannot print matrices of
/// float128.)
template <class A, class B>
::testing::AssertionResult identical(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b) {
  return close<typename A::Scalar>(a, b, typename A::Scalar(0));
}

/// Rodrigues' formula exp([n]x angle) for a unit vector n, as a reference for all that is built on quaternions.
template <class T>
Mat3<T> rodrigues(const Vec3<T>& n, T angle) {
  const T c = real::cos(angle), s = real::sin(angle);
  const T half_sine = real::sin(angle / T(2));
  const T one_less_c = T(2) * half_sine * half_sine;
  Mat3<T> R;
  R << c + one_less_c * n[0] * n[0], one_less_c * n[0] * n[1] - s * n[2], one_less_c * n[0] * n[2] + s * n[1],
      one_less_c * n[1] * n[0] + s * n[2], c + one_less_c * n[1] * n[1], one_less_c * n[1] * n[2] - s * n[0],
      one_less_c * n[2] * n[0] - s * n[1], one_less_c * n[2] * n[1] + s * n[0], c + one_less_c * n[2] * n[2];
  return R;
}

/// First and second derivative of f at t: central differences at h, h/2, h/4, extrapolated twice (Richardson). For an f whose
/// n-th derivative is below W^n the error is at most W (W h)^6 and W^2 (W h)^6 times the size of f. f returns anything that can
/// be added and scaled.
template <class T, class F>
auto first_derivative(const F& f, T t, T h) {
  using V = decltype(f(t));
  const auto difference = [&](T k) -> V { return (f(t + k) - f(t - k)) / (T(2) * k); };
  const V d1 = difference(h), d2 = difference(h / T(2)), d4 = difference(h / T(4));
  const V once1 = (T(4) * d2 - d1) / T(3), once2 = (T(4) * d4 - d2) / T(3);
  return V((T(16) * once2 - once1) / T(15));
}
template <class T, class F>
auto second_derivative(const F& f, T t, T h) {
  using V = decltype(f(t));
  const V centre = f(t);
  const auto difference = [&](T k) -> V { return (f(t + k) - T(2) * centre + f(t - k)) / (k * k); };
  const V d1 = difference(h), d2 = difference(h / T(2)), d4 = difference(h / T(4));
  const V once1 = (T(4) * d2 - d1) / T(3), once2 = (T(4) * d4 - d2) / T(3);
  return V((T(16) * once2 - once1) / T(15));
}

}  // namespace earthtop::test
