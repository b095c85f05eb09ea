// SPDX-License-Identifier: GPL-3.0-or-later
/// Chooses what the page draws of a run: the same as the run's own page.
#pragma once

#include <string>
#include <string_view>

#include "earthtop/run.hpp"

namespace earthtop::play {

/// The chart of the drift, drawn for a desk and for a phone, and the motion for the pictures that move, as members of a JSON object.
/// All come from the run's looks at its motion, not from its rows.
/// @param summary  of this result
std::string pictures_json(const RunResult& result, std::string_view summary);

}  // namespace earthtop::play
