// SPDX-License-Identifier: GPL-3.0-or-later
/// What passes between the scheduler of a batch and the kernels that advance eight points side by side: plain numbers, and
/// nothing that has code of its own. The kernels are compiled for several instruction sets; a function that such a source
/// shared with others could end up in the program compiled for a processor that is not there.
#pragma once

#include <cstddef>

namespace earthtop::lanes {

/// Points side by side in a block; a multiple of every instruction set's width.
inline constexpr int kLanes = 8;
/// The highest order of a series.
inline constexpr int kMostOrder = 32;
inline constexpr int kMostVariables = 24, kMostStored = 48, kMostConstants = 24, kMostGroups = 7;

/// Components of a state that the step control measures together, as `ComponentGroup` has them.
/// `turns`: unit vectors and quaternions, whose change is an angle.
struct Group {
  int begin, count;
  bool turns;
};

/// One number for each lane.
struct alignas(64) Row {
  double lane[kLanes];
};

/// Eight points at the beginning of a step, and what the step made of them. Times in each point's own unit.
struct Block {
  // Set by the scheduler.
  int order;                      ///< of the series, at least 2
  double tolerance_squared;       ///< of the last terms against the groups' sizes
  Row constants[kMostConstants];  ///< of the equations
  Row longest;                    ///< no step is longer
  // Advanced by a step.
  Row x[kMostVariables];     ///< the state
  Row rest[kMostVariables];  ///< what its sums left out
  Row squares[kMostGroups];  ///< the largest size each group has had, squared
  // Told of the last step.
  Row step;
  Row unfinite;                     ///< 0 where every component of the state is finite, else no number
  Row first_turn, second_turn;      ///< the largest turning group's first and second coefficient, squared
  Row rest_before[kMostVariables];  ///< of the state at its beginning
  /// The series, in the kernel's own order.
  Row series[(kMostOrder + 1) * kMostStored];
};

/// The functions of one kernel.
struct Kernel {
  /// Expands the state of every lane, chooses each lane's step, and takes it.
  void (*step)(Block& block);
  /// The states at times `after` the beginning of the last step, of lanes whose bit is set in `wanted`; other lanes' `x` is
  /// left or overwritten.
  void (*evaluate)(const Block& block, const Row& after, unsigned wanted, Row* x);
};

}  // namespace earthtop::lanes
