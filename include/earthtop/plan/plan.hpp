// SPDX-License-Identifier: GPL-3.0-or-later
/// Planning of a measurement: what it would show about a scenario's numbers, before anything is built.
///
/// The standard errors are the Cramer-Rao bound: no unbiased estimate has smaller ones, and a weighted fit reaches them as long
/// as the errors are small enough for the motion to depend linearly on the numbers. They follow from the derivatives of the
/// predicted values with respect to the numbers, which are those of `compare --estimate`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "earthtop/measure/measurement.hpp"
#include "earthtop/plot/plot.hpp"

namespace earthtop {

/// A quantity that will be measured.
struct PlannedQuantity {
  std::string name;  ///< with its unit, e.g. "azimuth_deg"
  MeasuredQuantity quantity = MeasuredQuantity::azimuth;
  std::string unit;           ///< "rad", "deg" or "arcsec"; "rad_s" or "rpm"
  double unit_size = 1;       ///< (rad, or rad/s of a rate)
  double standard_error = 0;  ///< of each value, in the unit; for an axis: of each of the two components at right angles to it
};

/// @param name  a quantity of a measurement file with its unit, e.g. "azimuth_deg", "axis_arcsec"
/// @throws ScenarioError for another name, and for a standard error that is not above 0
PlannedQuantity planned_quantity(const std::string& name, double standard_error);

struct MeasurementPlan {
  std::vector<PlannedQuantity> quantities;
  double every_s = 0;             ///< distance of rows in time (s); the first row is at the release
  std::optional<double> until_s;  ///< time of the last row (s); the scenario's duration if not given
  double correlation_time_s = 0;  ///< the errors of a quantity are correlated by exp(-dt / correlation_time_s); 0: independent
  std::vector<std::string> estimates;  ///< names as for `compare_with_measurement`; empty: the Earth's rate, as below
  std::vector<std::string> nuisances;  ///< names of further numbers that are not known and have to be fitted as well
  /// Names of numbers that have one value in all of several releases; those that are no nuisances are estimated.
  std::vector<std::string> shared = {};
};

/// A release that is planned: its scenario and `--set` pairs.
struct PlannedRelease {
  ScenarioSource source;
  std::vector<std::pair<std::string, std::string>> overrides;
};

/// One of the fitted numbers, in `unit`.
struct PlannedEstimate {
  std::string name;
  std::string unit;
  double value = 0;                      ///< the scenario's
  bool is_nuisance = false;              ///< whether it is fitted only because it is not known
  std::optional<double> prior;           ///< standard error with which it is known already, from the scenario's `uncertainty`
  std::optional<double> standard_error;  ///< Cramer-Rao bound; none where the plan does not determine all numbers
  std::optional<double> standard_error_alone;  ///< the same if all other numbers were known exactly
  std::optional<RateFinding> finding;          ///< of a rate of the Earth: what a measurement of the scenario's value would say
  std::vector<ExactInput> exact;  ///< of a number that is wanted: inputs that are taken as exact and shift it, most first
  std::size_t release = 0;        ///< of several, the one whose number it is, counted from 1; 0: that of all
  /// |value| / standard error
  std::optional<double> significance() const;
};

/// A change of the plan, and the standard error of the first estimate that it leads to.
enum class PlanChange {
  duration,  ///< the measurement lasts `factor` times as long
  rows,      ///< `factor` times as many rows in the same time
  sigma,     ///< standard errors `factor` times as large
  known,     ///< an unknown is known exactly
  prior,     ///< an unknown is known beforehand with `input_error`
  tilt       ///< the tilt is measured, too
};
std::string_view to_string(PlanChange change);
struct PlanVariation {
  PlanChange change = PlanChange::duration;
  double factor = 1;
  std::string input;       ///< of `known` and `prior`: the unknown, as name_in_release calls it
  double input_error = 0;  ///< of `prior`: its standard error
  std::uint64_t rows = 0;
  std::optional<double> standard_error;  ///< of the first estimate; none where it is not determined
};

/// A number of the scenario that may be chosen, within limits.
struct DesignInput {
  std::string pointer;
  double low = 0, high = 0;
};
/// "/release/tilt_deg=5:60" @throws ScenarioError
DesignInput design_input(const std::string& text);

struct DesignChoice {
  DesignInput input;
  double given = 0;  ///< the scenario's value
  double best = 0;
  bool is_at_limit = false;  ///< within a thousandth of the range from a limit
};
struct PlanOptimum {
  std::vector<DesignChoice> choices;
  double standard_error = 0;  ///< of the first estimate, there
  double significance = 0;
  std::uint64_t rows = 0;
  std::int64_t evaluations = 0;  ///< number of designs that were tried
  std::int64_t avoided = 0;      ///< those without such a motion, or with one that cannot be relied on
};

enum class PlanOutcome {
  determined,
  not_determined,     ///< the planned values do not change with a number, or with a combination of numbers
  prediction_failed,  ///< no motion could be computed, or none next to the scenario's numbers
  interrupted
};
std::string_view to_string(PlanOutcome outcome);

/// One release of several.
struct ReleasePlan {
  std::string scenario_name;
  std::string scenario_sha256;
  std::optional<double>
      standard_error;  ///< of the first estimate from this release alone; none where it does not determine all
};

struct PlanReport {
  std::string scenario_name;  ///< of the first release
  std::string scenario_sha256;
  MeasurementPlan plan;      ///< with its defaults filled in
  std::uint64_t rows = 0;    ///< of each release
  std::uint64_t values = 0;  ///< number of measured numbers of all releases; an axis counts as two
  RunStatus status = RunStatus::completed;
  std::optional<Verdict> verdict;  ///< of a run to the last row; of several releases, the first that is not reliable
  PlanOutcome outcome = PlanOutcome::determined;
  std::string reason;  ///< why the numbers are not determined, or not predicted
  /// Where the information matrix is singular, the change of the numbers, each in its unit, that no row would notice. It is a small
  /// one: a hundredth of the scale of the number that changes most.
  std::vector<std::pair<std::string, double>> undetermined;
  std::vector<PlannedEstimate> estimates;
  std::vector<std::vector<double>> correlation;  ///< matrix of the estimates' errors
  std::vector<PlanVariation> variations;         ///< the tables: each unknown known exactly, durations, rows, standard errors
  std::vector<PlanVariation> changes;            ///< what could be changed, the most effective one first
  std::string advice;                            ///< what to change first
  std::int64_t predictions = 0;                  ///< number of motions computed
  std::vector<std::string> notes;
  std::optional<PlanOptimum> optimum;
  std::vector<ReleasePlan> releases;  ///< of several; empty for one
};

/// Computes what a planned measurement would show. Without estimates the vertical component of the Earth's rate is estimated,
/// or for a scene with a gimbal that holds the axis level, a gyrocompass, the northward one. Each standard error of the
/// scenario's `uncertainty` makes an input that is fitted as well, with that prior.
/// @param overrides  `--set` pairs
/// @param design  numbers to be chosen so that the first estimate's standard error is least; at most 4. The duration is that of
/// the measurement, too.
/// @throws ScenarioError for a scenario, a name or a plan that is refused: rows after the time until which a run of the scenario
/// is reliable, where it is unstable or chaotic, among them; ArithmeticError as `run` does
/// While this runs, GSL's error handler, of which the process has only one, is off.
PlanReport plan_measurement(const ScenarioSource& source, const std::vector<std::pair<std::string, std::string>>& overrides,
                            const MeasurementPlan& plan, const std::vector<DesignInput>& design = {}, const Watch& watch = {});

/// The same for several releases that are measured alike and evaluated by one fit. Inputs of the body, the site and the Earth whose
/// standard errors the scenarios state are shared where they are the same.
/// @throws ScenarioError as plan_measurement; at most 16 releases
PlanReport plan_releases(const std::vector<PlannedRelease>& releases, const MeasurementPlan& plan, const Watch& watch = {});

/// The motion of the scenario as the plan would measure it, with normally distributed errors, as a CSV file that
/// `read_measurement` reads. The same seed gives the same bytes on every machine. Errors are correlated in time if the plan
/// says so.
/// @throws as plan_measurement; std::nullopt if the watch asked to stop
std::optional<std::string> simulated_measurement(const ScenarioSource& source,
                                                 const std::vector<std::pair<std::string, std::string>>& overrides,
                                                 const MeasurementPlan& plan, std::uint64_t seed, const Watch& watch = {});

/// The report as one JSON document, "earthtop-plan-1.json"; what is not finite is null.
std::string plan_json(const PlanReport& report);

/// The first estimate's standard error over factors of duration, of rows and of the values' accuracy.
Figure plan_figure(const PlanReport& report);

}  // namespace earthtop
