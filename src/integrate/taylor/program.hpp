// SPDX-License-Identifier: GPL-3.0-or-later
/// Computes the Taylor series of a recorded right-hand side, order by order.
///
/// The coefficients of a product, of a quotient and of the elementary functions are sums over products of coefficients
/// [e.g. A. Jorba, M. Zou, Experimental Mathematics 14 (2005) 99, section 2]. The terms that lack the highest order are known
/// before an order begins. So all these sums are found together, in one sweep with vector instructions for two orders; what is
/// left for each operation are a few terms. Every result is summed in the same order on every processor.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "integrate/taylor/for_each_processor.hpp"
#include "integrate/taylor/packs.hpp"
#include "integrate/taylor/program_code.hpp"

namespace earthtop::taylor {

template <class T>
class Program {
 public:
  using State = T;

  Program() = default;
  /// Leaves out what the outputs do not need, and joins sums of sums.
  /// @param width  how many doubles the processor's vectors have: 2, 4 or 8
  explicit Program(const Operations<T>& operations, int width = width_of_processor());

  /// Finds the results at the beginning of a step. @param x  the state   @param t  its time
  void start(std::span<const T> x, T t);
  bool has_guards() const { return !code_.guards.empty(); }
  /// Whether all comparisons have the outcome they had when the right-hand side was recorded; after `start`.
  bool guards_hold() const;
  /// Finds the coefficients of the orders 1 to `order` of the state, which has as many components as dx/dt.
  /// @param x  the coefficients, one order after the other, with that of order 0, which `start` was given
  void expand(T* x, int order);
  /// The same, as a part of a function compiled for each width.
  template <int kWidth>
  void expand_here(T* x, int order);

  std::size_t products() const { return static_cast<std::size_t>(code_.products); }
  std::size_t operations() const { return static_cast<std::size_t>(code_.used); }

 private:
  using Instruction = typename ProgramCode<T>::Instruction;

  void start_other(const Instruction& in, T t);
  template <int kWidth>
  void sweep(int k);
  template <int kWidth, int kPacks>
  void sweep_lanes(int k, int lane);
  template <bool kBegins>
  void run_order(int k);
  void put_rates(const T* found, int k);
  template <bool kBegins>
  void run_instruction(const Instruction& in, int k);

  T* row(int k) { return rows_.data() + static_cast<std::ptrdiff_t>(k) * (2 * code_.lanes); }

  int width_ = 2;
  ProgramCode<T> code_;
  AlignedNumbers<T> now_;   ///< coefficients of the present order, by place
  AlignedNumbers<T> next_;  ///< those of the state's next order
  AlignedNumbers<T> zero_;  ///< those of order 0
  AlignedNumbers<T> rows_;  ///< factors of the products: for each order the left ones, then the right ones, by lane
  AlignedNumbers<T>
      sums_;  ///< what the products of two orders are without their newest terms: of the even one, then of the odd
  std::vector<GivenFunction<T>> given_;
  std::vector<std::vector<std::array<T, 3>>> given_rows_;
};
extern template class Program<double>;
extern template class Program<float80>;
extern template class Program<float128>;

}  // namespace earthtop::taylor
