// SPDX-License-Identifier: GPL-3.0-or-later
/// Random tops on a table, by the law of friction: toy tops, sleeping tops, tippe tops, balls and bodies without symmetry, point
/// tips, tilted tables, spinning friction and rolling resistance, gravity gradient and tide, latitudes with poles and equator,
/// both matching rules.
#pragma once

#include "bounds/strata.hpp"

namespace earthtop::testing {

std::span<const Stratum> table_strata();

/// Scene `index` of a stratum, the same on every platform: valid, with a dozen rows over 0.3 to `longest_s` seconds, or less where
/// one of its rates turns or relaxes through `largest_phase` before.
Scenario random_scene_on_table(const Stratum& stratum, std::uint64_t index, double longest_s = 20, double largest_phase = 3000);

}  // namespace earthtop::testing
