// SPDX-License-Identifier: GPL-3.0-or-later
/// Counts how often an angle goes round, which is given by its sine and cosine, both times a positive number.
#pragma once

#include "earthtop/real.hpp"

namespace earthtop {

template <class T>
class TurnCounter {
 public:
  /// Goes on to the next value of the angle, which must differ from the last by less than half a turn. A turn is counted if the
  /// straight line between the two points crosses the cut, which is the negative cosine axis. A point that is half a turn away, as
  /// between two motions through the vertical itself, has no side: it is passed over.
  void follow(T sine, T cosine) {
    constexpr double kOpposite = 1e-3;  // rad
    const T along = cosine_ * cosine + sine_ * sine;
    if (along < T(0) && real::abs(T(cosine_ * sine - cosine * sine_)) < T(-kOpposite) * along) return;
    const bool was_below = sine_ < T(0), is_below = sine < T(0);
    if (was_below != is_below) {
      const T crossing = cosine_ * sine - cosine * sine_;  // where the line meets the cosine axis, times (sine - sine_)
      if (is_below ? crossing > T(0) : crossing < T(0)) turns_ += is_below ? 1 : -1;
    }
    sine_ = sine, cosine_ = cosine;
  }
  /// The whole turns counted so far (rad). Added to the angle between -pi and pi, they make it continuous.
  T offset() const { return static_cast<T>(turns_) * (T(2) * real::pi<T>()); }

 private:
  T sine_ = T(0), cosine_ = T(1);
  long turns_ = 0;
};

}  // namespace earthtop
