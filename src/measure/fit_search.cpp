// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/fit_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "measure/measured_motion.hpp"

namespace earthtop::measure {
namespace {

constexpr double kKnown = 0.3;            // standard error of what a part of the data leaves open, in scales
constexpr std::size_t kMostTimes = 1000;  // of a part, evenly chosen among its rows
constexpr double kPoor = 3;               // chi-squared per value from which on a part's fit is repeated from other starts
constexpr int kStartsOfSpan = 24;
constexpr double kMostWorkOfSpan = 40;  // motions
constexpr double kMoved = 0.1;          // largest change of another start, in scales
constexpr int kStarts = 8;              // other starts
constexpr double kMostWork = 600;       // motions after which no other start is tried

class Search {
 public:
  explicit Search(PartialProblems& problems)
      : problems_(problems),
        freedom_(std::max(1.0, static_cast<double>(problems.whole().standard_error.size() + problems.whole().priors.size()) -
                                   static_cast<double>(problems.parameters()))) {}

  FoundFit run(double at_start) {
    const std::vector<double>& start = problems_.whole().start;
    const bool is_near = at_start <= FitSearch::kDoubted * freedom_;
    if (is_near && take(fit_weighted(problems_.whole()), 0)) return std::move(best_);
    if (grow(start, 2) || grow(start, 1.4)) return std::move(best_);
    if (!is_near && take(fit_weighted(problems_.whole()), 0)) return std::move(best_);
    for (int k = 1; k <= kStarts && problems_.work() < kMostWork; ++k)
      if (grow(moved(start, k), 2)) break;
    return std::move(best_);
  }

 private:
  /// Keeps the better of two fits. @returns whether the search has ended: with a good fit, or a second time in the lowest minimum
  bool take(Fit fit, std::size_t spans) {
    const bool is_minimum = fit.outcome == FitOutcome::converged, had_minimum = best_.search.minima > 0;
    const bool ends = fit.outcome == FitOutcome::interrupted || fit.outcome == FitOutcome::not_determined ||
                      (is_minimum && fit.chi_squared <= FitSearch::kDoubted * freedom_) ||
                      (is_minimum && had_minimum && is_same(fit.chi_squared, best_.fit.chi_squared));
    if (is_minimum) ++best_.search.minima;
    const bool is_first = best_.search.attempts++ == 0;
    if (!is_first && !ends && !is_better(fit, best_.fit)) return false;
    best_.fit = std::move(fit);
    best_.search.spans = spans;
    return ends;
  }
  /// A minimum is better than none, and an end of a search better than no beginning.
  static bool is_better(const Fit& a, const Fit& b) {
    const auto rank = [](const Fit& fit) { return fit.outcome == FitOutcome::converged ? 2 : fit.parameters.empty() ? 0 : 1; };
    return rank(a) != rank(b) ? rank(a) > rank(b) : a.chi_squared < b.chi_squared;
  }
  static bool is_same(double a, double b) { return std::abs(a - b) <= 1e-6 * (a + b); }

  /// Takes the fit over spans of the data that grow by a factor.
  bool grow(std::vector<double> from, double factor) {
    const std::vector<double> ends_s = problems_.spans(factor);
    std::vector<double> steps;
    for (const double end_s : ends_s) {
      FitProblem problem = problems_.up_to(end_s);
      problem.from = from;
      problem.steps = steps;
      Fit fit = fit_weighted(problem);
      if (end_s != ends_s.back()) start_again(problem, fit);
      if (fit.outcome == FitOutcome::interrupted || end_s == ends_s.back()) return take(std::move(fit), ends_s.size());
      if (fit.parameters.empty()) continue;
      from = std::move(fit.parameters);
      steps = std::move(fit.steps);
    }
    return false;
  }

  /// Where few rows do not agree with the model, their fit is repeated from other starts: their motions are short. Where that does
  /// not help, the model is at fault, and it is not tried again.
  void start_again(FitProblem& problem, Fit& best) {
    const double most_work = problems_.work() + kMostWorkOfSpan;
    const auto is_poor = [&] {
      return best.outcome != FitOutcome::interrupted &&
             best.chi_squared > kPoor * static_cast<double>(problem.standard_error.size());
    };
    problem.steps.clear();
    for (int k = 1; is_poor() && !model_is_at_fault_; ++k) {
      model_is_at_fault_ = k == kStartsOfSpan || problems_.work() > most_work;
      problem.from = moved(problems_.whole().start, k);
      Fit fit = fit_weighted(problem);
      if (fit.outcome == FitOutcome::interrupted || (!fit.parameters.empty() && fit.chi_squared < best.chi_squared))
        best = std::move(fit);
    }
  }

  /// The start number k, moved at random in all directions; the same with every library.
  std::vector<double> moved(std::vector<double> start, int k) const {
    std::mt19937_64 bits(static_cast<std::uint64_t>(k));
    for (std::size_t j = 0; j < start.size(); ++j)
      start[j] += kMoved * problems_.whole().scales[j] * (2 * static_cast<double>(bits() >> 11) * 0x1p-53 - 1);
    return start;
  }

  PartialProblems& problems_;
  double freedom_;
  bool model_is_at_fault_ = false;  // as far as parts of the data tell
  FoundFit best_;
};

}  // namespace

PartialProblems::PartialProblems(const FitProblem& whole, const EstimatedInputs& inputs, const Measurement& measurement,
                                 const std::vector<MeasurementResidual>& residuals, double correlation_time_s,
                                 const Watch& watch, Trials& trials)
    : whole_(whole),
      inputs_(inputs),
      measurement_(measurement),
      residuals_(residuals),
      correlation_time_s_(correlation_time_s),
      watch_(watch),
      trials_(trials),
      times_s_(measured_times(measurement)) {}

std::vector<double> PartialProblems::spans(double factor) const {
  const std::size_t fewest = std::max<std::size_t>(16, 4 * parameters());
  std::vector<double> ends_s = {residuals_.back().t_s};
  const double least_s = residuals_[std::min(fewest, residuals_.size()) - 1].t_s;
  while (ends_s.back() / factor >= least_s && ends_s.back() > 0) ends_s.push_back(ends_s.back() / factor);
  std::reverse(ends_s.begin(), ends_s.end());
  return ends_s;
}

FitProblem PartialProblems::up_to(double end_s) {
  FitProblem problem;
  const double last_s = residuals_.back().t_s;
  if (end_s == last_s) {
    problem = whole_;
  } else {
    const auto end = std::ranges::upper_bound(times_s_, end_s);
    const std::size_t stride = 1 + static_cast<std::size_t>(end - times_s_.begin()) / kMostTimes;
    const auto is_taken = [&](double t_s) {
      return t_s <= end_s && static_cast<std::size_t>(std::ranges::lower_bound(times_s_, t_s) - times_s_.begin()) % stride == 0;
    };
    std::vector<MeasurementResidual> residuals;
    for (const MeasurementResidual& residual : residuals_)
      if (is_taken(residual.t_s)) residuals.push_back(residual);
    part_ = {};
    part_.measurement.file = measurement_.file;
    for (const MeasuredValue& value : measurement_.values)
      if (is_taken(value.t_s)) part_.measurement.values.push_back(value);
    part_.times_s = measured_times(part_.measurement);
    problem = prediction_problem(inputs_, part_.measurement, residuals, part_.times_s, watch_, trials_);
    if (correlation_time_s_ > 0) problem.whitening = Whitening(residuals, correlation_time_s_, measurement_.file);
    problem.priors = whole_.priors;
    for (std::size_t j = 0; j < parameters(); ++j)
      if (std::ranges::none_of(problem.priors, [&](const FitPrior& prior) { return prior.parameter == j; }))
        problem.priors.push_back({j, kKnown * whole_.scales[j]});
    problem.rough = true;
  }
  const double part = last_s > 0 ? end_s / last_s : 1;
  problem.residuals_at = [this, part, of_rows = std::move(problem.residuals_at)](const std::vector<double>& values,
                                                                                 std::vector<double>& found) {
    work_ += part;
    return of_rows(values, found);
  };
  return problem;
}

FoundFit search_fit(PartialProblems& problems, double at_start) { return Search(problems).run(at_start); }

}  // namespace earthtop::measure
