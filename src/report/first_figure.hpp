// SPDX-License-Identifier: GPL-3.0-or-later
/// The picture of what a motion is known for, which stands first on its page: a pendulum's plane that turns, a gyrocompass's swing about
/// North, a tippe top's turn-over.
#pragma once

#include <string>

#include "report/html.hpp"
#include "report/run_data.hpp"

namespace earthtop::report {

/// Adds the section to the page where the run's summary has such a motion.
/// @returns whether it says how the finding came about, so that the drift of the axis is a matter of the protocol
bool add_first_figure(const Run& run, Page& page);

}  // namespace earthtop::report
