// SPDX-License-Identifier: GPL-3.0-or-later
/// The figures of two summaries, held against each other by their names.
#pragma once

#include "compare/comparand.hpp"
#include "compare/tolerances.hpp"
#include "earthtop/compare/compare.hpp"

namespace earthtop::compare {

/// This is known of two runs beside their figures.
struct FigureContext {
  bool same_computation = false;  ///< as of `rule_of`
  bool whole_run = true;          ///< both verdicts trust them to the end; else figures of the end are left out
  bool same_rows = true;          ///< else largest values and means of the rows are left out
};

std::vector<QuantityVerdict> compare_figures(const Comparand& reference, const Comparand& candidate,
                                             const FigureContext& context, const CompareOptions& options);

}  // namespace earthtop::compare
