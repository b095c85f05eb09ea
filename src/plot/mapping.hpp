// SPDX-License-Identifier: GPL-3.0-or-later
/// The way from data to px along one axis.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "earthtop/elementary.hpp"
#include "earthtop/plot/plot.hpp"
#include "plot/ticks.hpp"

namespace earthtop {

/// Whether a value has a place on an axis.
inline bool drawable(double value, AxisScale scale) {
  return std::isfinite(value) && (scale == AxisScale::linear || value > 0);
}

/// An axis with its ticks, and the transformation from data to px.
struct Mapping {
  Ticks axis;
  AxisScale scale;
  double from, to;   ///< px of axis.low and axis.high
  double low, high;  ///< the ends of the axis, or their logarithms

  Mapping(Ticks ticks, AxisScale axis_scale, double from_px, double to_px)
      : axis(std::move(ticks)), scale(axis_scale), from(from_px), to(to_px), low(scaled(axis.low)), high(scaled(axis.high)) {}
  double operator()(double value) const {
    const double share = (scaled(value) - low) / (high - low);
    return from + std::clamp(share, -0.5, 1.5) * (to - from);
  }

 private:
  /// Halving keeps the difference of two huge ends finite.
  double scaled(double value) const { return scale == AxisScale::linear ? value / 2 : real::log10(value); }
};

}  // namespace earthtop
