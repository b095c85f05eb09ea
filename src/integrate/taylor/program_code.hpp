// SPDX-License-Identifier: GPL-3.0-or-later
/// The operations of a recorded right-hand side, put in order for the expansion of its series (program.hpp).
///
/// Each result has a place in an array of coefficients; the state comes first. Products and sums are taken four at a time, and
/// their results lie side by side. Sums are written out as far as each is used once, together with the factors that are held
/// over a step.
#pragma once

#include <boost/align/aligned_allocator.hpp>
#include <cstdint>
#include <vector>

#include "earthtop/real.hpp"
#include "integrate/taylor/operations.hpp"

namespace earthtop::taylor {

/// Numbers that vectors of any width can be loaded from.
template <class T>
using AlignedNumbers = std::vector<T, boost::alignment::aligned_allocator<T, 64>>;

template <class T>
struct ProgramCode {
  /// Results that are taken together.
  static constexpr int kTogether = 4;

  /// An operation as it is carried out at the beginning of a step, and, unless it is a sum or a product, at each order.
  struct Instruction {
    Kind kind = Kind::constant;
    int out = -1, a = -1, b = -1;
    int lane = -1;  ///< of the first product of series that it sums; -1: none, as it has no order but 0
    int first_term = 0, terms = 0;
    T number = T(0);
  };
  /// A term of a sum at the beginning of a step.
  struct Term {
    int place = -1;
    T factor = T(0);
    int held = -1;  ///< place of another factor
    int slot = -1;  ///< where the product of both is kept for the other orders
  };
  /// Instructions of one kind, one after the other.
  struct StartRun {
    Kind kind = Kind::constant;
    int begin = 0, end = 0;
  };
  struct Constant {
    int out;
    T number;
  };
  /// Operations of one kind at each order, one after the other.
  struct Run {
    Kind kind = Kind::constant;
    int count = 0;       ///< fours of products or sums; instructions of any other kind
    int terms = 0;       ///< of each sum
    int out = 0;         ///< place of the first result
    int first = 0;       ///< in `operands`, or in `instructions`
    int first_slot = 0;  ///< of the factors of sums
    int lane = 0;        ///< of the first product
  };
  /// A component of a given function.
  struct GivenComponent {
    int out, function, component;
  };

  std::vector<Constant> constants;
  std::vector<Instruction> at_start;  ///< apart from states and constants
  std::vector<StartRun> start_runs;
  std::vector<Term> start_terms;
  std::vector<Run> runs;
  std::vector<std::uint32_t> operands;  ///< of four products: the left ones, the right ones; of four sums: those of each term
  AlignedNumbers<T> factors;
  std::vector<Instruction> instructions;
  std::vector<GivenComponent> given;
  std::vector<int> outputs;
  std::vector<Guard> guards;
  int used = 0;   ///< operations of the recorded list that are carried out
  int time = -1;  ///< place; -1: unused
  int places = 0, products = 0, lanes = 0;
};

template <class T>
ProgramCode<T> program_code(const Operations<T>& operations);
extern template ProgramCode<double> program_code(const Operations<double>&);
extern template ProgramCode<long double> program_code(const Operations<long double>&);
extern template ProgramCode<float128> program_code(const Operations<float128>&);

}  // namespace earthtop::taylor
