// SPDX-License-Identifier: GPL-3.0-or-later
/// When a free body that spins nearly about the axis of its middle moment turns over.
#pragma once

#include <optional>

#include "earthtop/vectors.hpp"

namespace earthtop {

/// Three different principal moments along the body axes, A < B < C, and the body axes that have them.
struct Moments {
  double A = 0, B = 0, C = 0;
  int a = 0, b = 1, c = 2;
  /// Whether the axes a, b, c are right-handed (1) or left-handed (-1).
  double handed() const { return (b - a + 3) % 3 == 1 ? 1 : -1; }
};
/// @returns nothing where there are products of inertia, or where two moments are nearly equal
std::optional<Moments> three_moments(const Mat3<double>& I_BP_B);

struct TurnOver {
  double growth_1_s = 0;          ///< rate at which a motion across the axis grows
  std::optional<double> first_s;  ///< when the spin first changes its sense; empty where it does not: the motion does not grow
  std::optional<double> again_s;  ///< time from one turn to the next
  double left_out_s = 0;          ///< size of what the theory leaves out of first_s
  double smallness = 0;           ///< size of the motion across the axis beside the largest that it reaches
};

/// Next to a spin s about the middle axis, x = sqrt(A (B - A)) w_a and y = sqrt(C (C - B)) w_c change by x' = -growth y, y' = -growth x, with
/// growth = |s| sqrt((B - A)(C - B)/(A C)), for a right-handed order of the axes and s > 0: x - y grows and x + y falls. Between the two ends of the axis
/// the body follows the separatrix, x = X/cosh(growth (t - t0)) with X = |s| sqrt(B (B - A)(C - B)/(C - A)), which joins the two: the spin is 0
/// at ln(4 X/|x - y|)/growth, and again after ln(16 X^2/|x^2 - y^2|)/growth, as the elliptic integral has it near the separatrix.
/// @param w_B  rate in space at the release (rad/s)   @returns nothing where it is not nearly along the axis
std::optional<TurnOver> turn_over(const Moments& moments, const Vec3<double>& w_B);

}  // namespace earthtop
