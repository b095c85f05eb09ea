// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/fit_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>

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
  Search(PartialProblems& problems, const std::vector<double>& near)
      : problems_(problems),
        start_(near),
        freedom_(std::max(1.0, static_cast<double>(problems.whole().standard_error.size() + problems.whole().priors.size()) -
                                   static_cast<double>(problems.parameters()))) {}

  FoundFit run(double at_start) {
    const std::vector<double>& given = problems_.whole().start;
    const bool is_near = at_start <= FitSearch::kDoubted * freedom_, has_spans = problems_.spans(2).size() > 1;
    if (is_near && take(fit_weighted(problems_.whole()), 0)) return std::move(best_);
    if (has_spans && (grow(start_, 2) || grow(start_, 1.4) || (start_ != given && grow(given, 2)))) return std::move(best_);
    if (!is_near && take(fit_weighted(problems_.whole()), 0)) return std::move(best_);
    for (int k = 1; k <= kStarts && problems_.work() < kMostWork; ++k)
      if (grow(moved(start_, k), 2)) break;
    return std::move(best_);
  }

 private:
  /// The standard errors of the weak priors about the scenario's numbers, in scales; as wide as the start is away from these.
  std::vector<double> known() const {
    std::vector<double> errors;
    for (std::size_t j = 0; j < start_.size(); ++j)
      errors.push_back(kKnown + std::abs(start_[j] - problems_.whole().start[j]) / problems_.whole().scales[j]);
    return errors;
  }

  /// Keeps the better of two fits. @returns whether the search has ended: with a good fit, or in the lowest minimum again: over
  /// spans the second time, with all rows at once, which have many minima, the third time
  bool take(Fit fit, std::size_t spans) {
    const bool is_minimum = fit.outcome == FitOutcome::converged;
    if (is_minimum && best_.search.minima > 0 && is_same(fit.chi_squared, best_.fit.chi_squared))
      ++found_again_;
    else if (is_minimum && (best_.search.minima == 0 || fit.chi_squared < best_.fit.chi_squared))
      found_again_ = 0;
    const bool ends = fit.outcome == FitOutcome::interrupted || fit.outcome == FitOutcome::not_determined ||
                      (is_minimum && fit.chi_squared <= FitSearch::kDoubted * freedom_) || found_again_ == (spans > 1 ? 1 : 2);
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
      FitProblem problem = problems_.up_to(end_s, known());
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
      problem.from = moved(start_, k);
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
  const std::vector<double>& start_;
  double freedom_;
  int found_again_ = 0;             // the lowest minimum
  bool model_is_at_fault_ = false;  // as far as parts of the data tell
  FoundFit best_;
};

}  // namespace

PartialProblems::PartialProblems(const FitProblem& whole, const JointInputs& inputs, const std::vector<VariedRelease>& releases,
                                 double correlation_time_s, const Watch& watch, Trials& trials)
    : whole_(whole),
      inputs_(inputs),
      releases_(releases),
      correlation_time_s_(correlation_time_s),
      watch_(watch),
      trials_(trials) {
  for (const VariedRelease& release : releases_) last_s_ = std::max(last_s_, release.residuals.back().t_s);
}

std::vector<double> PartialProblems::spans(double factor) const {
  double least_s = 0;
  for (const VariedRelease& release : releases_) {
    const std::size_t fewest = std::max<std::size_t>(16, 4 * release.inputs->list().size());
    least_s = std::max(least_s, release.residuals[std::min(fewest, release.residuals.size()) - 1].t_s);
  }
  std::vector<double> ends_s = {last_s_};
  while (ends_s.back() / factor >= least_s && ends_s.back() > 0) ends_s.push_back(ends_s.back() / factor);
  std::reverse(ends_s.begin(), ends_s.end());
  return ends_s;
}

FitProblem PartialProblems::up_to(double end_s, const std::vector<double>& known) {
  FitProblem problem;
  if (end_s == last_s_) {
    problem = whole_;
  } else {
    measurements_.clear();
    parts_.clear();
    measurements_.reserve(releases_.size());
    Whitening whitening;
    for (const VariedRelease& release : releases_) {
      const std::vector<double> times_s = measured_times(*release.measurement);
      const auto end = std::ranges::upper_bound(times_s, end_s);
      const std::size_t stride = 1 + static_cast<std::size_t>(end - times_s.begin()) / kMostTimes;
      const auto is_taken = [&](double t_s) {
        return t_s <= end_s && static_cast<std::size_t>(std::ranges::lower_bound(times_s, t_s) - times_s.begin()) % stride == 0;
      };
      Measurement& taken = measurements_.emplace_back();
      taken.file = release.measurement->file;
      for (const MeasuredValue& value : release.measurement->values)
        if (is_taken(value.t_s)) taken.values.push_back(value);
      std::vector<MeasurementResidual> residuals;
      for (const MeasurementResidual& residual : release.residuals)
        if (is_taken(residual.t_s)) residuals.push_back(residual);
      if (correlation_time_s_ > 0) whitening.append(Whitening(residuals, correlation_time_s_, taken.file));
      parts_.push_back(varied_release(*release.inputs, taken, std::move(residuals)));
    }
    problem = prediction_problem(inputs_, parts_, watch_, trials_);
    problem.whitening = std::move(whitening);
    problem.priors = whole_.priors;
    for (std::size_t j = 0; j < parameters(); ++j)
      if (std::ranges::none_of(problem.priors, [&](const FitPrior& prior) { return prior.parameter == j; }))
        problem.priors.push_back({j, known[j] * whole_.scales[j]});
    problem.rough = true;
  }
  const double part = last_s_ > 0 ? end_s / last_s_ : 1;
  problem.residuals_at = [this, part, of_rows = std::move(problem.residuals_at)](const std::vector<double>& values,
                                                                                 std::vector<double>& found) {
    work_ += part;
    return of_rows(values, found);
  };
  return problem;
}

FoundFit search_fit(PartialProblems& problems, double at_start, const std::vector<double>& near) {
  return Search(problems, near).run(at_start);
}

}  // namespace earthtop::measure
