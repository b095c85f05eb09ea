// SPDX-License-Identifier: GPL-3.0-or-later
/// Owns the code and the numbers of a recorded right-hand side for eight points side by side (lane_code.hpp).
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "integrate/lanes/lane_code.hpp"
#include "integrate/taylor/program_code.hpp"

namespace earthtop::lanes {

/// A recorded right-hand side of one point.
struct RecordedCode {
  explicit RecordedCode(const taylor::Operations<double>& operations)
      : code(taylor::program_code(operations)), given(operations.given) {}
  taylor::ProgramCode<double> code;
  std::vector<taylor::GivenFunction<double>> given;
};
/// Whether two points have the same code, apart from its numbers.
bool have_same_code(const RecordedCode& a, const RecordedCode& b);

class LaneProgram {
 public:
  /// @param width  lanes of a chunk: how many doubles the vectors of the kernel have
  LaneProgram(const RecordedCode& first, int width);
  /// Puts the numbers of a point into a lane. @param point  has the same code; kept by reference until the next one
  void put(std::size_t lane, const RecordedCode& point);
  /// Sets the time at the beginning of a lane's next step.
  void set_time(std::size_t lane, double t);
  /// Whether a lane's point left the branch that was recorded, at the beginning of the last step.
  bool is_off_branch(std::size_t lane) const { return read_.off_branch.lane[lane] != 0.0; }
  LaneCode* code() { return &read_; }

 private:
  void find_slots();

  using Rows = std::vector<Row>;
  using Doubles = taylor::AlignedNumbers<double>;
  /// A number of a lane among those of all chunks. @param count  numbers of each lane
  double& at(Doubles& numbers, std::size_t count, std::size_t number, std::size_t lane) const {
    return numbers[(lane / width_ * count + number) * width_ + lane % width_];
  }
  struct Numbers {
    Rows starts, start_factors, instructions, given;
  };

  taylor::ProgramCode<double> code_;
  std::vector<LaneInstruction> starts_, instructions_;
  std::vector<LaneTerm> terms_;
  std::vector<LaneGiven> given_;
  std::vector<LaneGuard> guards_;
  Numbers numbers_;
  std::size_t width_;
  std::vector<int> slot_places_, product_slots_;
  Doubles zero_, present_, factors_, history_, sums_;
  std::vector<int> first_given_row_;  ///< of each function
  std::array<const RecordedCode*, kLanes> points_{};
  std::vector<std::array<double, 3>> expanded_;
  LaneCode read_{};
};

}  // namespace earthtop::lanes
