// SPDX-License-Identifier: GPL-3.0-or-later
/// The operations of a right-hand side, written down once as a list, from which a Taylor series of any order is computed.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace earthtop::taylor {

/// The kinds of operations. Those from `product` on sum over products of coefficients of lower orders.
enum class Kind : unsigned char {
  constant,  ///< a number
  state,     ///< component of the state
  time,      ///< the time t
  given,     ///< component of a given function of time
  held,      ///< a result that is constant along the exact motion: over a step its series is its value at the beginning
  linear,    ///< a sum of numbers times results, plus a number
  product,
  quotient,
  square_root,
  power,  ///< to an exponent that is a number
  sine,   ///< the operation that follows is the cosine of the same argument
  cosine,
  parameter  ///< a number by which the right-hand side may be differentiated
};

/// Whether an operation has another result for its first operand.
constexpr bool has_operand(Kind kind) { return kind >= Kind::held && kind <= Kind::cosine; }

/// Whether a result is a number that stands in the list.
constexpr bool is_number(Kind kind) { return kind == Kind::constant || kind == Kind::parameter; }

/// The number of products of series that an operation of a kind sums.
constexpr int lanes_of(Kind kind) {
  switch (kind) {
    case Kind::product:
    case Kind::quotient:
    case Kind::square_root: return 1;
    case Kind::power:
    case Kind::sine: return 2;
    default: return 0;
  }
}

/// One operation; its result is named by its place in the list.
template <class T>
struct Operation {
  Kind kind = Kind::constant;
  int a = -1, b = -1;  ///< places of the operands; of `state`: the component; of `parameter`: which one; of `given`: the
                       ///< function and its component
  T number = T(0);     ///< the constant or parameter; the exponent of a power; the number added to a linear sum
  T factor_a = T(1), factor_b = T(1);  ///< factors of the two operands of a linear sum
};

/// A function of time with some components, given by its Taylor coefficients.
template <class T>
struct GivenFunction {
  int components = 0;
  /// Puts the coefficients of the powers of (t' - t) of all components into a row for each order, the lowest first.
  /// @param rows  to be filled; as many as orders are sought
  std::function<void(T t, std::span<std::array<T, 3>> rows)> expand;
};

/// A comparison that decided between two branches of a formula while it was recorded. The record holds while it has the same
/// outcome.
struct Guard {
  int less, more;  ///< places of the results that were compared: whether `less` < `more`
  bool outcome;
};

/// A right-hand side as a list of operations, in an order in which each uses results of earlier ones only.
template <class T>
struct Operations {
  std::vector<Operation<T>> list;
  std::vector<GivenFunction<T>> given;
  std::vector<Guard> guards;
  std::vector<int> outputs;  ///< places of the components of dx/dt
};

}  // namespace earthtop::taylor
