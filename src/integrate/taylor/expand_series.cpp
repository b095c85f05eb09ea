// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrate/taylor/expand_series.hpp"

#include "integrate/taylor/for_each_processor.hpp"

namespace earthtop {

void expand_series(GeneralMotionSeries<double>& series, std::array<double, 7>* x, int order) {
  taylor::expand_for_processor(series, x, order);
}
void expand_series(ReducedMotionSeries<double, MotionSought::attitude>& series, std::array<double, 9>* x, int order) {
  taylor::expand_for_processor(series, x, order);
}
void expand_series(ReducedMotionSeries<double, MotionSought::symmetry_axis>& series, std::array<double, 6>* x, int order) {
  taylor::expand_for_processor(series, x, order);
}

}  // namespace earthtop
