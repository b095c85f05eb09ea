// SPDX-License-Identifier: GPL-3.0-or-later
/// A first pass over a reference, for the numbers that must be known before any of its rows can be judged.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "compare/row_source.hpp"
#include "earthtop/watch.hpp"

namespace earthtop::compare {

struct Survey {
  std::uint64_t rows = 0;  ///< number of rows with a finite time
  std::uint64_t not_finite_times = 0;
  double first_s = 0, last_s = 0;
  double least_step_s = 0, largest_step_s = 0;  ///< steps between rows (s); 0 for a single row
  std::vector<double> largest;                  ///< largest size of each measure of the table, over the rows that have it
  double largest_rate_rad_s = 0;                ///< largest angular rate of both motions
  double rate_effect_rad_s = 0;                 ///< largest |w_LB - ref_w_LB|
  /// The interpolation error of each measure, if asked for: the error midway between rows twice as far apart as the
  /// reference's, found by comparing with the rows left out there.
  std::vector<double> interpolation_error;
};

/// Surveys a reference by reading all its rows. @param until_s  sizes and errors are those of the rows until then
/// @throws as `RowSource`
Survey survey(RowSource& rows, const Table& table, bool with_interpolation, const Watch& watch,
              std::optional<double> until_s = std::nullopt);

constexpr double kMostTurnBetweenRows = 1;  ///< rad: if the body turns by more, rows do not tell the motion between them

}  // namespace earthtop::compare
