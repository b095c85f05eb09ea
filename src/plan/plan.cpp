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
#include "measure/quantities.hpp"
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

/// @param quantities  the planned ones and, for a look at it, a tilt
Grid grid_of(std::size_t rows, const std::vector<PlannedQuantity>& quantities, std::size_t extent) {
  // Between the rows there is no further turning point or passage.
  const bool are_values = std::ranges::all_of(
      quantities, [](const PlannedQuantity& one) { return measure::row_of(one.quantity).feature == measure::Feature::value; });
  Grid grid{are_values ? std::size_t{4} : 1, extent, false};
  while (grid.density > 1 && rows * 2 * quantities.size() * grid.density * extent > kMostGridValues) grid.density /= 2;
  return grid;
}

void describe_undetermined(PlanReport& report, const Bound& bound) {
  report.outcome = PlanOutcome::not_determined;
  std::vector<std::string> names;
  for (const std::size_t j : bound.undetermined) {
    names.push_back(name_in_release(report.estimates[j].name, report.estimates[j].release));
    report.undetermined.emplace_back(names.back(), bound.direction[j]);
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

/// A planned release: its scenario, what is estimated of it, and its motion to the end of the plan or beyond.
struct Release {
  Scene given;
  Numbers numbers;
  LongScene lasting;
  EstimatedInputs inputs;
};

Release prepared(const PlannedRelease& planned, const MeasurementPlan& plan, Parts& parts) {
  Scene given = scene_to_measure(planned.source, planned.overrides);
  Numbers numbers = numbers_of(planned.source, planned.overrides, given, plan);
  LongScene lasting = reliable_scene(planned.source, planned.overrides, given, *plan.until_s, parts);
  EstimatedInputs inputs(planned.source, lasting.overrides, lasting.scene, numbers.names, kMostNumbers);
  return {std::move(given), std::move(numbers), std::move(lasting), std::move(inputs)};
}

std::vector<measure::ExactInputs> exact_inputs_of(const std::vector<PlannedRelease>& planned,
                                                  const std::vector<Release>& releases) {
  std::vector<measure::ExactInputs> exact;
  for (std::size_t r = 0; r < releases.size(); ++r)
    exact.emplace_back(releases[r].lasting.scene, releases[r].numbers.names, [&](const std::vector<std::string>& names) {
      return EstimatedInputs(planned[r].source, releases[r].lasting.overrides, releases[r].lasting.scene, names,
                             measure::ExactInputs::kMost);
    });
  return exact;
}

/// The names of numbers with one value in all releases: those of the plan, and common ones that only a stated standard error makes a
/// number of the fit.
std::vector<std::string> shared_names(const std::vector<Release>& releases, const MeasurementPlan& plan) {
  std::vector<std::string> shared = plan.shared;
  const Release& first = releases.front();
  for (std::size_t k = first.numbers.asked; k < first.inputs.list().size(); ++k) {
    const measure::EstimatedInput& input = first.inputs.list()[k];
    const auto has_it = [&](const Release& release) {
      const auto same = std::ranges::find(release.inputs.list(), input.name, &measure::EstimatedInput::name);
      return same != release.inputs.list().end() && measure::is_common(input, *same);
    };
    if (std::ranges::all_of(releases, has_it)) shared.push_back(input.name);
  }
  return shared;
}

/// Collects what is known beforehand of all numbers; several scenarios' standard errors of a shared one are one datum.
std::vector<InputPrior> priors_of(const std::vector<Release>& releases, const measure::JointInputs& inputs) {
  std::vector<InputPrior> priors;
  for (std::size_t r = 0; r < releases.size(); ++r) {
    const std::vector<InputPrior> of_others = priors;
    for (const InputPrior& prior : releases[r].numbers.priors) {
      const std::size_t place = inputs.places(r)[prior.input];
      if (std::ranges::find(of_others, place, &InputPrior::input) == of_others.end())
        priors.push_back({place, prior.standard_error});
    }
  }
  return priors;
}

/// Fills in the verdict, of several releases the first that is not reliable, and what is doubtful of the motions.
/// @returns whether the work was interrupted
bool judge(PlanReport& report, const std::vector<Release>& releases) {
  for (const Release& release : releases) {
    const auto& [status, reached_s, verdict] = release.lasting.judged;
    if (status == RunStatus::interrupted) return true;
    if (status != RunStatus::completed) continue;
    if (report.verdict.value_or(Verdict::reliable) == Verdict::reliable) report.verdict = verdict.verdict;
    if (verdict.verdict == Verdict::marginal) report.notes.push_back(fmt::format("marginal: {}", verdict.reason));
  }
  return false;
}

/// Says what a measurement of the scenarios' own motions would tell of the Earth's rate, and which inputs it takes as exact.
void add_findings(PlanReport& report, const std::vector<Release>& releases, const measure::JointExactInputs& exact,
                  const Eigen::MatrixXd& J) {
  for (std::size_t j = 0; j < report.estimates.size(); ++j) {
    PlannedEstimate& estimate = report.estimates[j];
    const measure::JointInput& input = exact.all().list()[j];
    const auto known = measure::known_rate(releases[input.release > 0 ? input.release - 1 : 0].lasting.scene, input);
    if (known && *estimate.standard_error > 0)
      estimate.finding = rate_finding(estimate.value, *estimate.standard_error, *known, estimate.prior);
    if (!estimate.is_nuisance) estimate.exact = exact.shifting(J, j);
  }
}

/// Fills in what each of several releases would tell by itself of the first estimate.
void add_releases(PlanReport& report, const std::vector<Release>& releases, const std::vector<Derivatives>& derivatives,
                  const ValueChoice& choice) {
  for (std::size_t r = 0; r < releases.size(); ++r) {
    ReleasePlan of_one{releases[r].given.scenario().name, releases[r].given.sha256(), {}};
    const auto& list = releases[r].inputs.list();
    const auto first = std::ranges::find(list, report.estimates[0].name, &measure::EstimatedInput::name);
    if (first != list.end() && (report.estimates[0].release == 0 || report.estimates[0].release == r + 1))
      of_one.standard_error = bound_of(derivatives[r], scales_of(list), releases[r].numbers.priors, choice)
                                  .standard_error(static_cast<std::size_t>(first - list.begin()));
    report.releases.push_back(std::move(of_one));
  }
}

/// The plan with its defaults. @throws ScenarioError where releases last differently, and the plan does not say until when it measures
MeasurementPlan completed_for(const std::vector<PlannedRelease>& planned, MeasurementPlan plan) {
  constexpr std::size_t kMost = 16;
  if (planned.empty() || planned.size() > kMost)
    throw ScenarioError("", fmt::format("{} releases; from 1 to {} can be planned at once", planned.size(), kMost));
  if (!plan.shared.empty() && planned.size() == 1)
    throw ScenarioError("--shared", "is for several releases; for one, name numbers with --estimate or --nuisance");
  std::optional<double> lasts_s;
  for (const PlannedRelease& release : planned) {
    const Scene scene = scene_to_measure(release.source, release.overrides);
    const double duration_s = scene.scenario().duration_s;
    if (!plan.until_s && lasts_s && *lasts_s != duration_s)
      throw ScenarioError("--until", fmt::format("missing: the scenarios last {:g} s and {:g} s; say until when is measured",
                                                 *lasts_s, duration_s));
    lasts_s = duration_s;
    if (&release == &planned.back()) return completed(std::move(plan), scene);
  }
  return plan;
}

/// The work of a plan's parts, in units of a prediction's.
double work_of_numbers(std::size_t releases) { return static_cast<double>(releases) * 2 * (1 + 6.0 * kMostNumbers); }

/// Begins the report: what is estimated of which release.
void begin(PlanReport& report, const std::vector<Release>& releases, const measure::JointInputs& inputs,
           const std::vector<InputPrior>& priors) {
  report.scenario_name = releases.front().given.scenario().name;
  report.scenario_sha256 = releases.front().given.sha256();
  for (const Release& release : releases)
    for (const std::string& note : release.numbers.notes)
      if (std::ranges::find(report.notes, note) == report.notes.end()) report.notes.push_back(note);
  for (std::size_t j = 0; j < inputs.fitted(); ++j) {
    const measure::JointInput& input = inputs.list()[j];
    report.estimates.push_back(
        {input.name, input.unit, input.start, !is_wanted(input.name, report.plan), {}, {}, {}, {}, {}, input.release});
  }
  for (const InputPrior& prior : priors) report.estimates[prior.input].prior = prior.standard_error;
}

/// The derivatives of all releases. @returns none where a motion could not be predicted: the report says so
std::optional<std::vector<Derivatives>> derivatives_of_all(PlanReport& report, const std::vector<Release>& releases,
                                                           const std::vector<measure::ExactInputs>& exact,
                                                           const std::vector<PlannedQuantity>& quantities, const Grid& grid,
                                                           Parts& parts) {
  const std::size_t rows = (report.rows - 1) * grid.density * grid.extent + 1;
  const std::vector<double> times_s = planned_times(report.plan.every_s / static_cast<double>(grid.density), rows);
  std::vector<Derivatives> all;
  for (std::size_t r = 0; r < releases.size(); ++r) {
    all.push_back(derivatives_of(releases[r].lasting.scene, exact[r].all(), exact[r].fitted(), quantities, times_s,
                                 parts.next(work_of_numbers(1), "derivatives"), report.predictions));
    report.status = all.back().status;
    report.outcome = all.back().outcome;
    report.reason = all.back().reason;
    if (report.outcome != PlanOutcome::determined) return std::nullopt;
  }
  return all;
}

PlanReport plan_all(const std::vector<PlannedRelease>& planned, const MeasurementPlan& wanted,
                    const std::vector<DesignInput>& design, const Watch& watch) {
  PlanReport report;
  report.plan = completed_for(planned, wanted);
  const double until_s = *report.plan.until_s;
  report.rows = count_rows(report.plan.every_s, until_s);
  const auto& [source, overrides] = planned.front();
  require_design(source, overrides, design);
  const double of_design = design.empty() ? 0 : expected_designs(design.size()) * (1 + 4.0 * kMostNumbers);
  Parts parts(watch, static_cast<double>(planned.size()) * 2 * kVerdict + work_of_numbers(planned.size()) + of_design);
  std::vector<Release> releases;
  releases.reserve(planned.size());
  for (const PlannedRelease& release : planned) releases.push_back(prepared(release, report.plan, parts));

  const std::vector<measure::ExactInputs> exact_of = exact_inputs_of(planned, releases);
  const measure::JointExactInputs exact(exact_of, shared_names(releases, report.plan));
  const std::vector<InputPrior> priors = priors_of(releases, exact.all());
  begin(report, releases, exact.all(), priors);
  if (judge(report, releases)) {
    report.outcome = PlanOutcome::interrupted;
    report.status = RunStatus::interrupted;
    return report;
  }

  bool has_tilt = false;
  const std::vector<PlannedQuantity> quantities = with_tilt(report.plan.quantities, has_tilt);
  const bool can_last = std::ranges::all_of(releases, [&](const Release& one) { return one.lasting.until_s > until_s; });
  Grid grid = grid_of(report.rows, quantities, can_last ? 2 : 1);
  grid.has_tilt = has_tilt;
  const auto of_releases = derivatives_of_all(report, releases, exact_of, quantities, grid, parts);
  if (!of_releases) return report;
  const Derivatives derivatives = joined(*of_releases, exact.all());
  std::vector<double> scales;
  scales.reserve(exact.fitted());
  for (std::size_t j = 0; j < exact.fitted(); ++j) scales.push_back(exact.all().list()[j].scale);
  const ValueChoice choice{grid.density, report.rows, 1, report.plan.correlation_time_s, report.plan.quantities.size()};
  for (const PlannedValue& value : derivatives.values)
    if (value.row % grid.density == 0 && value.row / grid.density < report.rows && value.quantity < choice.quantities)
      ++report.values;
  const Bound bound = bound_of(derivatives, scales, priors, choice);
  if (!bound.is_determined()) {
    describe_undetermined(report, bound);
    return report;
  }
  fill_in_errors(report, bound);
  add_findings(report, releases, exact, derivatives_by_all(derivatives, scales, priors, choice));
  compare_changes(report, derivatives, scales, priors, grid, bound, watch);
  if (releases.size() > 1) add_releases(report, releases, *of_releases, choice);
  if (!design.empty()) {
    report.optimum = best_design(source, overrides, report.plan, releases.front().numbers, design,
                                 parts.next(of_design, "design"), report.predictions);
    if (!report.optimum)
      report.notes.emplace_back("no design within the limits has a motion that can be relied on and determines all numbers");
  }
  if (watch.asks_to_stop()) {
    report.outcome = PlanOutcome::interrupted;
    report.status = RunStatus::interrupted;
  }
  return report;
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
                            const MeasurementPlan& plan, const std::vector<DesignInput>& design, const Watch& watch) {
  return plan::plan_all({{source, overrides}}, plan, design, watch);
}

PlanReport plan_releases(const std::vector<PlannedRelease>& releases, const MeasurementPlan& plan, const Watch& watch) {
  return plan::plan_all(releases, plan, {}, watch);
}

}  // namespace earthtop
