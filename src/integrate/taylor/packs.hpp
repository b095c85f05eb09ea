// SPDX-License-Identifier: GPL-3.0-or-later
/// A few numbers side by side, for the inner loops of series. Packs of doubles are vectors that compilers know; the arithmetic
/// of each number is the same as without a pack.
#pragma once

#include <array>
#include <type_traits>

#ifdef __SANITIZE_ADDRESS__  // it would take minutes to compile
#define EARTHTOP_PACK_INLINE inline
#else
#define EARTHTOP_PACK_INLINE [[gnu::always_inline]] inline
#endif

namespace earthtop::taylor {

/// A pack of any other scalar.
template <class T, int N>
struct ArrayPack {
  std::array<T, N> numbers{};

  T& operator[](int i) { return numbers[static_cast<std::size_t>(i)]; }
  const T& operator[](int i) const { return numbers[static_cast<std::size_t>(i)]; }
  friend ArrayPack operator-(const ArrayPack& a) {
    return each([&](int i) { return -a[i]; });
  }
  friend ArrayPack operator+(const ArrayPack& a, const ArrayPack& b) {
    return each([&](int i) { return a[i] + b[i]; });
  }
  friend ArrayPack operator-(const ArrayPack& a, const ArrayPack& b) {
    return each([&](int i) { return a[i] - b[i]; });
  }
  friend ArrayPack operator*(const ArrayPack& a, const ArrayPack& b) {
    return each([&](int i) { return a[i] * b[i]; });
  }
  friend ArrayPack operator/(const ArrayPack& a, const ArrayPack& b) {
    return each([&](int i) { return a[i] / b[i]; });
  }
  friend ArrayPack operator*(const T& a, const ArrayPack& b) {
    return each([&](int i) { return a * b[i]; });
  }
  friend ArrayPack operator*(const ArrayPack& a, const T& b) { return b * a; }
  friend ArrayPack operator/(const ArrayPack& a, const T& b) {
    return each([&](int i) { return a[i] / b; });
  }

 private:
  template <class Number>
  static ArrayPack each(const Number& number) {
    ArrayPack made;
    for (int i = 0; i < N; ++i) made[i] = number(i);
    return made;
  }
};

template <class T, int N>
struct PackOf {
  using Type = ArrayPack<T, N>;
  using Stored = ArrayPack<T, N>;
};
template <int N>
struct PackOf<double, N> {
  using Type [[gnu::vector_size(8 * N), gnu::may_alias]] = double;
  /// The same where the alignment is that of at most 4 doubles.
  using Stored[[ gnu::vector_size(8 * N), gnu::may_alias, gnu::aligned(N == 2 ? 16 : 32) ]] = double;
};
/// N numbers: 2, 4 or 8; of other scalars than double also 1.
template <class T, int N>
using Pack = typename PackOf<T, N>::Type;

/// Reads and writes packs where numbers are stored side by side; the first has the alignment of a pack.
template <int N, class T>
EARTHTOP_PACK_INLINE void store_pack(const Pack<T, N>& pack, T* to) {
  if constexpr (std::is_same_v<T, double>)
    *reinterpret_cast<Pack<T, N>*>(to) = pack;
  else
    for (int i = 0; i < N; ++i) to[i] = pack[i];
}
template <int N, class T>
EARTHTOP_PACK_INLINE void load_pack(const T* from, Pack<T, N>& pack) {
  if constexpr (std::is_same_v<T, double>)
    pack = *reinterpret_cast<const Pack<T, N>*>(from);
  else
    for (int i = 0; i < N; ++i) pack[i] = from[i];
}

/// Numbers of two packs: those of the first are counted 0 to 3, those of the second 4 to 7.
template <int kA, int kB, int kC, int kD, class T>
EARTHTOP_PACK_INLINE void pick(const Pack<T, 4>& first, const Pack<T, 4>& second, Pack<T, 4>& picked) {
  if constexpr (std::is_same_v<T, double>) {
    picked = __builtin_shufflevector(first, second, kA, kB, kC, kD);
  } else {
    const auto number = [&](int i) { return i < 4 ? first[i] : second[i - 4]; };
    picked = {{number(kA), number(kB), number(kC), number(kD)}};
  }
}

}  // namespace earthtop::taylor
