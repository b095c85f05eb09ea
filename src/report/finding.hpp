// SPDX-License-Identifier: GPL-3.0-or-later
/// The finding of a run, as the page says it on top: what drifts, by how much, and how sure that is.
#pragma once

#include <string>
#include <string_view>

#include "report/run_data.hpp"

namespace earthtop::report {

/// The finding in words, as HTML: "In a minute the Earth turns this top's axis 235.2 arcseconds off course".
std::string finding_html(const Run& run);

/// The kinds of things that a gallery groups pages by, in its order.
inline constexpr std::string_view kOnPoint = "Tops on a point", kGyroscopes = "Gyroscopes", kPendulums = "Pendulums",
                                  kOnTable = "On a table", kTumbling = "Bodies that tumble",
                                  kStudies = "Studies: many runs each";
inline constexpr std::string_view kGroups[] = {kOnPoint, kGyroscopes, kPendulums, kOnTable, kTumbling, kStudies};
/// That of a run.
std::string_view group_of(const Run& run);

/// A sentence on what that is in a length and beside the Sun's disc, as HTML.
std::string measure_html(const Run& run);

/// How far the finding can be trusted, and why, as HTML: of a reliable one the reason on demand.
std::string trust_html(const Run& run);

/// How much the Earth turns the plane of a pendulum's swing in the whole run, and a bound on the error (rad); clockwise from above.
/// None where the run has no such plane.
struct PlaneTurn {
  double rad, bound_rad;
};
std::optional<PlaneTurn> plane_turn(const Run& run);

}  // namespace earthtop::report
