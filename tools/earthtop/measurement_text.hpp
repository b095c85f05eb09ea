// SPDX-License-Identifier: GPL-3.0-or-later
/// What `earthtop compare` prints of a measurement.
#pragma once

#include <string>

namespace earthtop {
struct MeasurementReport;
}

namespace earthtop::tool {

/// Whether measurement and scenario agree, the estimates, the largest residuals. @param color  with terminal colours
std::string measurement_text(const MeasurementReport& report, bool color);

}  // namespace earthtop::tool
