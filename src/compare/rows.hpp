// SPDX-License-Identifier: GPL-3.0-or-later
/// Two tables of rows, held against each other row by row in bounded memory.
#pragma once

#include "compare/comparand.hpp"
#include "compare/tolerances.hpp"
#include "earthtop/compare/compare.hpp"

namespace earthtop::compare {

/// Rows of both at one time, as they stand in the files: the first of them, to be looked at where the two differ.
struct SeenPair {
  Row reference, candidate;
};

struct RowsComparison {
  std::vector<QuantityVerdict> quantities;
  std::vector<CompareFinding> findings;
  std::vector<std::string> notes;
  std::uint64_t rows = 0;
  std::vector<SeenPair> seen;
};

/// Numbers and facts from both sides' summaries that are needed to judge rows.
struct RowsContext {
  double attitude_errors_rad = 0;  ///< sum of both attitude bounds
  bool attitude_errors_known = false;
  double natural_rate_rad_s = 0;  ///< at which an error of the attitude may turn into one of the rates
  std::optional<double> until_s;  ///< later rows are not judged
  bool both_runs = false;         ///< each has all columns, or something is wrong
  bool same_scenario = false;     ///< the same times are expected
  bool same_computation = false;  ///< and the same errors, too: nothing but rounding should differ
};

/// @throws ScenarioError for rows that break off or are not as many as a summary states, and where the times differ and the
/// reference's rows are too far apart; ReadError
RowsComparison compare_rows(const Comparand& reference, const Comparand& candidate, const RowsContext& context,
                            const CompareOptions& options);
/// The same of torques.csv, row by row.
RowsComparison compare_torques(const Comparand& reference, const Comparand& candidate, const RowsContext& context,
                               const CompareOptions& options);

}  // namespace earthtop::compare
