// SPDX-License-Identifier: GPL-3.0-or-later
/// Gauss collocation: nodes, weights and coefficients, correctly rounded to double from 113-bit arithmetic.
///
/// Hairer, Lubich and Wanner, Geometric Numerical Integration, 2nd ed., sections II.1.3 and VIII.6.
#pragma once

#include <array>
#include <cstddef>

namespace earthtop {

/// The method of S stages and order 2 S, with nodes c_i in [0, 1]: a_ij is the integral of the j-th Lagrange polynomial from 0
/// to the i-th node, b_j the one from 0 to 1.
template <std::size_t S>
struct GaussTables {
  std::array<double, S> c, b;
  std::array<std::array<double, S>, S> a;
  /// Extrapolates to the next step of the same length: from the values at the nodes of one step to those that the polynomial
  /// through them has at the nodes of the next.
  std::array<std::array<double, S>, S> next;
};

/// The tables for S stages; they are made when first asked for.
template <std::size_t S>
const GaussTables<S>& gauss_tables();
extern template const GaussTables<6>& gauss_tables<6>();

}  // namespace earthtop
