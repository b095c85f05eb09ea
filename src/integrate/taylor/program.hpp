// SPDX-License-Identifier: GPL-3.0-or-later
/// Computes the Taylor series of a recorded right-hand side, order by order.
///
/// The coefficients of a product, of a quotient and of the elementary functions are sums over products of coefficients
/// [e.g. A. Jorba, M. Zou, Experimental Mathematics 14 (2005) 99, section 2]. The terms that lack the highest order are known
/// before an order begins. So all these sums are found together, in one sweep with vector instructions (products.hpp); what is
/// left for each operation are one or two terms.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "earthtop/real.hpp"
#include "integrate/taylor/operations.hpp"

namespace earthtop::taylor {

template <class T>
class Program {
 public:
  Program() = default;
  /// Leaves out what the outputs do not need, and joins sums of sums.
  explicit Program(const Operations<T>& operations);

  /// Finds the coefficients of order 0. @param x  the state at the beginning of a step   @param t  its time
  void start(std::span<const T> x, T t);
  bool has_guards() const { return !guards_.empty(); }
  /// Whether all comparisons have the outcome they had when the right-hand side was recorded; after `start`.
  bool guards_hold() const;
  /// Finds the coefficients of order k of dx/dt. @param x  coefficients of order k of the state; orders come one by one, from 0 on
  void extend(int k, std::span<const T> x, std::span<T> rate);

  std::size_t products() const { return static_cast<std::size_t>(lanes_); }
  std::size_t operations() const { return instructions_.size(); }

 private:
  struct Instruction {
    Kind kind = Kind::constant;
    bool early = false;  ///< needed at order 0 only
    bool by_held = false;  ///< a product or quotient of which one operand has only its order 0
    int a = -1, b = -1, lane = -1;
    int first_term = 0, terms = 0;
    T number = T(0);
  };
  /// A number of instructions of one kind, one after the other.
  struct Run {
    Kind kind;
    bool early, by_held;
    int begin, end;
    int terms;
    bool plain;  ///< sums of two terms with factors of +1 and -1: differences
    int first_pair;
  };
  /// The places of two operands.
  struct Pair {
    int a, b;
  };
  struct Term {
    int place;
    T factor;
  };
  class Builder;

  void run_order(int k, std::span<const T> x);
  T& left(int k, int lane) { return left_[static_cast<std::size_t>(k) * static_cast<std::size_t>(padded_) + static_cast<std::size_t>(lane)]; }
  T& right(int k, int lane) { return right_[static_cast<std::size_t>(k) * static_cast<std::size_t>(padded_) + static_cast<std::size_t>(lane)]; }

  std::vector<Instruction> instructions_;
  std::vector<Run> runs_;
  std::vector<Term> terms_;
  std::vector<Pair> pairs_;  ///< operands of products and differences, in the order of the runs
  std::vector<T> now_;   ///< coefficients of the present order, of each instruction
  std::vector<T> zero_;  ///< those of order 0
  std::vector<T> left_, right_, inner_;
  std::vector<GivenFunction<T>> given_;
  std::vector<std::vector<std::array<T, 3>>> given_rows_;
  std::vector<Guard> guards_;
  std::vector<int> outputs_;
  int lanes_ = 0, padded_ = 0;
};
extern template class Program<double>;
extern template class Program<long double>;
extern template class Program<float128>;

}  // namespace earthtop::taylor
