// SPDX-License-Identifier: GPL-3.0-or-later
/// The part of a run's page about the contact of a top with its table.
#pragma once

#include "report/html.hpp"
#include "report/run_data.hpp"

namespace earthtop::report {

/// The drift of the contact point over time, with the bound on its error, and sentences that say what can be seen.
std::string tip_drift_html(const Run& run, Page& page);

/// Path of the contact point, slip, normal force, events, and how far the prediction itself moves with its inputs.
std::string contact_section(const Run& run, Page& page);

}  // namespace earthtop::report
