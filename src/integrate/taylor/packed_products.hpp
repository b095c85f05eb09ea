// SPDX-License-Identifier: GPL-3.0-or-later
/// Computes products of power series, many at a time: the coefficient of order k of a product is sum_j left_j right_(k-j).
///
/// Each product is a lane. The factors of all lanes are stored side by side, a row for each order, so that one sweep over j
/// serves all of them with vector instructions. They are put in as packs, whose two terms with the newest factors are summed
/// apart: loading numbers as a long vector right after they were stored as short ones would stall the processor. Every lane is
/// summed in the same order on every processor.
#pragma once

#include <array>

#include "integrate/taylor/packs.hpp"
#include "integrate/taylor/products.hpp"

namespace earthtop::taylor {

/// The products of N pairs of vectors side by side that make up a x b: plus - minus.
template <class T, int N>
struct CrossTerms {
  std::array<Pack<T, N>, 3> plus, minus;
};

/// @tparam kLanes  number of products, a multiple of 4
template <class T, int kLanes>
class PackedProducts {
 public:
  static_assert(kLanes % 4 == 0);

  /// Puts the factors of order k of N products into as many lanes.
  /// @tparam kFirst  whether k is 0   @returns the two terms that contain them, in `outer`
  template <bool kFirst, int N>
  EARTHTOP_PACK_INLINE void put(int k, int lane, const Pack<T, N>& left, const Pack<T, N>& right, Pack<T, N>& outer) {
    store_pack<N>(left, row(left_, k) + lane);
    store_pack<N>(right, row(right_, k) + lane);
    if constexpr (kFirst) {
      outer = left * right;
    } else {
      Pack<T, N> left_0, right_0;
      load_pack<N>(row(left_, 0) + lane, left_0);
      load_pack<N>(row(right_, 0) + lane, right_0);
      outer = left_0 * right + left * right_0;
    }
  }
  /// Puts in the factors of N cross products; takes 6 N lanes.
  template <bool kFirst, int N>
  EARTHTOP_PACK_INLINE void put_cross(int k, int lane, const std::array<Pack<T, N>, 3>& a, const std::array<Pack<T, N>, 3>& b,
                                      CrossTerms<T, N>& outer) {
    for (std::size_t i = 0; i < 3; ++i) {
      const int at = lane + 2 * N * static_cast<int>(i);
      put<kFirst, N>(k, at, a[(i + 1) % 3], b[(i + 2) % 3], outer.plus[i]);
      put<kFirst, N>(k, at + N, a[(i + 2) % 3], b[(i + 1) % 3], outer.minus[i]);
    }
  }

  /// Sums the terms between the outer ones, once all factors of order k are put in.
  template <bool kFirst>
  EARTHTOP_PACK_INLINE void convolve(int k) {
    if constexpr (!kFirst) convolve_rows<kLanes>(left_.data(), right_.data(), k, inner_.data());
  }

  /// Products of order k. @param outer  what `put` has returned
  template <bool kFirst, int N>
  EARTHTOP_PACK_INLINE void add_inner(int lane, Pack<T, N>& outer) const {
    if constexpr (!kFirst) {
      Pack<T, N> inner;
      load_pack<N>(inner_.data() + lane, inner);
      outer = inner + outer;
    }
  }
  template <bool kFirst, int N>
  EARTHTOP_PACK_INLINE void cross(int lane, CrossTerms<T, N>& outer, std::array<Pack<T, N>, 3>& product) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const int at = lane + 2 * N * static_cast<int>(i);
      add_inner<kFirst, N>(at, outer.plus[i]);
      add_inner<kFirst, N>(at + N, outer.minus[i]);
      product[i] = outer.plus[i] - outer.minus[i];
    }
  }

 private:
  using Rows = std::array<T, static_cast<std::size_t>(kLanes) * kMostOrder<T>>;
  static T* row(Rows& rows, int k) { return rows.data() + static_cast<std::size_t>(k) * kLanes; }

  alignas(64) Rows left_{}, right_{};
  alignas(64) std::array<T, kLanes> inner_{};
};

}  // namespace earthtop::taylor
