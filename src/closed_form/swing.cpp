// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/closed_form/swing.hpp"

#include <array>
#include <type_traits>

#include "earthtop/elementary.hpp"
#include "earthtop/real.hpp"

namespace earthtop {
namespace {

/// The roots x1 <= x2 < x3 of G x^3 - (2 G + e + b^2) x^2 + (2 e - 2 v b) x - v^2.
template <class T>
struct SwingRoots {
  T inner, outer, beyond;
};

template <class T>
SwingRoots<T> swing_roots(T gravity, T e, T v, T b) {
  const T sum = (T(2) * gravity + e + b * b) / gravity, pairs = (T(2) * e - T(2) * v * b) / gravity, product = v * v / gravity;
  T x3 = sum;  // Newton's method comes down to the largest root from here
  for (int k = 0; k < 60; ++k) {
    const T value = ((x3 - sum) * x3 + pairs) * x3 - product, slope = (T(3) * x3 - T(2) * sum) * x3 + pairs;
    const T next = x3 - value / slope;
    if (!(next < x3)) break;
    x3 = next;
  }
  // Both small roots from what has no digits in common with x3.
  const T of_both = product / x3, half = (pairs - of_both) / x3 / T(2), square = half * half - of_both;
  const T x2 = half + (square > T(0) ? real::sqrt(square) : T(0));
  return {x2 > T(0) ? of_both / x2 : T(0), x2, x3};
}

/// An even function of period pi, as a sum of cosines through its values at N places.
template <class T>
class CosineSum {
 public:
  static constexpr int N = std::is_same_v<T, double> ? 32 : 80;
  template <class Function>
  explicit CosineSum(const Function& value) {
    std::array<T, N> values, twice;
    const T step = real::pi<T>() / T(2 * N);
    for (int j = 0; j < N; ++j) {
      const SinCos<T> at = real::sin_cos(T(2 * j + 1) * step / T(2));
      values[j] = value(at.sin * at.sin), twice[j] = at.cos * at.cos - at.sin * at.sin;
    }
    for (int j = 0; j < N; ++j) {
      T before = T(1), cosine = twice[j];
      c_[0] += values[j] / T(N);
      for (int k = 1; k < N; ++k) {
        c_[k] += T(2) / T(N) * values[j] * cosine;
        const T next = T(2) * twice[j] * cosine - before;
        before = cosine, cosine = next;
      }
    }
  }
  T mean() const { return c_[0]; }
  /// The integral from theta to pi/2.
  T rest(T theta) const {
    const SinCos<T> twice = real::sin_cos(T(2) * theta);
    T sum = c_[0] * (real::pi<T>() / T(2) - theta), before = T(0), sine = twice.sin;
    for (int k = 1; k < N; ++k) {
      sum -= c_[k] * sine / T(2 * k);
      const T next = T(2) * twice.cos * sine - before;
      before = sine, sine = next;
    }
    return sum;
  }
  /// Whether N places resolve the function.
  bool is_resolved() const {
    const T size = real::abs(c_[0]) + real::abs(c_[1]);
    return !(real::abs(c_[N - 1]) + real::abs(c_[N - 2]) > T(1e-13) * size);
  }

 private:
  std::array<T, N> c_{};
};

template <class T>
T inclination(T x) {
  return T(2) * real::asin(real::sqrt(x / T(2)));
}

}  // namespace

template <class T>
std::optional<Swing<T>> swing_of(const SymmetricTop<T>& top, const Vec3<T>& n_L, const Vec3<T>& n_rate_L, T spin_rad_s,
                                 T up_rad_s) {
  const T sign = top.mgl > T(0) ? T(1) : T(-1), gravity = T(2) * real::abs(top.mgl) / top.I1;
  if (!(gravity > T(0))) return std::nullopt;
  // From the pivot to the centre of mass, and its rate relative to axes that do not turn about Up.
  const Vec3<T> s = sign * n_L, rate = sign * n_rate_L + up_rad_s * Vec3<T>(-s[1], s[0], T(0));
  const T horizontal = s[0] * s[0] + s[1] * s[1];
  const T x = s[2] < T(0) ? horizontal / (T(1) - s[2]) : T(1) + s[2];
  const T b = -sign * top.I3 / top.I1 * (spin_rad_s + up_rad_s * n_L[2]), v = s[0] * rate[1] - s[1] * rate[0] - b * x;
  const T e = rate[0] * rate[0] + rate[1] * rate[1] + rate[2] * rate[2] + gravity * x;
  if (!(e > T(0))) return Swing<T>{};
  const SwingRoots<T> roots = swing_roots(gravity, e, v, b);
  const T x1 = roots.inner, x2 = roots.outer, x3 = roots.beyond;
  if (!(x2 <= T(2)) || !(x3 > x2) || !(x1 < T(1))) return std::nullopt;
  const T turn = v > T(0) ? T(1) : v < T(0) ? T(-1) : T(0), mean_of_roots = turn * real::sqrt(x1 * x2);
  const auto at = [&](T sin_squared) { return x1 + (x2 - x1) * sin_squared; };
  const CosineSum<T> time([&](T sin_squared) { return T(2) / real::sqrt(gravity * (x3 - at(sin_squared))); });
  const CosineSum<T> azimuth([&](T sin_squared) {
    const T here = at(sin_squared), left = x3 - here, root = real::sqrt(x3 / left);
    // The second term is finite where the pendulum passes upright, which it only does with v + 2 b = 0.
    return mean_of_roots / (left * (root + T(1))) + (v + T(2) * b) / (T(2) - here) / real::sqrt(gravity * left);
  });
  if (!time.is_resolved() || !azimuth.is_resolved()) return std::nullopt;
  Swing<T> swing{inclination(x2), inclination(x1), std::nullopt, -azimuth.mean() / time.mean()};
  if (v + b * x1 > T(0)) swing.minor_rad = -swing.minor_rad;  // counterclockwise
  const T apart = x2 - x1;
  if (!(apart > T(64) * real::epsilon<T>() * x2)) return swing;
  const T twice_cos = (x1 + x2 - T(2) * x) / apart, twice_sin = T(2) * rate[2] / (apart * real::sqrt(gravity * (x3 - x)));
  const T theta = real::atan2(real::abs(twice_sin), twice_cos) / T(2), outward = twice_sin < T(0) ? T(-1) : T(1);
  const SinCos<T> phase = real::sin_cos(theta);
  const T arc = turn * (real::pi<T>() / T(2) - real::atan2(real::sqrt(x2) * phase.sin, real::sqrt(x1) * phase.cos));
  const T ahead = arc + azimuth.rest(theta) - azimuth.mean() / time.mean() * time.rest(theta);
  const T counterclockwise = real::atan2(s[1], s[0]) + outward * ahead, half_turn = real::pi<T>();
  const T compass = real::fmod(half_turn / T(2) - counterclockwise, half_turn);
  swing.azimuth_rad = compass < T(0) ? compass + half_turn : compass;
  return swing;
}

template std::optional<Swing<double>> swing_of(const SymmetricTop<double>&, const Vec3<double>&, const Vec3<double>&, double,
                                               double);
template std::optional<Swing<float128>> swing_of(const SymmetricTop<float128>&, const Vec3<float128>&, const Vec3<float128>&,
                                                 float128, float128);

}  // namespace earthtop
