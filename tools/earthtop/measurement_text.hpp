// SPDX-License-Identifier: GPL-3.0-or-later
/// Formats the comparison with a measurement.
#pragma once

#include <string>

namespace earthtop {
struct MeasurementReport;
}

namespace earthtop::tool {

struct Screen;

/// Whether measurement and scenario agree, the estimates, and the largest residuals.
std::string measurement_text(const MeasurementReport& report, const Screen& screen);

}  // namespace earthtop::tool
