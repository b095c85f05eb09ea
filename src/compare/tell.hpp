// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "earthtop/results/results.hpp"
#include "earthtop/watch.hpp"

namespace earthtop::compare {

/// Tells a watch how much of a comparison is done. @throws Interrupted if the watch asks to stop
inline void tell(const Watch& watch, double share) {
  if (watch.asks_to_stop()) throw Interrupted();
  watch.reach(share);
}

}  // namespace earthtop::compare
