// SPDX-License-Identifier: GPL-3.0-or-later
/// The part of a run's page about the drift itself: its headline, its parts over time, the bound on its error, its trend, and why it is
/// what it is.
#pragma once

#include "report/html.hpp"
#include "report/run_data.hpp"

namespace earthtop::report {

/// A sentence about the last drift that can be trusted.
std::string headline_html(const Run& run);

/// The charts of the drift, with the bound on its error, its trend and its events.
std::string drift_section(const Run& run, Page& page);

/// The sentences of the result's summary; empty where it has none.
std::string why_html(const Run& run);

/// A chart that is drawn only when asked for: the size of a drift and the bound on its error, over all their decades.
/// @param listed  the figure whose points table and crosshair have
std::string bound_chart_html(Page& page, const std::string& name, Figure figure, const Figure& listed);

}  // namespace earthtop::report
