// SPDX-License-Identifier: GPL-3.0-or-later
/// Expands the series of a symmetric top's drift; that of doubles by functions that are compiled for each width of vectors.
#pragma once

#include "drift/pivot/reduced_drift_series.hpp"
#include "integrate/inline_all.hpp"

namespace earthtop {

/// Finds the coefficients of the orders 1 to `order`. @param x  the coefficients, with that of order 0
template <class T, Observer O>
EARTHTOP_INLINE_ALL void expand_series(ReducedDriftSeries<T, O>& series, std::array<T, 16>* x, int order) {
  series.template expand_here<4>(x, order);
}
void expand_series(ReducedDriftSeries<double, Observer::laboratory>& series, std::array<double, 16>* x, int order);
void expand_series(ReducedDriftSeries<double, Observer::inertial>& series, std::array<double, 16>* x, int order);

}  // namespace earthtop
