// SPDX-License-Identifier: GPL-3.0-or-later
/// Gauss collocation of order 12, on odeint's stepper concept: do_step(system, x, t, dt). The method is implicit, symmetric,
/// and symplectic for a canonical Hamiltonian system. Over millions of steps it keeps the conserved quantities of a motion
/// without a trend.
///
/// Hairer, Lubich and Wanner, Geometric Numerical Integration, 2nd ed., sections VIII.5 and VIII.6 (fixed-point iteration,
/// starting values, compensated sums); Hairer, McLachlan and Razakarivony 2008 (iteration until the changes no longer fall,
/// since stopping at a fixed size would leave errors of one sign).
#pragma once

#include <array>

#include "integrate/gauss_tables.hpp"
#include "integrate/group_norms.hpp"

namespace earthtop {

/// @tparam Shape  the shape of the state, see GroupScales
template <class Shape>
class GaussStepper {
 public:
  static constexpr std::size_t N = Shape::kSize;
  static constexpr std::size_t S = 6;
  using State = std::array<double, N>;
  explicit GaussStepper(const GroupScales<double, Shape>& scales) : scales_(&scales) {}

  /// Takes a step. @returns whether the iteration has converged; if not, x is unchanged
  template <class RightHandSide>
  bool do_step(const RightHandSide& system, State& x, double t, double dt) {
    start(system, x, t);
    double change_before = 0;
    for (int iteration = 1;; ++iteration) {
      const double change = iterate(system, x, t, dt);
      // Converged: there is no change, or the changes have stopped falling, at a size far below any error of the method.
      if (change == 0 || (change < kNearlyAtRest && iteration > 1 && change >= change_before)) break;
      if (!(change < 1e20) || iteration == kMostIterations) {
        known_ = false;
        return false;
      }
      change_before = change;
    }
    for (std::size_t i = 0; i < N; ++i) {
      double rise = 0;
      for (std::size_t j = 0; j < S; ++j) rise += tables_.b[j] * slope_[j][i];
      const double y = dt * rise + carry_[i];
      const double sum = x[i] + y;
      carry_[i] = y - (sum - x[i]);
      x[i] = sum;
    }
    known_ = true;
    return true;
  }
  /// To be called before a step of another length, about which the last step's slopes say nothing.
  void reset() {
    known_ = false;
    carry_ = {};
  }

 private:
  static constexpr int kMostIterations = 60;
  static constexpr double kNearlyAtRest = 1e-12;  ///< largest change that may be round-off, relative to each group's size

  /// Sets the slopes at the nodes with which the iteration starts: those of the last step's polynomial, or that at the
  /// beginning of the step.
  template <class RightHandSide>
  void start(const RightHandSide& system, const State& x, double t) {
    if (!known_) {
      system(x, slope_[0], t);
      for (std::size_t i = 1; i < S; ++i) slope_[i] = slope_[0];
      return;
    }
    const auto last = slope_;
    for (std::size_t i = 0; i < S; ++i)
      for (std::size_t k = 0; k < N; ++k) {
        double sum = 0;
        for (std::size_t j = 0; j < S; ++j) sum += tables_.next[i][j] * last[j][k];
        slope_[i][k] = sum;
      }
  }

  /// Makes one round over the nodes, each with the newest slopes of the others. @returns how far the stages have moved
  template <class RightHandSide>
  double iterate(const RightHandSide& system, const State& x, double t, double dt) {
    double change = 0;
    for (std::size_t i = 0; i < S; ++i) {
      State stage, slope, difference;
      for (std::size_t k = 0; k < N; ++k) {
        double sum = 0;
        for (std::size_t j = 0; j < S; ++j) sum += tables_.a[i][j] * slope_[j][k];
        stage[k] = x[k] + (dt * sum + carry_[k]);
      }
      system(stage, slope, t + tables_.c[i] * dt);
      for (std::size_t k = 0; k < N; ++k) difference[k] = dt * (slope[k] - slope_[i][k]);
      change = std::max(change, scales_->largest_error(1.0, slope, difference, 0.0));
      slope_[i] = slope;
    }
    return change;
  }

  const GaussTables<S>& tables_ = gauss_tables<S>();
  const GroupScales<double, Shape>* scales_;
  std::array<State, S> slope_;
  State carry_{};
  bool known_ = false;
};

}  // namespace earthtop
