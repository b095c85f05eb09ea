// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds the coefficients of a symmetric top, for the scalars of reduced_top.cpp and for jets.
#pragma once

#include <stdexcept>

#include "earthtop/model/reduced_top.hpp"

namespace earthtop {

template <class T>
ReducedTop<T> reduced_top(const Model<T>& model) {
  ReducedTop<T> top;
  top.axis = symmetry_axis(model.I_BP_B, model.mass_moment_B);
  if (top.axis < 0) throw std::logic_error("reduced_top: not a symmetric top");
  const int across = (top.axis + 1) % 3;
  top.I1 = model.I_BP_B(across, across);
  top.I3 = model.I_BP_B(top.axis, top.axis);
  top.spin_ratio = top.I3 / top.I1;
  top.spin_ratio_rest = real::fma(-top.spin_ratio, top.I1, top.I3) / top.I1;
  top.moment_ratio = model.mass_moment_B[top.axis] / top.I1;
  return top;
}

}  // namespace earthtop
