// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "closed_form/complex.hpp"

namespace earthtop {

/// The discrete Fourier transform of 2^n values (Cooley and Tukey), for every scalar type.
template <class T>
class FourierTransform {
 public:
  explicit FourierTransform(std::size_t size) : turns_(size) {
    for (std::size_t i = 0; i < size; ++i) turns_[i] = turned(T(T(-2) * real::pi<T>() * T(i) / T(size)));
  }
  std::size_t size() const { return turns_.size(); }
  /// The harmonic, from -size/2 to size/2 - 1, that a place among the coefficients belongs to.
  int harmonic(std::size_t place) const {
    const auto k = static_cast<int>(place), n = static_cast<int>(size());
    return 2 * k < n ? k : k - n;
  }
  /// The place of a harmonic.
  std::size_t place(int harmonic) const {
    return static_cast<std::size_t>(harmonic < 0 ? harmonic + static_cast<int>(size()) : harmonic);
  }

  /// From the values at the phases 2 pi i / size to the coefficients c_k of the sum of c_k exp(i k phase).
  void to_coefficients(Complex<T>* x) const {
    transform(x, false);
    for (std::size_t i = 0; i < size(); ++i) x[i] = T(T(1) / T(size())) * x[i];
  }
  void to_values(Complex<T>* x) const { transform(x, true); }

 private:
  void transform(Complex<T>* x, bool backward) const {
    const std::size_t n = size();
    for (std::size_t i = 1, j = 0; i < n; ++i) {  // sorts by the places read backward, bit by bit
      std::size_t bit = n >> 1;
      for (; j & bit; bit >>= 1) j ^= bit;
      j ^= bit;
      if (i < j) std::swap(x[i], x[j]);
    }
    for (std::size_t length = 2; length <= n; length *= 2) {
      const std::size_t half = length / 2, stride = n / length;
      for (std::size_t begin = 0; begin < n; begin += length)
        for (std::size_t i = 0; i < half; ++i) {
          const Complex<T> turn = backward ? conj(turns_[i * stride]) : turns_[i * stride];
          const Complex<T> even = x[begin + i], odd = turn * x[begin + i + half];
          x[begin + i] = even + odd;
          x[begin + i + half] = even + T(-1) * odd;
        }
    }
  }

  std::vector<Complex<T>> turns_;
};

}  // namespace earthtop
