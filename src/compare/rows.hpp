// SPDX-License-Identifier: GPL-3.0-or-later
/// Comparison of two tables of rows, row by row in bounded memory.
#pragma once

#include "compare/comparand.hpp"
#include "compare/tolerances.hpp"
#include "compare/trust.hpp"
#include "earthtop/compare/compare.hpp"

namespace earthtop::compare {

/// A pair of rows of one time, as in the files. The first pairs are kept, to guess the cause where the two results differ.
struct SeenPair {
  Row reference, candidate;
};

struct RowsComparison {
  std::vector<QuantityVerdict> quantities;
  std::vector<CompareFinding> findings;
  std::vector<std::string> notes;
  std::uint64_t rows = 0;
  ComparedSpan span;
  std::vector<SeenPair> seen;
};

/// Numbers and facts from both sides' summaries that are needed to judge rows.
struct RowsContext {
  double attitude_errors_rad = 0;  ///< sum of both attitude bounds
  bool attitude_errors_known = false;
  double natural_rate_rad_s = 0;  ///< rate that turns an attitude error into an error of the rates (rad/s)
  Trust trust;                    ///< rows that it leaves out are not judged
  std::optional<double> end_s;    ///< the common end of two runs of unlike lengths
  bool both_runs = false;         ///< whether both are runs, which must have all columns
  bool same_scenario = false;     ///< whether the scenarios agree, so that rows at the same times are expected
  bool is_file = false;           ///< whether the new rows are a CSV file's, of which no summary says how long they should be
  bool same_computation = false;  ///< whether the errors agree, too, so that only rounding should differ
};

/// Compares the rows of trajectory.csv. @throws ScenarioError for rows that break off or are not as many as a summary states,
/// and where the times differ and the reference's rows are too far apart to interpolate between them; ReadError
RowsComparison compare_rows(const Comparand& reference, const Comparand& candidate, const RowsContext& context,
                            const CompareOptions& options);
/// Compares the rows of torques.csv in the same way.
RowsComparison compare_torques(const Comparand& reference, const Comparand& candidate, const RowsContext& context,
                               const CompareOptions& options);

}  // namespace earthtop::compare
