// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds what two runs of unlike lengths have in common: all of it lies before the end of the shorter one.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compare/comparand.hpp"
#include "earthtop/compare/compare.hpp"
#include "results/figures.hpp"

namespace earthtop::compare {

/// The longer run at the end of the shorter one.
struct LongerRun {
  CommonEnd end;
  Comparand comparand;     ///< the longer run, with those figures of its end, and bounds, that its rows tell of the common end
  std::optional<Row> row;  ///< its row then; none where it has none and its rows are too far apart to interpolate between them
  std::vector<double> interpolation_error;  ///< of each measure, for a row between rows; else empty
};

/// @returns none where both end at the same time, or where the scenarios may not have different durations
std::optional<LongerRun> find_common_end(const Comparand& reference, const Comparand& candidate, const CompareOptions& options);

/// Why a figure of the end is left out.
inline constexpr std::string_view kNoRow = "no row of the longer run tells it at the common end";
/// Why a figure has no common meaning for the two; empty where it has one.
std::string_view why_left_out(const SummaryMember& member, const std::string& path, const Comparand& reference,
                              const Comparand& candidate, const LongerRun& longer);

}  // namespace earthtop::compare
