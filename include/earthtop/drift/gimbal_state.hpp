// SPDX-License-Identifier: GPL-3.0-or-later
/// The gimbals of a Cardan suspension (model/gimbals.hpp) in both motions.
#pragma once

#include "earthtop/drift/drift.hpp"
#include "earthtop/model/gimbals.hpp"
#include "earthtop/model/paired.hpp"

namespace earthtop {

template <class T>
GimbalHeadline headline_of(const Gimbals<T>& gimbals) {
  if (gimbals.has_rotor || gimbals.outer.locked == gimbals.inner.locked) return GimbalHeadline::axis;
  return gimbals.outer.locked ? GimbalHeadline::inner : GimbalHeadline::outer;
}

/// Angles (rad) and rates (rad/s), differences over epsilon of the drift state.
template <class T>
struct GimbalState {
  Paired<T> outer, inner, outer_rate, inner_rate;
  GimbalHeadline headline = GimbalHeadline::axis;
};

}  // namespace earthtop
