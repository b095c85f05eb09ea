// SPDX-License-Identifier: GPL-3.0-or-later
/// Computes products of power series, many at a time: the coefficient of order k of a product is sum_j left_j right_(k-j).
///
/// Each product is a lane. The factors of all lanes are stored side by side, a row for each order, so that one sweep over j
/// serves all of them with vector instructions, and two orders: most of the time goes into loading the factors. The terms with
/// the newest factors are summed apart, as packs: loading numbers as a long vector right after they were stored as short ones
/// would stall the processor. Every lane is summed in the same order on every processor.
#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "integrate/taylor/most_order.hpp"
#include "integrate/taylor/packs.hpp"

namespace earthtop::taylor {

/// The products of N pairs of vectors side by side that make up a x b: plus - minus.
template <class T, int N>
struct CrossTerms {
  std::array<Pack<T, N>, 3> plus, minus;
};

/// The place of an order in the computation.
enum class Place {
  first,       ///< order 0
  second,      ///< order 1
  pair_begin,  ///< an even order: sums are swept for it and for the next
  pair_end     ///< the next one
};

/// Calls `extend<place>(k)` for the orders k below `order`.
template <class Extend>
EARTHTOP_PACK_INLINE void for_each_order(int order, const Extend& extend) {
  extend.template operator()<Place::first>(0);
  if (order > 1) extend.template operator()<Place::second>(1);
  for (int k = 2; k < order; k += 2) {
    extend.template operator()<Place::pair_begin>(k);
    if (k + 1 < order) extend.template operator()<Place::pair_end>(k + 1);
  }
}

/// @tparam kLanes  number of products, a multiple of 4
template <class T, int kLanes>
class PackedProducts {
 public:
  static_assert(kLanes % 4 == 0);

  /// Puts the factors of order k of N products into as many lanes.
  /// @returns in `newest` the two terms that contain them
  template <Place kPlace, int N>
  EARTHTOP_PACK_INLINE void put(int k, int lane, const Pack<T, N>& left, const Pack<T, N>& right, Pack<T, N>& newest) {
    store_pack<N>(left, row(left_, k) + lane);
    store_pack<N>(right, row(right_, k) + lane);
    if constexpr (kPlace == Place::first)
      newest = left * right;
    else
      newest = factor<N>(left_, 0, lane) * right + left * factor<N>(right_, 0, lane);
  }
  /// Puts in the factors of N cross products; takes 6 N lanes.
  template <Place kPlace, int N>
  EARTHTOP_PACK_INLINE void put_cross(int k, int lane, const std::array<Pack<T, N>, 3>& a, const std::array<Pack<T, N>, 3>& b,
                                      CrossTerms<T, N>& newest) {
    for (std::size_t i = 0; i < 3; ++i) {
      const int at = lane + 2 * N * static_cast<int>(i);
      put<kPlace, N>(k, at, a[(i + 1) % 3], b[(i + 2) % 3], newest.plus[i]);
      put<kPlace, N>(k, at + N, a[(i + 2) % 3], b[(i + 1) % 3], newest.minus[i]);
    }
  }

  /// Sums the terms of order k without the newest factors, once all factors of order k are put in; and those of order k + 1
  /// for which the factors are at hand.
  /// @tparam kWidth  how many numbers the processor's vectors have: 2, 4 or 8
  template <Place kPlace, int kWidth>
  EARTHTOP_PACK_INLINE void convolve(int k) {
    if constexpr (kPlace == Place::pair_begin) sweep<kWidth, 0>(k);
  }

  /// Completes products of order k. @param newest  what `put` has returned
  template <Place kPlace, int N>
  EARTHTOP_PACK_INLINE void complete(int k, int lane, Pack<T, N>& newest) const {
    if constexpr (kPlace == Place::pair_begin)
      newest = factor<N>(sums_, 0, lane) + newest;
    else if constexpr (kPlace == Place::pair_end)
      newest = (factor<N>(sums_, 1, lane) + (factor<N>(left_, 1, lane) * factor<N>(right_, k - 1, lane) +
                                             factor<N>(left_, k - 1, lane) * factor<N>(right_, 1, lane))) +
               newest;
  }
  template <Place kPlace, int N>
  EARTHTOP_PACK_INLINE void complete_cross(int k, int lane, CrossTerms<T, N>& newest,
                                           std::array<Pack<T, N>, 3>& product) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const int at = lane + 2 * N * static_cast<int>(i);
      complete<kPlace, N>(k, at, newest.plus[i]);
      complete<kPlace, N>(k, at + N, newest.minus[i]);
      product[i] = newest.plus[i] - newest.minus[i];
    }
  }

 private:
  using Rows = std::array<T, static_cast<std::size_t>(kLanes) * kMostOrder<T>>;
  using Sums = std::array<T, static_cast<std::size_t>(2 * kLanes)>;
  static T* row(Rows& rows, int k) { return rows.data() + static_cast<std::size_t>(k) * kLanes; }
  /// The numbers of a row, starting at a lane.
  template <int N, std::size_t kSize>
  EARTHTOP_PACK_INLINE static const Pack<T, N>& factor(const std::array<T, kSize>& rows, int k, int lane) {
    return *reinterpret_cast<const Pack<T, N>*>(rows.data() + static_cast<std::size_t>(k) * kLanes + lane);
  }

  /// Sweeps over the factors: sums the products with j = 1 .. k - 1 of order k, and with j = 2 .. k - 1 of order k + 1, from
  /// the given lane on. More lanes at a time would need more registers than the processor has.
  template <int kWidth, int kLane>
  EARTHTOP_PACK_INLINE void sweep(int k) {
    constexpr int kMost = kWidth == 2 ? 8 : 16, kLeft = kLanes - kLane, kWide = kLeft > kMost ? kMost : kLeft;
    constexpr int kPacks = kWide / kWidth, kRest = kWide - kPacks * kWidth;  // the rest is 0 or 4
    using Wide = typename PackOf<T, kWidth>::Stored;
    using Four = typename PackOf<T, 4>::Stored;
    Pack<T, kWidth> even[kPacks + 1], odd[kPacks + 1], before[kPacks + 1];
    Pack<T, 4> even_four, odd_four, before_four;
    const T* a = left_.data() + kLanes + kLane;
    const T* b = right_.data() + static_cast<std::ptrdiff_t>(k - 1) * kLanes + kLane;
    each<kPacks>([&](int i) __attribute__((always_inline)) {
      before[i] = reinterpret_cast<const Wide*>(b)[i];
      even[i] = reinterpret_cast<const Wide*>(a)[i] * before[i];
      odd[i] = Pack<T, kWidth>{};
    });
    if constexpr (kRest != 0) {
      before_four = *reinterpret_cast<const Four*>(b + kPacks * kWidth);
      even_four = *reinterpret_cast<const Four*>(a + kPacks * kWidth) * before_four;
      odd_four = Pack<T, 4>{};
    }
    for (int j = 2; j < k; ++j) {
      a += kLanes, b -= kLanes;
      each<kPacks>([&](int i) __attribute__((always_inline)) {
        const Pack<T, kWidth> factor = reinterpret_cast<const Wide*>(a)[i];
        odd[i] = odd[i] + factor * before[i];
        before[i] = reinterpret_cast<const Wide*>(b)[i];
        even[i] = even[i] + factor * before[i];
      });
      if constexpr (kRest != 0) {
        const Pack<T, 4> factor = *reinterpret_cast<const Four*>(a + kPacks * kWidth);
        odd_four = odd_four + factor * before_four;
        before_four = *reinterpret_cast<const Four*>(b + kPacks * kWidth);
        even_four = even_four + factor * before_four;
      }
    }
    T *even_sums = sums_.data() + kLane, *odd_sums = even_sums + kLanes;
    each<kPacks>([&](int i) __attribute__((always_inline)) {
      reinterpret_cast<Wide*>(even_sums)[i] = even[i];
      reinterpret_cast<Wide*>(odd_sums)[i] = odd[i];
    });
    if constexpr (kRest != 0) {
      *reinterpret_cast<Four*>(even_sums + kPacks * kWidth) = even_four;
      *reinterpret_cast<Four*>(odd_sums + kPacks * kWidth) = odd_four;
    }
    if constexpr (kLeft > kWide) sweep<kWidth, kLane + kWide>(k);
  }
  /// Calls `act(i)` for i below kCount, each with a number known at compile time: loops would keep the packs in memory.
  template <int kCount, class Act>
  EARTHTOP_PACK_INLINE static void each(const Act& act) {
    [&]<int... kNumber>(std::integer_sequence<int, kNumber...>) __attribute__((always_inline)) { (act(kNumber), ...); }
    (std::make_integer_sequence<int, kCount>());
  }

  alignas(64) Rows left_{}, right_{};
  alignas(64) Sums sums_{};
};

}  // namespace earthtop::taylor
