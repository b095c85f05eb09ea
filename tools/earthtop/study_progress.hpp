// SPDX-License-Identifier: GPL-3.0-or-later
/// Formats the progress of a study for a terminal.
#pragma once

#include <string>

namespace earthtop {
struct StudyProgress;
}

namespace earthtop::tool {

/// "12% 1200 of 10000 points, 35.2 a second, 4 min left", without a line end.
std::string progress_text(const StudyProgress& progress);

}  // namespace earthtop::tool
