// SPDX-License-Identifier: GPL-3.0-or-later
/// What the report of a run asks the support of its top: one row a kind of support. A table's reports are in sources of their own.
#pragma once

#include <optional>
#include <vector>

#include "run/assemble.hpp"
#include "run/followed_growth.hpp"
#include "run/why_told.hpp"

namespace earthtop {

struct SupportReports {
  /// Follows the growth of disturbances along the motions of a result, as far as its verdict needs that.
  /// @param log_round_off  natural logarithm of the growth at which rounding is too large
  GrowthFound (*growth)(const DriftProblem<double>& problem, const RunResult& result, double log_round_off, const Watch& watch);
  void (*tell)(why::Told& told);
};

/// The reports that are computed in the scalar of the run.
template <class T>
struct SupportReportsIn {
  using Samples = std::vector<DriftSample<T>>;

  /// An upper estimate of what rounding adds to an attitude by an error of a rate, which grows with the time: both integrations may have
  /// it alike. @param steps  the number of steps in the whole run   @param duration_s  its length
  double (*turned_by_rounding)(const DriftSample<T>& sample, std::size_t steps, double duration_s);
  /// Add what only this support has: before the verdict, from the samples of the rows, and after it.
  void (*report)(const TwoIntegrations<T>& made, int safety, RunResult& result);
  void (*report_judged)(RunResult& result, const Watch& watch);
  /// @param samples  those of the result's rows come first
  std::vector<InvariantReport> (*invariants)(const RunResult& result, const Samples& samples, const Watch& watch);
  std::optional<LedgerReport> (*ledger)(const RunResult& result, const Samples& samples, const Watch& watch);
};

const SupportReports& reports_of(const Scene& scene);
template <class T>
const SupportReportsIn<T>& reports_in(const Scene& scene);
extern template const SupportReportsIn<double>& reports_in(const Scene&);
extern template const SupportReportsIn<float80>& reports_in(const Scene&);
extern template const SupportReportsIn<float128>& reports_in(const Scene&);

}  // namespace earthtop
