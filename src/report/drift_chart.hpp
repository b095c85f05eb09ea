// SPDX-License-Identifier: GPL-3.0-or-later
/// The chart of the drift and its parts over time.
#pragma once

#include <array>
#include <vector>

#include "report/run_data.hpp"

namespace earthtop::report {

/// The difference of the two axes; it is not exact, but serves to find where they are nearest.
std::array<std::vector<double>, 3> axes_apart(const Motion& motion);

/// The angle between the axes, its part in tilt, the azimuth, and what is left of it beside its secular line.
Figure drift_chart(const Run& run, const Motion& motion);

}  // namespace earthtop::report
