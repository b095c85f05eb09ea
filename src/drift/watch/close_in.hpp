// SPDX-License-Identifier: GPL-3.0-or-later
/// Closes in on the root of a function between two points at which its signs differ.
#pragma once

#include <algorithm>

#include "earthtop/real.hpp"

namespace earthtop {

/// Regula falsi with the weights of Anderson and Bjorck (BIT 13 (1973) 253), which converges with order 1.7. Where three
/// evaluations have not halved the bracket, it is bisected. The search ends when the bracket is as narrow as T can resolve. It
/// returns nothing: f sees every point that is tried, and may note what its caller wants to know.
/// @param a, fa, b, fb  the ends of the bracket, a < b, and the values of f there   @param f  the function
/// @param enough  asked after every evaluation whether the search may end
template <class T, class F, class Enough>
void close_in(T a, T fa, T b, T fb, const F& f, const Enough& enough) {
  constexpr int kMost = 200;
  T width = b - a;
  int side = 0;  // the end that the last point tried has replaced: -1 for a, 1 for b
  for (int i = 0, since = 0; i < kMost && fa != T(0) && fb != T(0); ++i) {
    const T least = T(4) * real::epsilon<T>() * std::max(real::abs(a), real::abs(b));
    if (b - a <= least) return;
    const bool slow = since >= 3;
    const T line = slow ? T(a + (b - a) / T(2)) : T(b - fb * ((b - a) / (fb - fa)));
    // Keep off the ends: the root may lie very close to one.
    const T x = std::clamp(line, T(a + least / T(4)), T(b - least / T(4)));
    if (!(x > a && x < b)) return;
    const T fx = f(x);
    const bool takes_b = (fx > T(0)) == (fb > T(0));
    const T weight = T(1) - fx / (takes_b ? fb : fa);
    const T factor = weight > T(0) ? weight : T(0.5);
    if (takes_b) {
      if (side == 1 && !slow) fa *= factor;
      b = x, fb = fx, side = 1;
    } else {
      if (side == -1 && !slow) fb *= factor;
      a = x, fa = fx, side = -1;
    }
    if (enough()) return;
    ++since;
    if (b - a <= width / T(2)) since = 0, width = b - a;
    if (slow) since = 0, width = b - a;
  }
}

}  // namespace earthtop
