// SPDX-License-Identifier: GPL-3.0-or-later
/// Computes products of power series, many at a time. Expanding a quadratic system costs little else.
///
/// The coefficient of order k of a product is sum_j left_j right_(k-j). Each product is a lane. Lanes are stored side by side,
/// so that one sweep over j serves all of them with vector instructions; every lane is summed in the same order on every
/// processor.
#pragma once

#include <array>

#include "earthtop/vectors.hpp"

namespace earthtop::taylor {

/// The highest order a series is taken to.
template <class T>
inline constexpr int kMostOrder = 32;
template <>
inline constexpr int kMostOrder<float128> = 64;

/// sum[l] = sum over j = 1..order - 1 of left[j][l] right[order - j][l] for rows of `lanes`, a multiple of 8.
void convolve_inner(const double* left, const double* right, int order, int lanes, double* sum);
template <class T>
void convolve_inner(const T* left, const T* right, int order, int lanes, T* sum) {
  for (int l = 0; l < lanes; ++l) sum[l] = T(0);
  for (int j = 1; j < order; ++j)
    for (int l = 0; l < lanes; ++l) sum[l] += left[j * lanes + l] * right[(order - j) * lanes + l];
}

/// A set of kLanes products. At each order the factors are put in, then all products are convolved, then they can be read. The
/// two terms with the factors just put in are summed apart from the others: loading numbers as a vector right after they were
/// stored one by one would stall the processor.
template <class T, int kLanes>
class Products {
 public:
  /// Puts the factors of one product into a lane.
  void put(int order, int lane, T left, T right) {
    const auto row = static_cast<std::size_t>(order) * kPadded, l = static_cast<std::size_t>(lane);
    left_[row + l] = left;
    right_[row + l] = right;
    outer_[l] = order == 0 ? left * right : left_[l] * right + left * right_[l];
  }
  /// Takes three lanes for the products a b_i with a scalar a.
  void put_scaled(int order, int lane, T a, const Vec3<T>& b) {
    for (int i = 0; i < 3; ++i) put(order, lane + i, a, b[i]);
  }
  /// Takes three lanes for the products a_i b_i.
  void put_parallel(int order, int lane, const Vec3<T>& a, const Vec3<T>& b) {
    for (int i = 0; i < 3; ++i) put(order, lane + i, a[i], b[i]);
  }
  /// Takes six lanes for a x b.
  void put_cross(int order, int lane, const Vec3<T>& a, const Vec3<T>& b) {
    for (int i = 0; i < 3; ++i) {
      put(order, lane + i, a[(i + 1) % 3], b[(i + 2) % 3]);
      put(order, lane + 3 + i, a[(i + 2) % 3], b[(i + 1) % 3]);
    }
  }
  void convolve(int order) {
    if (order > 1)
      convolve_inner(left_.data(), right_.data(), order, kPadded, inner_.data());
    else if (order == 0)
      inner_.fill(T(0));
  }

  T at(int lane) const { return inner_[static_cast<std::size_t>(lane)] + outer_[static_cast<std::size_t>(lane)]; }
  Vec3<T> vector(int lane) const { return {at(lane), at(lane + 1), at(lane + 2)}; }
  Vec3<T> cross(int lane) const { return {at(lane) - at(lane + 3), at(lane + 1) - at(lane + 4), at(lane + 2) - at(lane + 5)}; }
  T sum_of_three(int lane) const { return at(lane) + at(lane + 1) + at(lane + 2); }

 private:
  static constexpr int kPadded = (kLanes + 7) / 8 * 8;
  static constexpr std::size_t kSize = static_cast<std::size_t>(kPadded) * (kMostOrder<T> + 1);

  alignas(64) std::array<T, kSize> left_{}, right_{};
  alignas(64) std::array<T, kPadded> inner_{};
  std::array<T, kLanes> outer_{};
};

}  // namespace earthtop::taylor
