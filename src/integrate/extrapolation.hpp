// SPDX-License-Identifier: GPL-3.0-or-later
/// Extrapolation of Gragg's modified midpoint rule with adaptive order and step, for every scalar, on odeint's
/// controlled-stepper concept (odeint's own bulirsch_stoer does not build for float128).
///
/// Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, 2nd ed., section II.9: the midpoint rule in
/// n = 2, 4, 6, ... substeps has an error expansion in even powers of the substep; each column of Aitken and Neville's scheme
/// removes one power, so that column j has order 2j. Up to column j a step costs j^2 + 1 evaluations.
#pragma once

#include <algorithm>
#include <array>
#include <boost/numeric/odeint/stepper/controlled_step_result.hpp>
#include <cmath>

#include "integrate/group_norms.hpp"

namespace earthtop {

/// @tparam Shape  the shape of the state, see GroupScales
template <class T, class Shape>
class Extrapolation {
 public:
  static constexpr std::size_t N = Shape::kSize;
  using State = std::array<T, N>;
  static constexpr int kColumns = 16;  ///< order 32 at most

  Extrapolation(T relative_tolerance, const GroupScales<T, Shape>& scales)
      : tolerance_(relative_tolerance), scales_(&scales), limit_(least_column()) {
    // High columns are differences of large terms. Columns whose round-off would be mistaken for an error are left out.
    const auto room = static_cast<double>(T(2) * relative_tolerance / real::epsilon<T>());
    while (limit_ < kColumns && round_off_growth(limit_ + 1) < room) ++limit_;
    const double digits = -real::log10(static_cast<double>(relative_tolerance));
    target_ = std::clamp(static_cast<int>(0.5 * digits), least_column(), limit_);
  }

  /// Attempts a step. @param system  called with (x, dxdt, t)   @param dt  the step to try; afterwards the one to try next
  template <class RightHandSide>
  boost::numeric::odeint::controlled_step_result try_step(const RightHandSide& system, State& x, T& t, T& dt) {
    // The caller has cut the step short to land on an output time. Such a step says little about the best column of a long one.
    const bool cut_short = dt < T(0.99) * proposed_.step;
    const int last = std::min(target_ + 1, limit_);
    Proposal best;
    double error_before = 0;
    system(x, slope_, t);
    for (int j = 1; j <= last; ++j) {
      add_line(system, x, t, dt, j);
      if (j == 1) continue;
      const T error = line_error(j, dt);
      const Proposal column = propose(j, dt, static_cast<double>(error));
      if (error <= T(1)) {
        x = line_[j - 1];
        t += dt;
        const Proposal next = follow(column, best);
        if (!cut_short || next.work() < proposed_.work()) proposed_ = next;
        target_ = proposed_.column;
        after_rejection_ = false;
        dt = proposed_.step;
        return boost::numeric::odeint::success;
      }
      if (best.column == 0 || column.work() < best.work()) best = column;
      if (!all_finite(line_[j - 1]) || was_too_slow_when_coarser(j, last, static_cast<double>(error), error_before)) break;
      error_before = static_cast<double>(error);
    }
    best.step = std::max(best.step, T(T(0.1) * dt));
    proposed_ = best;
    target_ = best.column;
    after_rejection_ = true;
    dt = best.step;
    return boost::numeric::odeint::fail;
  }

 private:
  /// A column and the length of the step with which it would just meet the tolerance.
  struct Proposal {
    int column = 0;
    T step = T(0);
    /// Evaluations per unit of time.
    T work() const { return T(cost(column)) / step; }
  };

  static constexpr int least_column() { return 3; }
  static constexpr int cost(int column) { return column * column + 1; }

  /// The factor by which column k multiplies the round-off of the midpoint results: the sum of their absolute weights in it.
  static double round_off_growth(int k) {
    double sum = 0;
    for (int j = 1; j <= k; ++j) {
      double weight = 1;
      for (int i = 1; i <= k; ++i)
        if (i != j) weight *= static_cast<double>(j * j) / (j * j - i * i);
      sum += std::abs(weight);
    }
    return sum;
  }

  /// Computes line j of the scheme: the midpoint rule with 2 j substeps, and from it the columns 1 to j. Each column replaces
  /// that of the line before.
  template <class RightHandSide>
  void add_line(const RightHandSide& system, const State& x, T t, T dt, int j) {
    const int substeps = 2 * j;
    const T h = dt / T(substeps);
    State before = x, now;
    for (std::size_t i = 0; i < N; ++i) now[i] = x[i] + h * slope_[i];
    for (int m = 1; m < substeps; ++m) {
      system(now, substep_slope_, t + T(m) * h);
      for (std::size_t i = 0; i < N; ++i) {
        const T next = before[i] + T(2) * h * substep_slope_[i];
        before[i] = now[i];
        now[i] = next;
      }
    }
    for (int k = 1; k < j; ++k) {
      const int coarse = j - k;
      const T weight = T(coarse * coarse) / T(j * j - coarse * coarse);
      for (std::size_t i = 0; i < N; ++i) {
        const T next = now[i] + weight * (now[i] - line_[k - 1][i]);
        line_[k - 1][i] = now[i];
        now[i] = next;
      }
    }
    line_[j - 1] = now;
  }

  /// The error of line j over the tolerance: its last two columns differ by the error of the lower one.
  T line_error(int j, T dt) const {
    State difference;
    for (std::size_t i = 0; i < N; ++i) difference[i] = line_[j - 1][i] - line_[j - 2][i];
    return scales_->largest_error(tolerance_, slope_, difference, dt);
  }

  /// The step proposed for column j, whose error grows with the power 2 j - 1 of the step. For the safety factors see section
  /// II.9 around eq. (9.28).
  static Proposal propose(int j, T dt, double error) {
    const double factor = 0.94 * real::pow(0.65 / std::max(error, 1e-30), 1.0 / (2 * j - 1));
    return {j, dt * T(std::min(factor, 4.0))};
  }

  /// The proposal after a column that converged: among its neighbours the column of least work.
  Proposal follow(const Proposal& converged, const Proposal& lower) const {
    Proposal next = converged;
    if (lower.column != 0 && lower.work() < T(0.8) * converged.work()) {
      next = lower;
    } else if (converged.column < limit_ && !after_rejection_ &&
               (lower.column == 0 || converged.work() < T(0.9) * lower.work())) {
      next.column = converged.column + 1;
      next.step *= T(cost(next.column)) / T(cost(converged.column));
    }
    next.column = std::max(next.column, least_column());
    return next;
  }

  /// Whether the error of line j is too large for the lines that may still come to bring it below the tolerance; asked from
  /// line `target - 1` on. Each line gains at least as much as the one before did, and in theory about (n_i / n_1)^2 (section
  /// II.9, eq. (9.30)).
  bool was_too_slow_when_coarser(int j, int last, double error, double error_before) const {
    if (j < target_ - 1) return false;
    double gain = 1;
    for (int i = j + 1; i <= last; ++i) gain *= std::max(static_cast<double>(i) * i, error_before / error);
    return error > gain;
  }

  T tolerance_;
  const GroupScales<T, Shape>* scales_;
  int limit_;
  int target_ = 0;
  Proposal proposed_;
  bool after_rejection_ = false;
  State slope_, substep_slope_;
  std::array<State, kColumns> line_;
};

}  // namespace earthtop
