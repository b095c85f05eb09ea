// SPDX-License-Identifier: GPL-3.0-or-later
/// Formats the comparison with a measurement.
#pragma once

#include <string>

namespace earthtop {
struct MeasurementReport;
struct ReleasesReport;
}  // namespace earthtop

namespace earthtop::tool {

struct Screen;

/// Whether measurement and scenario agree, the estimates, and the largest residuals.
std::string measurement_text(const MeasurementReport& report, const Screen& screen);
/// The same of several releases, without residuals.
std::string releases_text(const ReleasesReport& report, const Screen& screen);

}  // namespace earthtop::tool
