// SPDX-License-Identifier: GPL-3.0-or-later
/// Power series in one variable that end after some terms.
#pragma once

#include <algorithm>
#include <array>

#include "earthtop/real.hpp"

namespace earthtop {

/// c[0] + c[1] x + c[2] x^2 + ... The results of operations have as many terms as the argument with fewest.
template <class T>
struct PowerSeries {
  /// So many that the terms of a piece of a journey fall below the rounding of T within a few tenths of their radius of convergence.
  static constexpr int kMost = sizeof(T) > sizeof(double) ? 28 : 16;
  std::array<T, kMost> c{};
  int terms = kMost;

  PowerSeries() = default;
  PowerSeries(const T& constant) { c[0] = constant; }  // NOLINT(google-explicit-constructor): a number is a series
  T& operator[](int k) { return c[static_cast<std::size_t>(k)]; }
  const T& operator[](int k) const { return c[static_cast<std::size_t>(k)]; }

  friend PowerSeries operator+(const PowerSeries& a, const PowerSeries& b) {
    PowerSeries sum = with_terms(a, b);
    for (int k = 0; k < sum.terms; ++k) sum[k] = a[k] + b[k];
    return sum;
  }
  friend PowerSeries operator-(const PowerSeries& a, const PowerSeries& b) {
    PowerSeries sum = with_terms(a, b);
    for (int k = 0; k < sum.terms; ++k) sum[k] = a[k] - b[k];
    return sum;
  }
  friend PowerSeries operator-(const PowerSeries& a) { return PowerSeries(T(0)) - a; }
  friend PowerSeries operator*(const PowerSeries& a, const PowerSeries& b) {
    PowerSeries product = with_terms(a, b);
    for (int k = 0; k < product.terms; ++k) {
      T sum = T(0);
      for (int i = 0; i <= k; ++i) sum += a[i] * b[k - i];
      product[k] = sum;
    }
    return product;
  }
  friend PowerSeries operator/(const PowerSeries& a, const PowerSeries& b) {
    PowerSeries quotient = with_terms(a, b);
    for (int k = 0; k < quotient.terms; ++k) {
      T rest = a[k];
      for (int i = 1; i <= k; ++i) rest -= b[i] * quotient[k - i];
      quotient[k] = rest / b[0];
    }
    return quotient;
  }

  T at(const T& x) const {
    T sum = T(0);
    for (int k = terms - 1; k >= 0; --k) sum = x * sum + c[static_cast<std::size_t>(k)];
    return sum;
  }
  /// The value at x without the constant term.
  T change_at(const T& x) const {
    T sum = T(0);
    for (int k = terms - 1; k >= 1; --k) sum = x * (sum + c[static_cast<std::size_t>(k)]);
    return sum;
  }

 private:
  static PowerSeries with_terms(const PowerSeries& a, const PowerSeries& b) {
    PowerSeries made;
    made.terms = std::min(a.terms, b.terms);
    return made;
  }
};

template <class T>
PowerSeries<T> sqrt(const PowerSeries<T>& a) {
  PowerSeries<T> root;
  root.terms = a.terms;
  root[0] = real::sqrt(a[0]);
  for (int k = 1; k < root.terms; ++k) {
    T rest = a[k];
    for (int i = 1; i < k; ++i) rest -= root[i] * root[k - i];
    root[k] = rest / (T(2) * root[0]);
  }
  return root;
}

template <class T>
SinCos<PowerSeries<T>> sin_cos(const PowerSeries<T>& angle) {
  SinCos<PowerSeries<T>> both;
  both.sin.terms = both.cos.terms = angle.terms;
  const SinCos<T> first = real::sin_cos(angle[0]);
  both.sin[0] = first.sin, both.cos[0] = first.cos;
  for (int k = 1; k < angle.terms; ++k) {
    T sine = T(0), cosine = T(0);
    for (int i = 1; i <= k; ++i) {
      const T rate = T(i) * angle[i];
      sine += rate * both.cos[k - i], cosine -= rate * both.sin[k - i];
    }
    both.sin[k] = sine / T(k), both.cos[k] = cosine / T(k);
  }
  return both;
}

/// The derivative, which has a term less.
template <class T>
PowerSeries<T> derivative(const PowerSeries<T>& a) {
  PowerSeries<T> rate;
  rate.terms = a.terms - 1;
  for (int k = 0; k < rate.terms; ++k) rate[k] = T(k + 1) * a[k + 1];
  return rate;
}

/// The integral that has this value at 0.
template <class T>
PowerSeries<T> integral(const PowerSeries<T>& a, const T& value) {
  PowerSeries<T> sum(value);
  sum.terms = std::min(a.terms + 1, PowerSeries<T>::kMost);
  for (int k = 1; k < sum.terms; ++k) sum[k] = a[k - 1] / T(k);
  return sum;
}

}  // namespace earthtop
