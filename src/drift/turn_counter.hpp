// SPDX-License-Identifier: GPL-3.0-or-later
/// Counts how often an angle, given as its sine and cosine times a positive number, goes round.
#pragma once

#include "earthtop/real.hpp"

namespace earthtop {

template <class T>
class TurnCounter {
 public:
  /// Each step less than half a turn: the straight line between the two points crosses the cut, the negative cosine axis, or
  /// does not.
  void follow(T sine, T cosine) {
    const bool was_below = sine_ < T(0), is_below = sine < T(0);
    if (was_below != is_below) {
      const T crossing = cosine_ * sine - cosine * sine_;  // where the line meets the cosine axis, times (sine - sine_)
      if (is_below ? crossing > T(0) : crossing < T(0)) turns_ += is_below ? 1 : -1;
    }
    sine_ = sine, cosine_ = cosine;
  }
  /// What to add to the angle between -pi and pi (rad).
  T offset() const { return static_cast<T>(turns_) * (T(2) * real::pi<T>()); }

 private:
  T sine_ = T(0), cosine_ = T(1);
  long turns_ = 0;
};

}  // namespace earthtop
