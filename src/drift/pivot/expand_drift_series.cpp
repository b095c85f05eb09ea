// SPDX-License-Identifier: GPL-3.0-or-later
#include "drift/pivot/expand_drift_series.hpp"

#include "integrate/taylor/for_each_processor.hpp"

namespace earthtop {

void expand_series(ReducedDriftSeries<double, Observer::laboratory>& series, std::array<double, 16>* x, int order) {
  taylor::expand_for_processor(series, x, order);
}
void expand_series(ReducedDriftSeries<double, Observer::inertial>& series, std::array<double, 16>* x, int order) {
  taylor::expand_for_processor(series, x, order);
}

}  // namespace earthtop
