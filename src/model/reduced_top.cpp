// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/reduced_top.ipp"

namespace earthtop {

template ReducedTop<double> reduced_top(const Model<double>&);
template ReducedTop<float80> reduced_top(const Model<float80>&);
template ReducedTop<float128> reduced_top(const Model<float128>&);

}  // namespace earthtop
