// SPDX-License-Identifier: GPL-3.0-or-later
/// What of a run's motion its page draws: looks that resolve the motion, or, where there are none, output rows.
#pragma once

#include "report/run_data.hpp"

namespace earthtop::report {

/// Fills in the motion that is drawn and the one that is played. @param run  with its output rows
/// @throws Interrupted
void see_motion(Run& run);

}  // namespace earthtop::report
