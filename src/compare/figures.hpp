/// The figures of two summaries, held against each other by their names.
#pragma once

#include "compare/comparand.hpp"
#include "compare/tolerances.hpp"
#include "earthtop/compare/compare.hpp"

namespace earthtop::compare {

/// What a dotted path of summary.json leads to; none for what is not compared (how it was computed, words about it).
std::optional<FigureKind> figure_kind(const std::string& path);

/// @param same_computation  as of `rule_of`   @param whole_run  false where a verdict trusts one of the runs up to some time
/// only: figures of its end are left out
std::vector<QuantityVerdict> compare_figures(const Comparand& reference, const Comparand& candidate, bool same_computation,
                                             bool whole_run, const CompareOptions& options);

}  // namespace earthtop::compare
