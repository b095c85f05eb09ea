// SPDX-License-Identifier: GPL-3.0-or-later
/// Comparison of the figures of two summaries, paired by their names.
#pragma once

#include "compare/common_end.hpp"
#include "compare/comparand.hpp"
#include "compare/tolerances.hpp"
#include "earthtop/compare/compare.hpp"

namespace earthtop::compare {

/// Facts about two runs that decide which figures are compared, and how.
struct FigureContext {
  bool same_computation = false;  ///< as in `rule_of`
  bool whole_run = true;          ///< whether both verdicts trust the whole runs; else what is told of all of them is left out
  bool end_trusted = true;        ///< whether both trust the end; else the last row's figures are left out, too
  bool same_rows = true;          ///< whether rows have the same times; else their means are left out
  bool both_of_motion = true;     ///< whether the largest values of both are those of the motion, not of the rows
  const LongerRun* longer = nullptr;  ///< for runs of unlike lengths
};

struct FiguresComparison {
  std::vector<QuantityVerdict> quantities;
  std::vector<LeftOut> left_out;
};

FiguresComparison compare_figures(const Comparand& reference, const Comparand& candidate, const FigureContext& context,
                                  const CompareOptions& options);

}  // namespace earthtop::compare
