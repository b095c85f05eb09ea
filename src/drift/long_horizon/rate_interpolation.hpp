// SPDX-License-Identifier: GPL-3.0-or-later
/// The drift at a small rate of the Earth, interpolated between four larger rates, at which it can be seen as a difference.
#pragma once

#include <algorithm>
#include <array>

#include "drift/spinless_pair_system.hpp"

namespace earthtop {

/// The four rates over the largest one.
inline constexpr std::array<double, 4> kRateNodes{1, 0.5, -0.5, -1};

/// The pair at the rate epsilon, and the terms of the cubic in the rate at the largest of the four.
template <class T>
struct JoinedPair {
  SpinlessPair<T> pair;
  Vec3<T> second_order_term = Vec3<T>::Zero(), third_order_term = Vec3<T>::Zero();
};

/// @param at  the pairs at the four rates kRateNodes x node and the same time
template <class T>
JoinedPair<T> joined(const std::array<SpinlessPair<T>, kRateNodes.size()>& at, T epsilon, T node) {
  const T x = epsilon / node;
  std::array<T, kRateNodes.size()> weight;
  for (std::size_t i = 0; i < kRateNodes.size(); ++i) {
    weight[i] = T(1);
    for (std::size_t j = 0; j < kRateNodes.size(); ++j)
      if (j != i) weight[i] *= (x - kRateNodes[j]) / (kRateNodes[i] - kRateNodes[j]);
  }
  JoinedPair<T> made;
  made.pair = at[0];
  Vec3<T> y = Vec3<T>::Zero();
  Complex<T> rate;
  T excess = T(0);
  // Of a cubic p through the nodes 1, 1/2, -1/2, -1, the sum p(1) + p(-1) - p(1/2) - p(-1/2) is 3/2 of the coefficient of second order, and
  // p(1) - p(-1) - 2 (p(1/2) - p(-1/2)) is 3/2 of that of third order.
  constexpr std::array<T, 4> kSecond{T(2) / T(3), -T(2) / T(3), -T(2) / T(3), T(2) / T(3)};
  constexpr std::array<T, 4> kThird{T(2) / T(3), -T(4) / T(3), T(4) / T(3), -T(2) / T(3)};
  for (std::size_t i = 0; i < kRateNodes.size(); ++i) {
    const SpinlessPair<T>& q = at[i];
    const T side = q.e_w < T(0) ? T(-1) : T(1), scale = T(1) / (kRateNodes[i] * node);
    y += weight[i] * side * q.y;
    made.second_order_term += kSecond[i] * side * q.y;
    made.third_order_term += kThird[i] * side * q.y;
    rate = rate + (weight[i] * scale) * (q.across + T(-1) * q.ref_across);
    excess += weight[i] * scale * q.spin_excess;
  }
  made.pair.y = y;
  made.pair.e_w = real::sqrt(T(1) - epsilon * epsilon * y.dot(y));
  made.pair.across = made.pair.ref_across + epsilon * rate;
  made.pair.spin_excess = epsilon * excess;
  return made;
}

/// An estimate of what the cubic leaves out, from the sizes of its terms, the largest so far.
template <class T>
class InterpolationError {
 public:
  void include(T whole, T second, T third) {
    whole_ = std::max(whole_, whole), second_ = std::max(second_, second), third_ = std::max(third_, third);
  }
  /// An upper estimate of the term of fourth order, of which a quarter is missing at a rate of 0. A turn by an angle has terms of
  /// even order only, of which each is below the square of the one before.
  T fourth_order() const {
    if (!(whole_ > T(0))) return T(0);
    const T second = second_ / whole_, third = third_ / whole_;
    return whole_ * std::max(T(second * second), T(third * real::cbrt(third)));
  }
  /// Whether the cubic can be trusted. The next term is then smaller again by about the cube root of the ratio.
  bool third_order_is_small() const { return third_ < T(kSmallThird) * whole_; }

 private:
  static constexpr double kSmallThird = 2e-4 / 3;
  T whole_ = T(0), second_ = T(0), third_ = T(0);
};

}  // namespace earthtop
