// SPDX-License-Identifier: GPL-3.0-or-later
/// The Taylor series of a recorded right-hand side, for the stepper (taylor_stepper.hpp).
#pragma once

#include <array>
#include <functional>
#include <utility>

#include "integrate/taylor/program.hpp"

namespace earthtop {

/// @tparam N  number of components of the state
template <class T, std::size_t N>
class RecordedSeries {
 public:
  using State = std::array<T, N>;
  /// Records the right-hand side as it is at a state and a time: where it branches, on the branch that belongs to them.
  using Record = std::function<taylor::Operations<T>(const State& x, T t)>;

  explicit RecordedSeries(Record record) : record_(std::move(record)) {}

  void start(const State& x, T t) {
    if (is_recorded_) {
      program_.start(x, t);
      if (program_.guards_hold()) return;
    }
    program_ = taylor::Program<T>(record_(x, t));
    program_.start(x, t);
    is_recorded_ = true;
  }
  /// Whether the right-hand side is on the recorded branch there, too; the series of a step holds up to such a state only. To be
  /// asked after the last order of a step.
  bool reaches(const State& x, T t) {
    if (!program_.has_guards()) return true;
    program_.start(x, t);
    return program_.guards_hold();
  }
  /// Finds the coefficients of the orders 1 to `order`. @param x  the coefficients, with that of order 0
  void expand(State* x, int order) { program_.expand(x->data(), order); }

 private:
  Record record_;
  taylor::Program<T> program_;
  bool is_recorded_ = false;
};

}  // namespace earthtop
