// SPDX-License-Identifier: GPL-3.0-or-later
/// The part of a run's page about the drift itself: its parts over time, the bound on its error, its trend, and why it is what it is.
#pragma once

#include "report/html.hpp"
#include "report/run_data.hpp"

namespace earthtop::report {

/// The chart of the drift.
std::string drift_section(const Run& run, Page& page);

/// The azimuth's trend, the spin that is left, a pendulum's swing, and the chart of the bound on the drift's error over all its decades.
std::string bound_section(const Run& run, Page& page);

/// When the drift passes the requested threshold, and when motions come to rest or to the values asked for; may be
/// empty.
std::string drift_events_html(const Run& run);

/// The sentences of the result's summary; empty where it has none.
std::string why_html(const Run& run);

}  // namespace earthtop::report
