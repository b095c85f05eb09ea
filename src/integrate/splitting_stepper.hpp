// SPDX-License-Identifier: GPL-3.0-or-later
/// Composes the two exact flows of a system, on odeint's stepper concept: do_step(system, x, t, dt). The method is explicit,
/// symmetric, and symplectic where the flows are.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "integrate/compositions.hpp"
#include "integrate/reduced_motion_flows.hpp"

namespace earthtop {

/// A system that splits. Its `flows()` have the exact flows `free(h, state)` and `kick(h, t, kick_at(after), state)`,
/// `end(end_of(h), state)`, which ends each step, and `rate(x)`.
template <class System>
concept Splits = requires(const System& system) {
  system.flows();
};

template <class Flows>
class SplittingStepper {
 public:
  using State = typename Flows::State;
  SplittingStepper(const Flows& flows, const CompositionTable& table) : flows_(flows), table_(table) {}

  /// Takes a step. If its length differs from that of the step before, the flows are prepared again.
  template <class System>
  bool do_step(const System&, State& x, double t, double dt) {
    if (dt != prepared_) prepare(dt);
    state_.x = x;
    const auto stages = static_cast<std::size_t>(table_.stages);
    for (std::size_t i = 0; i < stages; ++i) {
      flows_.free(a_[i], state_);
      flows_.kick(b_[i], t + at_[i], kicks_[i], state_);
    }
    flows_.free(a_[stages], state_);
    flows_.end(*end_, state_);
    x = state_.x;
    return true;
  }
  /// Forgets the round-off carried over from the last step.
  void reset() { state_.carry = {}; }
  /// Evaluations of the torque in a step, which is the number of kicks.
  std::int64_t evaluations_a_step() const { return table_.stages; }

 private:
  void prepare(double dt) {
    prepared_ = dt;
    a_ = lengths(table_.a.data(), table_.stages + 1, dt);
    b_ = lengths(table_.b.data(), table_.stages, dt);
    at_.clear(), kicks_.clear();
    double at = 0;
    for (const double length : a_) {
      at += length;
      at_.push_back(at);
      kicks_.push_back(flows_.kick_at(at));
    }
    end_ = flows_.end_of(dt);
  }
  /// The coefficients times dt, with a sum that is dt to the last bit: otherwise their roundings would let the flows' clock go
  /// wrong. The shortest one, which has the smallest rounding error itself, takes up the difference.
  static std::vector<double> lengths(const double* coefficients, int count, double dt) {
    std::vector<double> all(coefficients, coefficients + count);
    std::size_t shortest = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      all[i] *= dt;
      if (std::abs(all[i]) < std::abs(all[shortest])) shortest = i;
    }
    float80 rest = dt;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (i != shortest) rest -= static_cast<float80>(all[i]);
    all[shortest] = static_cast<double>(rest);
    return all;
  }

  Flows flows_;
  const CompositionTable& table_;
  CompensatedState<State> state_;
  double prepared_ = 0;
  std::vector<double> a_, b_, at_;
  std::vector<typename Flows::Kick> kicks_;
  std::optional<typename Flows::End> end_;
};

}  // namespace earthtop
