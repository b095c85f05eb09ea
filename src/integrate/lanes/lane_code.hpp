// SPDX-License-Identifier: GPL-3.0-or-later
/// A recorded right-hand side (taylor/program_code.hpp) for eight points side by side, as the kernels read it. All points have one code;
/// each number in it has a lane for each point. Plain numbers only, as in block.hpp.
#pragma once

#include "integrate/lanes/block.hpp"

namespace earthtop::lanes {

/// The kinds of instructions, as in taylor/operations.hpp. A cosine is found with its sine.
enum LaneKind : int { kTime, kGiven, kHeld, kLinear, kProduct, kQuotient, kSquareRoot, kPower, kSine, kWithSine };

struct LaneInstruction {
  int kind;
  int out, a, b;  ///< places
  int product;    ///< number of the first product of series that it sums; -1: none
  int first_term, terms;
  int holds;  ///< whether a term of the sum has another factor that is held over the step
};
struct LaneTerm {
  int place, held, slot;
};
/// A component of a given function of time.
struct LaneGiven {
  int out, first;  ///< its place, and the row of its order 0 in `LaneCode::given_rows`
};
struct LaneGuard {
  int less, more, outcome;
};

struct LaneCode {
  const LaneInstruction* at_start;
  int starts;
  const LaneTerm* start_terms;
  /// The work at each order is coded as in taylor::ProgramCode.
  const int* steps;
  const unsigned* operands;
  const LaneInstruction* instructions;
  const LaneGiven* given;
  int givens;
  const LaneGuard* guards;
  int guard_count;
  int first_result, first_output, time;  ///< places; time is -1 where it is unused

  // Numbers of the equations.
  const Row* start_numbers;        ///< of `at_start`
  const Row* start_factors;        ///< of `start_terms`
  const Row* instruction_numbers;  ///< of `instructions`
  const Row* given_rows;           ///< of each component kMostOrder + 1 coefficients, set before a step
  Row now;                         ///< the time at the beginning of the step, set before it

  // The factors of products, of which few are different: each has a slot. First come results that are factors, then the factors of other
  // operations, which are no results.
  const int* slot_places;    ///< places of the results
  const int* product_slots;  ///< of each pack of four products the slots of the left factors, then those of the right ones

  // What an expansion works on: the numbers of the first chunk (the lanes of one vector), then those of the next one.
  int places, factor_count, packs, slots, result_slots;  ///< how many there are
  double* zero;                                          ///< coefficients of order 0, by place; constants are there
  double* present;                                       ///< those of the present order
  double* factors;  ///< of the sums; those that are held over a step are found at its beginning
  double* history;  ///< of each order the factors of products, by slot
  double*
      sums;  ///< of each product what two orders are without their newest terms: for each pack four of the even, four of the odd one
  Row off_branch;  ///< whether a comparison has another outcome than when the right-hand side was recorded: 0 or 1

  // Functions for a lane, whose last digits depend on a library.
  void (*sin_cos)(double x, double* sine, double* cosine);
  double (*power)(double x, double exponent);
  double (*square_root)(double x);
};

}  // namespace earthtop::lanes
