// SPDX-License-Identifier: GPL-3.0-or-later
/// The operations of a recorded right-hand side, put in order for the expansion of its series (program.hpp).
///
/// Each result has a place in an array of coefficients; the state comes first. Products and sums are taken in packs of four,
/// whose results lie side by side. Sums are written out as far as each is used once, together with the factors that are held
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
  static constexpr int kPack = 4;

  /// An operation as it is carried out at the beginning of a step, and, unless it is a sum or a product, at each order.
  struct Instruction {
    Kind kind = Kind::constant;
    int out = -1, a = -1, b = -1;
    int lane = -1;  ///< of the first product of series that it sums; -1: none, as it has no order but 0
    int first_term = 0, terms = 0;
    T number = T(0);
    bool holds = false;  ///< whether a term of the sum has another factor that is held over the step
  };
  /// A term of a sum at the beginning of a step.
  struct Term {
    int place = -1;
    T factor = T(0);
    int held = -1;  ///< place of another factor; read only where the sum holds one
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
  /// A component of a given function.
  struct GivenComponent {
    int out, function, component;
  };

  std::vector<Constant> constants;
  std::vector<Instruction> at_start;  ///< apart from states and constants
  std::vector<StartRun> start_runs;
  std::vector<Term> start_terms;
  /// The work at each order is coded as kEnd, kProducts, kInstruction, or kSums plus the number of terms of each sum.
  static constexpr int kEnd = 0, kProducts = 1, kInstruction = 2, kSums = 3;
  std::vector<int> steps;
  /// For each pack of products the places of the left factors and of the right ones; for each pack of sums those of each term;
  /// at last those of the components of dx/dt. Results and lanes of the packs follow one another.
  std::vector<std::uint32_t> operands;
  int first_result = 0, first_output = 0;
  AlignedNumbers<T> factors;
  std::vector<Instruction> instructions;
  std::vector<GivenComponent> given;
  int components = 0;  ///< of dx/dt
  std::vector<Guard> guards;
  int used = 0;   ///< operations of the recorded list that are carried out
  int time = -1;  ///< place; -1: unused
  int places = 0, products = 0, lanes = 0;
};

template <class T>
ProgramCode<T> program_code(const Operations<T>& operations);
extern template ProgramCode<double> program_code(const Operations<double>&);
extern template ProgramCode<float80> program_code(const Operations<float80>&);
extern template ProgramCode<float128> program_code(const Operations<float128>&);

}  // namespace earthtop::taylor
