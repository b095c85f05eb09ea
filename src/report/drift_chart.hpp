// SPDX-License-Identifier: GPL-3.0-or-later
/// The numbers that the chart of the drift is made of on a run's page.
#pragma once

#include "report/run_data.hpp"
#include "results/drift_curves.hpp"

namespace earthtop::report {

DriftCurves drift_curves(const Run& run, const Motion& motion);

}  // namespace earthtop::report
