// SPDX-License-Identifier: GPL-3.0-or-later
/// A fit that finds its way from a start that is far off.
#pragma once

#include <vector>

#include "earthtop/measure/measurement.hpp"
#include "measure/estimated_inputs.hpp"
#include "measure/prediction_problem.hpp"
#include "measure/weighted_fit.hpp"

namespace earthtop::measure {

/// The problems of the rows of all releases up to a time.
class PartialProblems {
 public:
  /// All arguments must live as long as this. @param whole  the problem of all rows
  PartialProblems(const FitProblem& whole, const JointInputs& inputs, const std::vector<VariedRelease>& releases,
                  double correlation_time_s, const Watch& watch, Trials& trials);

  const FitProblem& whole() const { return whole_; }
  std::size_t parameters() const { return whole_.start.size(); }
  /// The times at which spans end (s), ascending, the last row's last: each is `factor` times the one before it, and the first has
  /// enough values to determine all parameters.
  std::vector<double> spans(double factor) const;
  /// The problem of the rows to a time; where that is not the last one, with weak priors about the scenario's numbers, since few
  /// rows do not see all of them, and without the last digits of the minimum.
  /// @param known  standard errors of these priors, in scales
  FitProblem up_to(double end_s, const std::vector<double>& known);
  /// The part of a whole motion's work that all problems have cost, in motions.
  double work() const { return work_; }

 private:
  const FitProblem& whole_;
  const JointInputs& inputs_;
  const std::vector<VariedRelease>& releases_;
  double correlation_time_s_;
  const Watch& watch_;
  Trials& trials_;
  double last_s_ = 0;
  std::vector<Measurement> measurements_;  // of the latest problem
  std::vector<VariedRelease> parts_;       // of the latest problem
  double work_ = 0;
};

struct FoundFit {
  Fit fit;
  FitSearch search;
};

/// Over a whole measurement the sum of squares has a minimum for each number of swings by which the predicted motion may be ahead
/// of the measured one. Over the first rows alone it has one. So where the start is far off, the fit is made over the first rows,
/// and its result leads into the minimum of a longer span, until all rows are in. Where chi-squared then stays above ten times
/// its expectation, other spans and other starts are tried, and the lowest minimum is taken.
/// @param at_start  chi-squared of the scenario's own numbers
/// @param near  a start that may be nearer than the scenario's numbers
FoundFit search_fit(PartialProblems& problems, double at_start, const std::vector<double>& near);

}  // namespace earthtop::measure
