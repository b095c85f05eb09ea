// SPDX-License-Identifier: GPL-3.0-or-later
/// The data that the scheduler of a batch shares with the kernels that advance eight points side by side: plain numbers, and
/// nothing that has code of its own. The kernels are compiled once for each instruction set. If they shared a function with
/// other sources, the linker could keep the version that is compiled for a processor that is not there.
#pragma once

#include <cstddef>

namespace earthtop::lanes {

/// Points side by side in a block; a multiple of every instruction set's width.
inline constexpr int kLanes = 8;
/// The highest order of a series.
inline constexpr int kMostOrder = 32;
inline constexpr int kMostVariables = 24, kMostStored = 48, kMostConstants = 24, kMostGroups = 8;

/// Components of a state that the step control measures together, like `ComponentGroup`. `turns` marks unit vectors and
/// quaternions, whose change is an angle.
struct Group {
  int begin, count;
  bool turns;
};

/// One number for each lane.
struct alignas(64) Row {
  double lane[kLanes];
};

struct LaneCode;

/// Eight points, their last step, and its series. Times are in each point's own unit.
struct Block {
  // Set by the scheduler.
  int order;                      ///< of the series, at least 2
  double tolerance_squared;       ///< square of the size that the last terms may have relative to their groups
  Row constants[kMostConstants];  ///< constants of the equations
  LaneCode* code;                 ///< of equations that are recorded (lane_code.hpp); else null
  Row longest;                    ///< limit to the step
  // Advanced by a step.
  Row x[kMostVariables];     ///< the state
  Row rest[kMostVariables];  ///< what rounding left out of the state's sums
  Row squares[kMostGroups];  ///< the largest size that each group has had, squared
  // Results of the last step.
  Row step;                         ///< its length
  Row not_finite;                   ///< 0 if every component of the state is finite, otherwise NaN
  Row first_turn, second_turn;      ///< largest first and second coefficients of all turning groups, squared
  Row rest_before[kMostVariables];  ///< `rest` at the beginning of the step
  /// The series of the step, in an order that the kernel chooses.
  Row series[(kMostOrder + 1) * kMostStored];
};

/// The functions of one kernel.
struct Kernel {
  /// Expands the state of every lane, chooses each lane's step, and takes it.
  void (*step)(Block& block);
  /// Finds the states at the times `after` the beginning of the last step, for the lanes whose bit is set in `wanted`. Those of
  /// other lanes in `x` may be overwritten.
  void (*evaluate)(const Block& block, const Row& after, unsigned wanted, Row* x);
};

}  // namespace earthtop::lanes
