// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/advice.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace earthtop::plan {
namespace {

using Eigen::Index;

constexpr double kDurations[] = {0.125, 0.25, 0.375, 0.5, 0.75, 1, 1.5, 2};
constexpr double kRows[] = {0.125, 0.25, 0.5, 1, 2, 4};
constexpr double kSigmas[] = {4, 2, 1, 0.5, 0.25};
/// An unknown that costs is taken to be determined in another way with this part of its present standard error: then nine tenths
/// of what it costs are gained.
constexpr double kBetterKnown = 1.0 / 3;

class Changes {
 public:
  Changes(PlanReport& report, const Derivatives& derivatives, const std::vector<double>& scales,
          const std::vector<InputPrior>& priors, const Grid& grid, const Watch& watch)
      : report_(report), derivatives_(derivatives), scales_(scales), priors_(priors), grid_(grid), watch_(watch) {}

  PlanVariation longer(double factor) const {
    return varied(PlanChange::duration, factor, grid_.density, rows(factor), 1, own_quantities());
  }
  PlanVariation denser(double factor) const {
    const auto stride = static_cast<std::size_t>(static_cast<double>(grid_.density) / factor);
    return varied(PlanChange::rows, factor, stride, rows(factor), 1, own_quantities());
  }
  PlanVariation finer(double factor) const {
    return varied(PlanChange::sigma, factor, grid_.density, report_.rows, factor, own_quantities());
  }
  PlanVariation with_tilt() const { return varied(PlanChange::tilt, 1, grid_.density, report_.rows, 1, own_quantities() + 1); }
  bool has_duration(double factor) const { return factor <= static_cast<double>(grid_.extent) && rows(factor) >= 2; }
  bool has_rows(double factor) const { return factor <= static_cast<double>(grid_.density) && rows(factor) >= 2; }

 private:
  std::size_t own_quantities() const { return report_.plan.quantities.size(); }
  /// Number of rows, the one at the release included.
  std::size_t rows(double factor) const { return static_cast<std::size_t>(static_cast<double>(report_.rows - 1) * factor) + 1; }
  PlanVariation varied(PlanChange change, double factor, std::size_t stride, std::size_t rows, double sigma_factor,
                       std::size_t quantities) const {
    const ValueChoice choice{stride, rows, sigma_factor, report_.plan.correlation_time_s, quantities};
    PlanVariation variation{change, factor, "", 0, rows, {}};
    if (!watch_.asks_to_stop()) variation.standard_error = bound_of(derivatives_, scales_, priors_, choice).standard_error(0);
    return variation;
  }

  const PlanReport& report_;
  const Derivatives& derivatives_;
  const std::vector<double>& scales_;
  const std::vector<InputPrior>& priors_;
  const Grid& grid_;
  const Watch& watch_;
};

/// The first number's standard error if another one gets more information, in units of what makes it known to its present
/// standard error: Sherman and Morrison's formula.
double error_with(const Eigen::MatrixXd& covariance, Index other, double information) {
  const double shared = covariance(0, other) * covariance(0, other) / covariance(other, other);
  const double share = std::isfinite(information) ? information / (1 + information) : 1;
  return std::sqrt(std::max(covariance(0, 0) - share * shared, 0.0));
}

double gain(const PlanReport& report, const PlanVariation& change) {
  return *report.estimates[0].standard_error / *change.standard_error;
}

/// The sentence that says what a change means, e.g. "measure 2 times as long, to 120 s".
std::string change_text(const PlanReport& report, const PlanVariation& change) {
  switch (change.change) {
    case PlanChange::duration:
      return fmt::format("measure {:g} times as long, to {:g} s", change.factor, change.factor * *report.plan.until_s);
    case PlanChange::rows:
      return fmt::format("take {:g} times as many rows, one every {:g} s", change.factor, report.plan.every_s / change.factor);
    case PlanChange::sigma: return fmt::format("make the values' standard errors {:g} times smaller", 1 / change.factor);
    case PlanChange::tilt: return "measure the tilt, too, with the same standard error";
    case PlanChange::known:
    case PlanChange::prior: break;
  }
  const auto input = std::find_if(report.estimates.begin(), report.estimates.end(), [&](const PlannedEstimate& estimate) {
    return name_in_release(estimate.name, estimate.release) == change.input;
  });
  return fmt::format("determine {} in another way, to ± {:.2g}{}{} where it would be ± {:.2g}", change.input,
                     change.input_error, input->unit.empty() ? "" : " ", input->unit, *input->standard_error);
}

std::string advice_on(const PlanReport& report) {
  const PlannedEstimate& target = report.estimates[0];
  std::string text = target.finding ? fmt::format("{} would {}be seen: it is {:.3g} sigma from zero. ", target.name,
                                                  target.finding->outcome() == RateOutcome::seen ? "" : "not ",
                                                  target.finding->from_zero_sigma)
                                    : fmt::format("{} would be known to ± {:.3g}{}{}. ", target.name, *target.standard_error,
                                                  target.unit.empty() ? "" : " ", target.unit);
  const auto sentence = [&](const PlanVariation& change) {
    return fmt::format("{}: the standard error of {} would be {:.3g} times smaller, {:.2e}{}{}", change_text(report, change),
                       target.name, gain(report, change), *change.standard_error, target.unit.empty() ? "" : " ", target.unit);
  };
  if (report.changes.empty() || gain(report, report.changes[0]) < 1.05)
    return text + "None of the changes considered makes its standard error smaller by as much as a twentieth.";
  text += "To change first: " + sentence(report.changes[0]);
  if (report.changes.size() > 1 && gain(report, report.changes[1]) >= 1.05) text += "; next, " + sentence(report.changes[1]);
  return text + ".";
}

}  // namespace

void compare_changes(PlanReport& report, const Derivatives& derivatives, const std::vector<double>& scales,
                     const std::vector<InputPrior>& priors, const Grid& grid, const Bound& bound, const Watch& watch) {
  const Changes changes(report, derivatives, scales, priors, grid, watch);
  const auto offer = [&](PlanVariation change) {
    if (change.standard_error && *change.standard_error > 0) report.changes.push_back(std::move(change));
  };
  for (std::size_t k = 1; k < report.estimates.size(); ++k) {
    const auto other = static_cast<Index>(k);
    const PlannedEstimate& input = report.estimates[k];
    const std::string name = name_in_release(input.name, input.release);
    PlanVariation known{PlanChange::known, 1, name, 0, report.rows, error_with(bound.covariance, other, INFINITY)};
    report.variations.push_back(std::move(known));
    const double information = 1 / (kBetterKnown * kBetterKnown);
    offer({PlanChange::prior, 1, name, kBetterKnown * *input.standard_error, report.rows,
           error_with(bound.covariance, other, information)});
  }
  std::stable_sort(report.variations.begin(), report.variations.end(),
                   [](const PlanVariation& a, const PlanVariation& b) { return *a.standard_error < *b.standard_error; });
  for (const double factor : kDurations)
    if (changes.has_duration(factor)) report.variations.push_back(changes.longer(factor));
  for (const double factor : kRows)
    if (changes.has_rows(factor)) report.variations.push_back(changes.denser(factor));
  for (const double factor : kSigmas) report.variations.push_back(changes.finer(factor));
  for (const PlanVariation& variation : report.variations)
    if ((variation.change == PlanChange::duration && variation.factor == 2) ||
        (variation.change == PlanChange::rows && variation.factor == 2) ||
        (variation.change == PlanChange::sigma && variation.factor == 0.5))
      offer(variation);
  if (grid.has_tilt) offer(changes.with_tilt());
  std::stable_sort(report.changes.begin(), report.changes.end(),
                   [](const PlanVariation& a, const PlanVariation& b) { return *a.standard_error < *b.standard_error; });
  report.advice = advice_on(report);
}

}  // namespace earthtop::plan
