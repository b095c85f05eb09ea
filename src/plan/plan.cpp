// SPDX-License-Identifier: GPL-3.0-or-later
// Computes what a planned measurement would show.
#include "earthtop/plan/plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "measure/exact_inputs.hpp"
#include "measure/known_rate.hpp"
#include "measure/measured_motion.hpp"
#include "plan/advice.hpp"
#include "plan/bound.hpp"
#include "plan/optimise.hpp"
#include "plan/planned_rows.hpp"
#include "plan/preparation.hpp"

namespace earthtop {
namespace plan {
namespace {

using measure::EstimatedInputs;

constexpr double kVerdict = 6;                   // the work of a verdict in units of a prediction's
constexpr std::size_t kMostGridValues = 40'000;  // beyond it the table of rows and durations is shortened
constexpr double kLongest_s = 1e9;               // the longest duration that a scenario may have

/// A scene that lasts longer, and its verdict.
struct LongScene {
  Scene scene;
  Overrides overrides;
  double until_s = 0;
  measure::JudgedMotion judged;
};

LongScene lasting_scene(const ScenarioSource& source, const Overrides& overrides, const Scene& given, double until_s,
                        const Watch& watch) {
  Overrides longer = lasting(overrides, given.scenario(), until_s);
  Scene scene = parse_scene(source, longer);
  measure::JudgedMotion judged = measure::judged_motion(scene, until_s, watch);
  return {std::move(scene), std::move(longer), until_s, std::move(judged)};
}

/// The scene to twice the end of the plan, if it can be predicted until then; otherwise to the end of the plan.
/// @throws ScenarioError where it cannot be predicted until that
LongScene reliable_scene(const ScenarioSource& source, const Overrides& overrides, const Scene& given, double until_s,
                         Parts& parts) {
  const Watch longer = parts.next(kVerdict, "verdict"), watch = parts.next(kVerdict);
  if (2 * until_s <= kLongest_s) try {
      LongScene twice = lasting_scene(source, overrides, given, 2 * until_s, longer);
      const auto& [status, reached_s, verdict] = twice.judged;
      const bool is_whole = status == RunStatus::completed && reached_s >= 2 * until_s;
      if (status == RunStatus::interrupted || (is_whole && !measure::is_beyond_prediction(verdict, 2 * until_s))) return twice;
    } catch (const ScenarioError&) {  // a table of a platform's motion that ends before, or days of work
    }
  LongScene once = lasting_scene(source, overrides, given, until_s, watch);
  const auto& [status, reached_s, verdict] = once.judged;
  if (status == RunStatus::completed && measure::is_beyond_prediction(verdict, until_s))
    throw ScenarioError(
        "--until",
        fmt::format(
            "after {:.6g} s the scenario's motion is {}, and its prediction means nothing: {}; end the measurement by then",
            *verdict.from_s, to_string(verdict.verdict), verdict.reason));
  return once;
}

/// A tilt to look at beside what the plan measures; none where it measures one, or drifts.
std::vector<PlannedQuantity> with_tilt(const std::vector<PlannedQuantity>& quantities, bool& has_tilt) {
  std::vector<PlannedQuantity> more = quantities;
  has_tilt = quantities.size() == 1 && quantities[0].quantity == MeasuredQuantity::azimuth;
  if (has_tilt) {
    more.push_back(quantities[0]);
    more.back().quantity = MeasuredQuantity::tilt;
  }
  return more;
}

Grid grid_of(std::size_t rows, std::size_t quantities, std::size_t extent) {
  Grid grid{4, extent, false};
  while (grid.density > 1 && rows * quantities * grid.density * extent > kMostGridValues) grid.density /= 2;
  return grid;
}

void describe_undetermined(PlanReport& report, const Bound& bound) {
  report.outcome = PlanOutcome::not_determined;
  std::vector<std::string> names;
  for (const std::size_t j : bound.undetermined) {
    names.push_back(report.estimates[j].name);
    report.undetermined.emplace_back(report.estimates[j].name, bound.direction[j]);
  }
  report.reason = names.size() == 1 ? fmt::format("these data would not determine {}", names.front())
                                    : fmt::format("these data would not tell apart {}", fmt::join(names, ", "));
  report.advice = names.size() == 1
                      ? fmt::format("Measure another quantity, or leave {} out.", names.front())
                      : "Say in the scenario's uncertainty block how well one of them is known, leave one out, or measure "
                        "another quantity.";
}

void fill_in_errors(PlanReport& report, const Bound& bound) {
  const auto p = static_cast<Eigen::Index>(report.estimates.size());
  for (Eigen::Index j = 0; j < p; ++j) {
    PlannedEstimate& estimate = report.estimates[static_cast<std::size_t>(j)];
    estimate.standard_error = std::sqrt(bound.covariance(j, j));
    estimate.standard_error_alone = bound.alone[static_cast<std::size_t>(j)];
    std::vector<double>& row = report.correlation.emplace_back();
    for (Eigen::Index k = 0; k < p; ++k)
      row.push_back(j == k ? 1 : bound.covariance(j, k) / std::sqrt(bound.covariance(j, j) * bound.covariance(k, k)));
  }
}

/// Says what a measurement of the scenario's own motion would tell of the Earth's rate, and which inputs it takes as exact.
void add_findings(PlanReport& report, const Scene& scene, const measure::ExactInputs& exact, const Eigen::MatrixXd& J) {
  for (std::size_t j = 0; j < report.estimates.size(); ++j) {
    PlannedEstimate& estimate = report.estimates[j];
    const auto known = measure::known_rate(scene, exact.all().list()[j]);
    if (known && *estimate.standard_error > 0)
      estimate.finding = rate_finding(estimate.value, *estimate.standard_error, *known, estimate.prior);
    if (!estimate.is_nuisance) estimate.exact = exact.shifting(J, j);
  }
}

}  // namespace
}  // namespace plan

std::string_view to_string(PlanChange change) {
  switch (change) {
    case PlanChange::duration: return "duration";
    case PlanChange::rows: return "rows";
    case PlanChange::sigma: return "sigma";
    case PlanChange::known: return "known";
    case PlanChange::prior: return "prior";
    case PlanChange::tilt: return "tilt";
  }
  return "";
}

std::string_view to_string(PlanOutcome outcome) {
  switch (outcome) {
    case PlanOutcome::determined: return "determined";
    case PlanOutcome::not_determined: return "not_determined";
    case PlanOutcome::prediction_failed: return "prediction_failed";
    case PlanOutcome::interrupted: return "interrupted";
  }
  return "";
}

std::optional<double> PlannedEstimate::significance() const {
  if (!standard_error || !(*standard_error > 0)) return std::nullopt;
  return std::abs(value) / *standard_error;
}

PlanReport plan_measurement(const ScenarioSource& source, const std::vector<std::pair<std::string, std::string>>& overrides,
                            const MeasurementPlan& wanted, const std::vector<DesignInput>& design, const Watch& watch) {
  using namespace plan;
  const Scene given = scene_to_measure(source, overrides);
  PlanReport report;
  report.plan = completed(wanted, given);
  report.scenario_name = given.scenario().name;
  report.scenario_sha256 = given.sha256();
  const double until_s = *report.plan.until_s;
  report.rows = count_rows(report.plan.every_s, until_s);
  const Numbers numbers = numbers_of(source, overrides, given, report.plan);
  report.notes = numbers.notes;
  require_design(source, overrides, design);

  const double of_numbers = static_cast<double>(numbers.names.size());
  const double of_design = design.empty() ? 0 : expected_designs(design.size()) * (1 + 4 * of_numbers);
  Parts parts(watch, 2 * kVerdict + 2 * (1 + 6 * of_numbers) + of_design);
  const LongScene lasting = reliable_scene(source, overrides, given, until_s, parts);
  const auto& [status, reached_s, verdict] = lasting.judged;
  if (status == RunStatus::completed) {
    report.verdict = verdict.verdict;
    if (verdict.verdict == Verdict::marginal) report.notes.push_back(fmt::format("marginal: {}", verdict.reason));
  }
  const EstimatedInputs inputs(source, lasting.overrides, lasting.scene, numbers.names, kMostNumbers);
  const measure::ExactInputs exact(lasting.scene, numbers.names, [&](const std::vector<std::string>& names) {
    return EstimatedInputs(source, lasting.overrides, lasting.scene, names, measure::ExactInputs::kMost);
  });
  for (std::size_t j = 0; j < inputs.list().size(); ++j) {
    const measure::EstimatedInput& input = inputs.list()[j];
    report.estimates.push_back({input.name, input.unit, input.start, j >= report.plan.estimates.size(), {}, {}, {}, {}, {}});
  }
  for (const InputPrior& prior : numbers.priors) report.estimates[prior.input].prior = prior.standard_error;
  if (status == RunStatus::interrupted) {
    report.outcome = PlanOutcome::interrupted;
    report.status = status;
    return report;
  }

  bool has_tilt = false;
  const std::vector<PlannedQuantity> quantities = with_tilt(report.plan.quantities, has_tilt);
  Grid grid = grid_of(report.rows, 2 * quantities.size(), lasting.until_s > until_s ? 2 : 1);
  grid.has_tilt = has_tilt;
  const std::size_t grid_rows = (report.rows - 1) * grid.density * grid.extent + 1;
  const Watch work = parts.next(2 * (1 + 6 * of_numbers), "derivatives");
  const Derivatives derivatives = derivatives_of(
      lasting.scene, exact.all(), exact.fitted(), quantities,
      planned_times(report.plan.every_s / static_cast<double>(grid.density), grid_rows), work, report.predictions);
  report.status = derivatives.status;
  report.outcome = derivatives.outcome;
  report.reason = derivatives.reason;
  if (derivatives.outcome != PlanOutcome::determined) return report;
  const std::vector<double> scales = scales_of(inputs);
  const ValueChoice choice{grid.density, report.rows, 1, report.plan.correlation_time_s, report.plan.quantities.size()};
  for (const PlannedValue& value : derivatives.values)
    if (value.row % grid.density == 0 && value.row / grid.density < report.rows && value.quantity < choice.quantities)
      ++report.values;
  const Bound bound = bound_of(derivatives, scales, numbers.priors, choice);
  if (!bound.is_determined()) {
    describe_undetermined(report, bound);
    return report;
  }
  fill_in_errors(report, bound);
  add_findings(report, lasting.scene, exact, derivatives_by_all(derivatives, scales, numbers.priors, choice));
  compare_changes(report, derivatives, scales, numbers.priors, grid, bound, work);
  if (!design.empty()) {
    report.optimum =
        best_design(source, overrides, report.plan, numbers, design, parts.next(of_design, "design"), report.predictions);
    if (!report.optimum)
      report.notes.emplace_back("no design within the limits has a motion that can be relied on and determines all numbers");
  }
  if (watch.asks_to_stop()) {
    report.outcome = PlanOutcome::interrupted;
    report.status = RunStatus::interrupted;
  }
  return report;
}

}  // namespace earthtop
