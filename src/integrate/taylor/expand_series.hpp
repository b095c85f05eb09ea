// SPDX-License-Identifier: GPL-3.0-or-later
/// Expands series; those of doubles by functions that are compiled for each width of vectors. The arithmetic is the same.
#pragma once

#include "integrate/inline_all.hpp"
#include "integrate/taylor/general_motion_series.hpp"
#include "integrate/taylor/reduced_motion_series.hpp"

namespace earthtop {

/// Finds the coefficients of the orders 1 to `order` of a series. @param x  the coefficients, with that of order 0
template <class Series>
EARTHTOP_INLINE_ALL void expand_series(Series& series, typename Series::State* x, int order) {
  series.template expand_here<4>(x, order);
}
void expand_series(GeneralMotionSeries<double>& series, std::array<double, 7>* x, int order);
void expand_series(ReducedMotionSeries<double, MotionSought::attitude>& series, std::array<double, 9>* x, int order);
void expand_series(ReducedMotionSeries<double, MotionSought::symmetry_axis>& series, std::array<double, 6>* x, int order);

}  // namespace earthtop
