// SPDX-License-Identifier: GPL-3.0-or-later
/// Formats the results of a study for a terminal.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace earthtop::tool {

/// Text for a document of `study_json`: points, statistics, means along the axes, fits, indices, figures.
/// @param width  columns of a line of prose
std::string study_text(std::string_view document, std::size_t width);

/// Text for a document of `selected_points_json`.
std::string selected_points_text(std::string_view document);

/// Numbers of points in a document of `study_json`: planned, computed, and failed among the computed ones.
struct StudyCounts {
  std::uint64_t planned, computed, failed;
};
StudyCounts study_counts(std::string_view document);

}  // namespace earthtop::tool
