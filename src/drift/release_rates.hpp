// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "earthtop/drift/drift_integration.hpp"

namespace earthtop {

/// Sets the rates of both motions at release to the given ones, instead of those computed back from an angular momentum.
template <class T>
void set_release_rates(const DriftProblem<T>& problem, DriftState<T>& state) {
  if (!problem.model.journey.empty()) return;  // the problem's release is relative to other axes
  const Release<T>& release = problem.release;
  state.ref_w_LB_B = release.w_XB_B;
  // The gimbals' bearings hold the body back: its inertial rate is not that of the reference.
  if (problem.model.kind == SceneKind::suspension && release.X == RatesRelativeTo::inertial) return;
  state.w_LB_B = release.w_XB_B;
  if (release.X == RatesRelativeTo::inertial) {
    const Mat3<T> R_LB = rotation_matrix(problem.released_attitude());
    for (int i = 0; i < 3; ++i) state.w_LB_B[i] -= problem.units.rate_to_rad_s(transposed_times(R_LB, problem.model.W_IL_L)[i]);
  }
}

}  // namespace earthtop
