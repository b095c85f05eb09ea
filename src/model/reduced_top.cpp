// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/model/reduced_top.hpp"

#include <stdexcept>

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
template ReducedTop<double> reduced_top(const Model<double>&);
template ReducedTop<long double> reduced_top(const Model<long double>&);
template ReducedTop<float128> reduced_top(const Model<float128>&);

}  // namespace earthtop
