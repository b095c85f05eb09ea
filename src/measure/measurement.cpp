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
#include "measure/compared_release.hpp"
#include "measure/estimation.hpp"
#include "measure/findings.hpp"
#include "measure/joint_inputs.hpp"
#include "measure/measured_motion.hpp"
#include "measure/priors.hpp"
#include "run/looks.hpp"

namespace earthtop {
namespace measure {
namespace {

/// Refuses rows that no computation can predict. Adds a note where the motion depends on digits that are not known.
void require_reliable(MeasurementReport& report, const ComparedRelease& release, const Watch& watch) {
  const Measurement& measurement = release.measurement();
  const auto [status, reached_s, verdict] = judged_motion(release.scene(), last_time_s(measurement), watch);
  if (status == RunStatus::interrupted) report.status = status;
  if (status != RunStatus::completed) return;
  report.verdict = verdict.verdict;
  if (verdict.verdict == Verdict::marginal) report.notes.push_back(fmt::format("marginal: {}", verdict.reason));
  if ((verdict.verdict != Verdict::unstable && verdict.verdict != Verdict::chaotic) || !verdict.from_s) return;
  for (const MeasuredValue& value : measurement.values)
    if (verdict.doubts_motion(end_time_s(value))) {
      const std::string message =
          fmt::format("after {:.6g} s the scenario's motion is {}, and its prediction means nothing: {}; leave out {}",
                      *verdict.from_s, to_string(verdict.verdict), verdict.reason,
                      verdict.until_s ? fmt::format("the rows from then to {:.6g} s", *verdict.until_s) : "later rows");
      throw ScenarioError(std::vector<Diagnostic>{{static_cast<int>(value.line), 1, "", message}}, measurement.file);
    }
}

/// Means of neighbouring axes, each of `each` of them, of which the outer ones count less.
std::vector<PredictedAxis> means_of(const std::vector<PredictedAxis>& axes, std::size_t each, const Scenario& scenario) {
  using enum MeasuredQuantity;
  std::vector<PredictedAxis> means;
  for (std::size_t begin = 0; begin + each <= axes.size(); begin += each) {
    // A part that does not swing as the axis does has the value in the middle.
    PredictedAxis mean = axes[begin + each / 2];
    mean.t_s = (axes[begin].t_s + axes[begin + each - 1].t_s) / 2;
    mean.n_M.setZero();
    mean[drift_tilt] = mean[drift_azimuth] = 0;
    double weights = 0;
    for (std::size_t k = 0; k < each; ++k) {
      const PredictedAxis& axis = axes[begin + k];
      const double place = (static_cast<double>(k) + 1) / (static_cast<double>(each) + 1) - 0.5, weight = 1 - 4 * place * place;
      mean.n_M += weight * axis.n_M;
      mean[drift_tilt] += weight * axis[drift_tilt];
      mean[drift_azimuth] += weight * axis[drift_azimuth];
      weights += weight;
    }
    mean.n_M.normalize();
    read_angles(mean, scenario);
    mean[drift_tilt] /= weights;
    mean[drift_azimuth] /= weights;
    means.push_back(mean);
  }
  return means;
}

/// Fills in the motion that the report's residuals are taken against, at times that resolve it, or as means over some of its swings.
/// Empty where it cannot be computed there. @param points  the least number of times
void take_curve(MeasurementReport& report, const ComparedRelease& release, std::size_t points, const Watch& watch) {
  constexpr std::size_t kMost = 6000, kSwings = 24;  // times that a document has room for; looks at two swings
  const Scene& given = release.scene();
  const Measurement& measurement = release.measurement();
  std::vector<double> values;
  if (report.fitted)
    for (const ParameterEstimate& estimate : report.estimates) values.push_back(*estimate.estimate);
  const std::optional<Scene> fitted = report.fitted ? release.inputs().scene(values) : std::nullopt;
  const double end_s = last_time_s(measurement);
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
  PredictedMotion motion = predict(fitted ? *fitted : given, times, sought_of(measurement), watch);
  report.curve_is_mean = a_window > 0;
  if (a_window > 0) motion.axes = means_of(motion.axes, a_window, given.scenario());
  report.curve = curve_of(motion, measurement);
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
  if (!(scatter > 0.3 && scatter < 3)) return;
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

/// The notes on a fit, or on chi-squared as given.
void add_notes_on_fit(FitReport& report) {
  if (report.search.spans > 0 && report.scatters_more())
    report.notes.emplace_back(
        "the start was far off, and the residuals scatter by more than their errors: the minimum may be a false one, and its "
        "error "
        "bars then mean nothing; start nearer, or estimate what a hint names");
  const ChiSquared& last = report.fitted ? *report.fitted : report.as_given;
  if (last.p_value && *last.p_value > 1 - FitReport::kLeastPValue)
    report.notes.emplace_back(
        "the scatter is smaller than the standard errors would make it: are they too large, or are the rows averages?");
}

void note_large_residuals(MeasurementReport& report) {
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

/// Predicts a release's motion, and fills in its residuals against it. @param parts  the next two are its prediction's and its verdict's
void compare_as_given(MeasurementReport& report, const ComparedRelease& release, double correlation_time_s, Parts& parts,
                      double of_verdict) {
  const Measurement& measurement = release.measurement();
  const PredictedMotion motion = predict(release.scene(), measurement, parts.next(1, "prediction"));
  report.status = motion.status;
  report.reached_s = motion.status == RunStatus::completed ? last_time_s(measurement)
                     : motion.axes.empty()                 ? 0
                                                           : motion.axes.back().t_s;
  report.residuals = residuals_of(measurement, motion);
  if (correlation_time_s > 0) whiten(report.residuals, whitening_of(report, correlation_time_s));
  report.as_given = chi_squared_of(report.residuals, {}, 0);
  if (report.status == RunStatus::completed) require_reliable(report, release, parts.next(of_verdict, "verdict"));
}

/// Tells each release its part of a fit: its own chi-squared, and the estimates that its scenario has.
void share_out(ReleasesReport& report, const JointInputs& inputs) {
  for (std::size_t r = 0; r < report.releases.size(); ++r) {
    MeasurementReport& release = report.releases[r];
    release.fit = report.fit;
    if (!report.fitted) continue;
    release.fitted = chi_squared_of(release.residuals, {}, 0);
    release.fitted->p_value.reset();
    for (const std::size_t place : inputs.places(r)) {
      const ParameterEstimate& e = report.estimates[place];
      release.estimates.push_back({e.name, e.unit, e.start, e.estimate, e.standard_error, e.standard_error_scaled});
      release.estimates.back().release = e.release;
    }
  }
}

std::optional<std::size_t> largest_of(const std::vector<MeasurementResidual>& residuals) {
  std::optional<std::size_t> largest;
  for (std::size_t i = 0; i < residuals.size(); ++i)
    if (!largest || std::abs(residuals[i].normalised()) > std::abs(residuals[*largest].normalised())) largest = i;
  return largest;
}

void require_options(const std::vector<MeasuredRelease>& releases, const MeasurementOptions& options) {
  constexpr std::size_t kMost = 64;
  if (releases.empty() || releases.size() > kMost)
    throw ScenarioError("", fmt::format("{} releases; from 1 to {} can be compared at once", releases.size(), kMost));
  if (!(options.correlation_time_s >= 0) || !std::isfinite(options.correlation_time_s))
    throw ScenarioError("--correlation-time", "must be a time of at least 0 (s)");
  const bool estimates = !options.estimates.empty() || !options.shared.empty() ||
                         std::ranges::any_of(releases, [](const MeasuredRelease& one) { return !one.estimates.empty(); });
  if (options.priors && !estimates)
    throw ScenarioError("--priors", "applies only to numbers that are estimated; name them with --estimate");
  if (!options.shared.empty() && releases.size() == 1)
    throw ScenarioError("--shared", "is for several releases; for one, name all numbers with --estimate");
}

/// An error with the file of its release's scenario, where it names no file.
ScenarioError in_release(const ScenarioError& error, const MeasuredRelease& release) {
  return error.file().empty() ? ScenarioError(error.diagnostics(), release.source.file) : error;
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

bool FitReport::contradicts_known_rate() const {
  return std::any_of(estimates.begin(), estimates.end(), [](const ParameterEstimate& estimate) {
    return estimate.finding && estimate.finding->outcome() == RateOutcome::contradicts;
  });
}

bool FitReport::fit_agrees() const {
  if (fit != FitOutcome::not_asked && fit != FitOutcome::converged) return false;
  if (contradicts_known_rate()) return false;
  const ChiSquared& last = fitted ? *fitted : as_given;
  return last.degrees_of_freedom <= 0 || (last.p_value && *last.p_value >= kLeastPValue);
}

bool MeasurementReport::agrees() const { return status == RunStatus::completed && fit_agrees(); }

RunStatus ReleasesReport::status() const {
  const auto ended =
      std::ranges::find_if(releases, [](const MeasurementReport& one) { return one.status != RunStatus::completed; });
  return ended == releases.end() ? RunStatus::completed : ended->status;
}

bool ReleasesReport::agrees() const { return status() == RunStatus::completed && fit_agrees(); }

ReleasesReport compare_releases(const std::vector<MeasuredRelease>& given, const MeasurementOptions& options,
                                const Watch& watch) {
  using namespace measure;
  require_options(given, options);
  std::vector<ComparedRelease> releases;
  std::vector<const EstimatedInputs*> of_releases;
  std::vector<std::size_t> fitted;
  releases.reserve(given.size());
  for (const MeasuredRelease& release : given) try {
      releases.emplace_back(release, options);
      of_releases.push_back(&releases.back().inputs());
      fitted.push_back(releases.back().names().size());
    } catch (const ScenarioError& error) {
      if (given.size() == 1) throw;
      throw in_release(error, release);
    }
  const JointInputs inputs(of_releases, fitted, options.shared);
  FoundPriors priors;
  if (options.priors) priors = find_priors(releases, inputs);

  // The work of a verdict in units of a prediction's: two integrations, and the growth of disturbances.
  constexpr double kVerdict = 6;
  constexpr std::size_t kExact = 8;  // inputs that a top's fit takes as exact, roughly
  const auto number = static_cast<double>(given.size());
  const std::size_t estimates = inputs.list().size();
  const double of_fit = estimates == 0 ? 0 : number * expected_predictions(estimates);
  const double of_curve = options.curve_points > 0 ? 1 : 0;
  const double of_exact = estimates == 0 ? 0 : number * expected_derivatives(kExact);
  Parts parts(watch, number * (1 + kVerdict + of_curve) + of_fit + of_exact);
  ReleasesReport report;
  report.correlation_time_s = options.correlation_time_s;
  report.unused_priors = std::move(priors.unused);
  for (const ComparedRelease& release : releases) {
    report.releases.push_back(release.begun_report());
    compare_as_given(report.releases.back(), release, options.correlation_time_s, parts, kVerdict);
    ++report.predictions;
    if (report.releases.back().status == RunStatus::interrupted) break;
  }
  report.as_given = chi_squared_of(report.releases, {}, 0);
  const RunStatus status = report.status();
  if (estimates > 0 && status == RunStatus::completed) {
    const Eigen::MatrixXd by_fitted = fit_estimates(report, releases, inputs, std::move(priors), parts.next(of_fit, "fit"));
    if (report.fit == FitOutcome::converged)
      add_findings(report, releases, options.shared, by_fitted, parts.next(of_exact, "exact inputs"));
  } else if (estimates > 0) {
    report.fit = status == RunStatus::interrupted ? FitOutcome::interrupted : FitOutcome::prediction_failed;
    report.fit_reason = fmt::format("the scenario's own motion ended with {}", to_string(status));
  }
  share_out(report, inputs);
  add_notes_on_fit(report);
  for (std::size_t r = 0; r < report.releases.size(); ++r) {
    MeasurementReport& release = report.releases[r];
    release.largest = largest_of(release.residuals);
    if (options.correlation_time_s == 0) note_correlated_errors(release);
    note_large_residuals(release);
    if (options.curve_points > 0 && status == RunStatus::completed && report.fit != FitOutcome::interrupted)
      take_curve(release, releases[r], options.curve_points, parts.next(of_curve, "curve"));
  }
  return report;
}

MeasurementReport compare_with_measurement(const ScenarioSource& source,
                                           const std::vector<std::pair<std::string, std::string>>& overrides,
                                           const Measurement& measurement, const MeasurementOptions& options,
                                           const Watch& watch) {
  ReleasesReport joint = compare_releases({{source, overrides, measurement}}, options, watch);
  MeasurementReport report = std::move(joint.releases.front());
  std::vector<std::string> notes = std::move(report.notes);
  notes.insert(notes.end(), joint.notes.begin(), joint.notes.end());
  static_cast<FitReport&>(report) = std::move(joint);
  report.notes = std::move(notes);
  return report;
}

}  // namespace earthtop
