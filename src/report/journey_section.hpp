// SPDX-License-Identifier: GPL-3.0-or-later
/// The way of a laboratory that travels, on its run's page.
#pragma once

#include "report/html.hpp"
#include "report/run_data.hpp"

namespace earthtop::report {

/// Adds a section with a map of the journey; nothing where the laboratory stays, or only climbs. It is made from the scenario's journey; of
/// results whose journey is a table in another file, from their rows.
void add_journey(const Run& run, Page& page);

}  // namespace earthtop::report
