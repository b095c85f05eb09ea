// SPDX-License-Identifier: GPL-3.0-or-later
// Compares a measured motion with a scenario's, and fits the scenario's numbers to it.
#include "earthtop/measure/measurement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "earthtop/elementary.hpp"
#include "earthtop/results/provenance.hpp"
#include "measure/estimated_inputs.hpp"
#include "measure/estimation.hpp"
#include "measure/exact_inputs.hpp"
#include "measure/findings.hpp"
#include "measure/measured_motion.hpp"
#include "measure/priors.hpp"
#include "measure/whitening.hpp"
#include "run/looks.hpp"

namespace earthtop {
namespace measure {
namespace {

using Overrides = std::vector<std::pair<std::string, std::string>>;

/// Adds overrides that extend the scenario to the last measured time, if that is later than its end. The data that the scenario
/// reads for its duration (a table of a platform's motion) are then checked up to that time.
Overrides with_duration(Overrides overrides, const Scenario& scenario, double last_s) {
  if (last_s <= scenario.duration_s) return overrides;
  overrides.emplace_back("/motion/duration_s", fmt::format("{}", last_s));
  overrides.emplace_back("/motion/output_step_s", fmt::format("{}", last_s));
  return overrides;
}

/// Refuses rows that no computation can predict. Adds a note where the motion depends on digits that are not known.
void require_reliable(MeasurementReport& report, const Measurement& measurement, const Scene& scene, const Watch& watch) {
  const auto [status, reached_s, verdict] = judged_motion(scene, measurement.values.back().t_s, watch);
  if (status == RunStatus::interrupted) report.status = status;
  if (status != RunStatus::completed) return;
  report.verdict = verdict.verdict;
  if (verdict.verdict == Verdict::marginal) report.notes.push_back(fmt::format("marginal: {}", verdict.reason));
  if ((verdict.verdict != Verdict::unstable && verdict.verdict != Verdict::chaotic) || !verdict.from_s) return;
  for (const MeasuredValue& value : measurement.values)
    if (verdict.doubts_motion(value.t_s)) {
      const std::string message =
          fmt::format("after {:.6g} s the scenario's motion is {}, and its prediction means nothing: {}; leave out {}",
                      *verdict.from_s, to_string(verdict.verdict), verdict.reason,
                      verdict.until_s ? fmt::format("the rows from then to {:.6g} s", *verdict.until_s) : "later rows");
      throw ScenarioError(std::vector<Diagnostic>{{static_cast<int>(value.line), 1, "", message}}, measurement.file);
    }
}

/// Means of neighbouring axes, each of `each` of them, of which the outer ones count less.
std::vector<PredictedAxis> means_of(const std::vector<PredictedAxis>& axes, std::size_t each, const Scenario& scenario) {
  std::vector<PredictedAxis> means;
  for (std::size_t begin = 0; begin + each <= axes.size(); begin += each) {
    PredictedAxis mean{.t_s = (axes[begin].t_s + axes[begin + each - 1].t_s) / 2, .drift_azimuth_rad = 0.0};
    double weights = 0;
    for (std::size_t k = 0; k < each; ++k) {
      const PredictedAxis& axis = axes[begin + k];
      const double place = (static_cast<double>(k) + 1) / (static_cast<double>(each) + 1) - 0.5, weight = 1 - 4 * place * place;
      mean.n_M += weight * axis.n_M;
      mean.drift_tilt_rad += weight * axis.drift_tilt_rad;
      if (mean.drift_azimuth_rad && axis.drift_azimuth_rad)
        *mean.drift_azimuth_rad += weight * *axis.drift_azimuth_rad;
      else
        mean.drift_azimuth_rad.reset();
      weights += weight;
    }
    // The parts do not swing as the axis does.
    for (const PartQuantity& part : kPartQuantities) mean.*part.predicted = axes[begin + each / 2].*part.predicted;
    mean.n_M.normalize();
    read_angles(mean, scenario);
    mean.drift_tilt_rad /= weights;
    if (mean.drift_azimuth_rad) *mean.drift_azimuth_rad /= weights;
    means.push_back(mean);
  }
  return means;
}

/// Fills in the motion that the report's residuals are taken against, at times that resolve it, or as means over some of its swings.
/// Empty where it cannot be computed there. @param points  the least number of times
void take_curve(MeasurementReport& report, const Scene& given, const EstimatedInputs& inputs, const Measurement& measurement,
                std::size_t points, const Watch& watch) {
  constexpr std::size_t kMost = 6000, kSwings = 24;  // times that a document has room for; looks at two swings
  std::vector<double> values;
  if (report.fitted)
    for (const ParameterEstimate& estimate : report.estimates) values.push_back(*estimate.estimate);
  const std::optional<Scene> fitted = report.fitted ? inputs.scene(values) : std::nullopt;
  const double end_s = measurement.values.back().t_s;
  const bool drift = has_drifts(measurement);
  std::vector<double> times{end_s};
  std::size_t a_window = 0;
  if (end_s > 0) {
    Scenario measured = (fitted ? *fitted : given).scenario();
    measured.duration_s = end_s;
    const Scene scene(std::move(measured));
    const PicturePlan plan = plan_looks(scene, scene.choice().options).picture;
    times = plan.times_s;
    a_window = plan.looks_a_window > 0 ? plan.looks_a_window : times.size() > kMost ? kSwings : 0;
    if (a_window == 0 && times.size() < points) {
      times.clear();
      for (std::size_t k = 0; k < points; ++k)
        times.push_back(k + 1 == points ? end_s : end_s * (static_cast<double>(k) / static_cast<double>(points - 1)));
    }
  }
  PredictedMotion motion = predict(fitted ? *fitted : given, times, drift, watch);
  report.curve_is_mean = a_window > 0;
  if (a_window > 0) motion.axes = means_of(motion.axes, a_window, given.scenario());
  report.curve = angles_of(motion, drift);
}

/// The median time between successive values of a series (s).
double usual_step_s(const std::vector<const MeasurementResidual*>& series) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < series.size(); ++k) steps.push_back(series[k]->t_s - series[k - 1]->t_s);
  std::nth_element(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2), steps.end());
  return steps[steps.size() / 2];
}

/// Says which quantities have residuals of the stated size that are like their neighbours: their errors are not independent.
void note_correlated_errors(MeasurementReport& report) {
  constexpr std::size_t kFewest = 20;
  constexpr double kSignificant = 4;  // standard errors of the correlation
  const ChiSquared& last = report.fitted ? *report.fitted : report.as_given;
  const double scatter = last.value / std::max(1.0, static_cast<double>(last.degrees_of_freedom));
  if (report.correlation_time_s > 0 || !(scatter > 0.3 && scatter < 3)) return;
  std::map<std::string_view, std::vector<const MeasurementResidual*>> series;
  for (const MeasurementResidual& residual : report.residuals) series[residual.quantity].push_back(&residual);
  for (const auto& [quantity, list] : series) {
    const auto n = static_cast<double>(list.size());
    if (list.size() < kFewest) continue;
    double mean = 0, squares = 0, products = 0;
    for (const MeasurementResidual* residual : list) mean += residual->normalised() / n;
    for (std::size_t k = 0; k < list.size(); ++k) {
      const double here = list[k]->normalised() - mean;
      squares += here * here;
      if (k > 0) products += here * (list[k - 1]->normalised() - mean);
    }
    const double correlation = products / squares, step_s = usual_step_s(list);
    if (!(correlation > kSignificant / std::sqrt(n)) || !(correlation < 1) || !(step_s > 0)) continue;
    report.notes.push_back(
        fmt::format("neighbouring residuals of {} are alike (correlation {:.2f}): if the errors persist, here for about {:.1g} "
                    "s, the standard errors of the estimates are too small; state that time with --correlation-time",
                    quantity, correlation, -step_s / real::log(correlation)));
  }
}

void add_notes(MeasurementReport& report) {
  note_correlated_errors(report);
  if (report.search.spans > 0 && report.scatters_more())
    report.notes.emplace_back(
        "the start was far off, and the residuals scatter by more than their errors: the minimum may be a false one, and its "
        "error "
        "bars then mean nothing; start nearer, or estimate what a hint names");
  const ChiSquared& last = report.fitted ? *report.fitted : report.as_given;
  if (last.p_value && *last.p_value > 1 - MeasurementReport::kLeastPValue)
    report.notes.emplace_back(
        "the scatter is smaller than the standard errors would make it: are they too large, or are the rows averages?");
  const bool far = std::any_of(report.residuals.begin(), report.residuals.end(), [](const MeasurementResidual& residual) {
    return period_of(residual) > 0 && std::abs(residual.residual) > std::numbers::pi / 2;
  });
  if (far)
    report.notes.emplace_back(
        report.fit == FitOutcome::not_asked
            ? "an azimuth is off by more than a quarter turn: is it counted clockwise from North?"
            : "an azimuth is off by more than a quarter turn: is it counted clockwise from North, and does the fit start close "
              "enough?");
}

}  // namespace
}  // namespace measure

std::string_view to_string(FitOutcome outcome) {
  switch (outcome) {
    case FitOutcome::not_asked: return "not_asked";
    case FitOutcome::converged: return "converged";
    case FitOutcome::not_determined: return "not_determined";
    case FitOutcome::not_converged: return "not_converged";
    case FitOutcome::false_minimum: return "false_minimum";
    case FitOutcome::prediction_failed: return "prediction_failed";
    case FitOutcome::interrupted: return "interrupted";
  }
  return "";
}

bool MeasurementReport::contradicts_known_rate() const {
  return std::any_of(estimates.begin(), estimates.end(), [](const ParameterEstimate& estimate) {
    return estimate.finding && estimate.finding->outcome() == RateOutcome::contradicts;
  });
}

bool MeasurementReport::agrees() const {
  if (status != RunStatus::completed || (fit != FitOutcome::not_asked && fit != FitOutcome::converged)) return false;
  if (contradicts_known_rate()) return false;
  const ChiSquared& last = fitted ? *fitted : as_given;
  return last.degrees_of_freedom <= 0 || (last.p_value && *last.p_value >= kLeastPValue);
}

MeasurementReport compare_with_measurement(const ScenarioSource& source,
                                           const std::vector<std::pair<std::string, std::string>>& overrides,
                                           const Measurement& measurement, const MeasurementOptions& options,
                                           const Watch& watch) {
  using namespace measure;
  const std::vector<std::string>& estimates = options.estimates;
  if (measurement.values.empty()) throw ScenarioError("", "no measured value");
  if (!(options.correlation_time_s >= 0) || !std::isfinite(options.correlation_time_s))
    throw ScenarioError("--correlation-time", "must be a time of at least 0 (s)");
  if (options.priors && estimates.empty())
    throw ScenarioError("--priors", "applies only to numbers that are estimated; name them with --estimate");
  const Scene given = parse_scene(source, overrides);
  if (given.scenario().effects.automatic)
    throw ScenarioError("/effects", "the choice of effects is left to the program; to compare with a measurement, name them");
  const auto longer = with_duration(overrides, given.scenario(), measurement.values.back().t_s);
  const Scene scene = parse_scene(source, longer);
  const EstimatedInputs inputs(source, longer, scene, estimates);
  const auto inputs_of = [&](const std::vector<std::string>& names) {
    return EstimatedInputs(source, longer, scene, names, ExactInputs::kMost);
  };
  FoundPriors priors;
  if (options.priors) priors = find_priors(scene, inputs.list());

  MeasurementReport report;
  report.correlation_time_s = options.correlation_time_s;
  report.unused_priors = std::move(priors.unused);
  report.scenario_name = given.scenario().name;
  report.scenario_sha256 = given.sha256();
  report.file = measurement.file;
  report.rows = measurement.rows;
  std::map<MeasuredQuantity, std::uint64_t> counts;
  for (const MeasuredValue& value : measurement.values) ++counts[value.quantity];
  report.quantities.assign(counts.begin(), counts.end());

  // The work of a verdict in units of a prediction's: two integrations, and the growth of disturbances.
  constexpr double kVerdict = 6;
  const double of_fit = estimates.empty() ? 0 : expected_predictions(estimates.size());
  const double of_curve = options.curve_points > 0 ? 1 : 0;
  constexpr std::size_t kExact = 8;  // inputs that a top's fit takes as exact, roughly
  const double of_exact = estimates.empty() ? 0 : expected_derivatives(estimates.size() + kExact);
  Parts parts(watch, 1 + kVerdict + of_fit + of_exact + of_curve);
  const PredictedMotion motion =
      predict(scene, measured_times(measurement), has_drifts(measurement), parts.next(1, "prediction"));
  report.predictions = 1;
  report.status = motion.status;
  report.reached_s = motion.axes.empty() ? 0 : motion.axes.back().t_s;
  report.residuals = residuals_of(measurement, motion);
  if (report.correlation_time_s > 0) whiten(report.residuals, whitening_of(report));
  report.as_given = chi_squared_of(report.residuals, {}, 0);
  if (report.status == RunStatus::completed) require_reliable(report, measurement, scene, parts.next(kVerdict, "verdict"));
  if (!estimates.empty()) {
    if (report.status == RunStatus::completed) {
      fit_estimates(report, measurement, inputs, std::move(priors), parts.next(of_fit, "fit"));
      if (report.fit == FitOutcome::converged)
        add_findings(report, measurement, scene, ExactInputs(scene, estimates, inputs_of), inputs_of, whitening_of(report),
                     parts.next(of_exact, "exact inputs"));
    } else {
      report.fit = report.status == RunStatus::interrupted ? FitOutcome::interrupted : FitOutcome::prediction_failed;
      report.fit_reason = fmt::format("the scenario's own motion ended with {}", to_string(report.status));
    }
  }
  for (std::size_t i = 0; i < report.residuals.size(); ++i)
    if (!report.largest ||
        std::abs(report.residuals[i].normalised()) > std::abs(report.residuals[*report.largest].normalised()))
      report.largest = i;
  add_notes(report);
  if (options.curve_points > 0 && report.status == RunStatus::completed && report.fit != FitOutcome::interrupted)
    take_curve(report, scene, inputs, measurement, options.curve_points, parts.next(of_curve, "curve"));
  return report;
}

}  // namespace earthtop
