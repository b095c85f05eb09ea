// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "earthtop/drift/drift_integration.hpp"

namespace earthtop {

/// Sets the rates of both motions at release to the given ones, instead of those computed back from an angular momentum.
template <class T>
void set_release_rates(const DriftProblem<T>& problem, DriftState<T>& state) {
  const Release<T>& release = problem.release;
  state.ref_w_LB_B = release.w_XB_B;
  state.w_LB_B = release.w_XB_B;
  // On a table the release's attitude is that relative to the table.
  const Quaternion<T> q_LB = problem.table ? problem.table->start.q_LH * release.q_LB : release.q_LB;
  if (release.X == RatesRelativeTo::inertial)
    for (int i = 0; i < 3; ++i)
      state.w_LB_B[i] -= problem.units.rate_to_rad_s(transposed_times(rotation_matrix(q_LB), problem.model.W_IL_L)[i]);
}

}  // namespace earthtop
