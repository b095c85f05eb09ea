// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrate/gauss_tables.hpp"

#include "earthtop/real.hpp"

namespace earthtop {
namespace {

/// The Legendre polynomial of degree n at x, and its derivative.
template <class T>
std::array<T, 2> legendre(int n, T x) {
  T p = T(1), q = x;
  for (int k = 2; k <= n; ++k) {
    const T next = (T(2 * k - 1) * x * q - T(k - 1) * p) / T(k);
    p = q, q = next;
  }
  return {q, T(n) * (x * q - p) / (x * x - T(1))};
}

/// The coefficients of the j-th Lagrange polynomial of the nodes, lowest power first.
template <class T, std::size_t S>
std::array<T, S> lagrange(const std::array<T, S>& c, std::size_t j) {
  std::array<T, S> p{};
  p[0] = T(1);
  std::size_t degree = 0;
  for (std::size_t m = 0; m < S; ++m) {
    if (m == j) continue;
    const T scale = T(1) / (c[j] - c[m]);
    for (std::size_t k = ++degree; k > 0; --k) p[k] = (p[k - 1] - c[m] * p[k]) * scale;
    p[0] = -c[m] * p[0] * scale;
  }
  return p;
}

template <class T, std::size_t S>
T value(const std::array<T, S>& p, T x) {
  T sum = T(0);
  for (std::size_t k = S; k-- > 0;) sum = sum * x + p[k];
  return sum;
}

template <class T, std::size_t S>
T integral(const std::array<T, S>& p, T x) {
  T sum = T(0);
  for (std::size_t k = S; k-- > 0;) sum = sum * x + p[k] / T(k + 1);
  return sum * x;
}

template <std::size_t S>
GaussTables<S> make_tables() {
  using T = float128;
  std::array<T, S> c;
  for (std::size_t i = 0; i < S; ++i) {
    T x = -real::cos(T(real::pi<T>() * (T(i) + T(0.75)) / (T(S) + T(0.5))));
    for (int newton = 0; newton < 8; ++newton) {
      const auto [p, slope] = legendre<T>(static_cast<int>(S), x);
      x -= p / slope;
    }
    c[i] = (T(1) + x) / T(2);
  }
  GaussTables<S> tables;
  for (std::size_t j = 0; j < S; ++j) {
    const auto p = lagrange(c, j);
    tables.c[j] = static_cast<double>(c[j]);
    tables.b[j] = static_cast<double>(integral(p, T(1)));
    for (std::size_t i = 0; i < S; ++i) {
      tables.a[i][j] = static_cast<double>(integral(p, c[i]));
      tables.next[i][j] = static_cast<double>(value(p, T(T(1) + c[i])));
    }
  }
  return tables;
}

}  // namespace

template <std::size_t S>
const GaussTables<S>& gauss_tables() {
  static const GaussTables<S> tables = make_tables<S>();
  return tables;
}
template const GaussTables<6>& gauss_tables<6>();

}  // namespace earthtop
