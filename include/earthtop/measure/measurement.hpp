// SPDX-License-Identifier: GPL-3.0-or-later
/// A measured motion held against a scenario: residuals, chi-squared, and what the measurement says of the scenario's numbers.
///
/// The prediction is one integration in double at the measured times, good to some 1e-11 rad; that error is small against any
/// measurement's, and is not added to it. Where disturbances grow, it means nothing from the time on that a run's verdict
/// names: later rows are refused.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "earthtop/error.hpp"
#include "earthtop/run.hpp"
#include "earthtop/scenario/scenario.hpp"

namespace earthtop {

/// The quantities of body axis 3 that can be measured, in the laboratory (East, North, Up): compass azimuth, clockwise from
/// North seen from above; tilt from Up; the axis itself; and the drifts of azimuth and tilt, which are the motion on the
/// rotating Earth less the non-rotating prediction, as one gets them from a measured motion and a calculated one.
enum class MeasuredQuantity { azimuth, tilt, axis, drift_azimuth, drift_tilt };
std::string_view to_string(MeasuredQuantity quantity);

struct MeasuredValue {
  MeasuredQuantity quantity = MeasuredQuantity::azimuth;
  double t_s = 0;                  ///< since the release
  double angle_rad = 0;            ///< of all but the axis; azimuths modulo 2 pi
  std::array<double, 3> axis_L{};  ///< unit vector
  double standard_error_rad = 0;   ///< of an axis: of each of its two components at right angles to it
  std::uint64_t line = 0;          ///< in the file
};

struct Measurement {
  std::string file;
  std::uint64_t rows = 0;             ///< lines of numbers
  std::vector<MeasuredValue> values;  ///< in the file's order, so that times ascend
};

/// Reads a CSV file with a header line. Columns, each with its unit in its name:
///   t_s                                            since the release, from 0 on, ascending; several rows may have one time
///   azimuth_rad, _deg or _arcsec                   with its standard error azimuth_se_rad, _deg or _arcsec
///   tilt_*, drift_azimuth_*, drift_tilt_*          likewise
///   axis_L_x, axis_L_y, axis_L_z                   unit vector, normalised here; with axis_se_*
/// An empty cell was not measured; a measured value needs its standard error, above 0. Columns that begin with `_` are passed
/// over. At most 200,000 rows.
/// @throws ScenarioError with what is wrong, where in the file, and what is allowed; ReadError
Measurement read_measurement(const std::string& csv_file);

/// One measured number against the predicted one. An axis gives two: `axis_tilt` and `axis_azimuth`, whose residuals are the
/// components of the turn from the predicted to the measured axis along growing tilt and along growing azimuth (the latter a
/// difference of azimuths times sin(tilt)), while measured and predicted are tilts and azimuths.
struct MeasurementResidual {
  double t_s = 0;
  std::uint64_t line = 0;
  std::string_view quantity;
  double measured_rad = 0;
  double predicted_rad = 0;  ///< NaN for the azimuth of a vertical axis
  double residual_rad = 0;   ///< measured less predicted; of azimuths from -pi to pi
  double standard_error_rad = 0;
  double normalised() const { return residual_rad / standard_error_rad; }
};

/// The sum of the squares of the normalised residuals.
struct ChiSquared {
  double value = 0;
  std::int64_t degrees_of_freedom = 0;
  /// Chance of a larger one, if scenario and standard errors are right and errors are normal; none without freedom.
  std::optional<double> p_value;
};

enum class FitOutcome {
  not_asked,
  converged,
  not_determined,     ///< the predicted values do not change with an input, or with a combination of them
  not_converged,      ///< no least sum of squares within the allowed iterations
  prediction_failed,  ///< no motion could be computed beside the scenario's own
  interrupted
};
std::string_view to_string(FitOutcome outcome);

/// One of the scenario's numbers, as the measurement has it. Its name and `unit` say in which unit.
struct ParameterEstimate {
  std::string name;
  std::string unit;
  double start = 0;                      ///< the scenario's
  std::optional<double> estimate;        ///< none where the fit did not converge
  std::optional<double> standard_error;  ///< from the stated standard errors
  /// The same times sqrt(chi-squared / degrees of freedom) where that is above 1: what the scatter shows.
  std::optional<double> standard_error_scaled;
};

struct MeasurementReport {
  /// A chance below which the scatter is not that of the stated errors.
  static constexpr double kLeastPValue = 1e-3;

  std::string scenario_name;
  std::string scenario_sha256;  ///< of the scenario as given, overrides included
  std::string file;
  std::uint64_t rows = 0;
  std::vector<std::pair<MeasuredQuantity, std::uint64_t>> quantities;  ///< and how many values of each
  RunStatus status = RunStatus::completed;                             ///< of the scenario's own prediction
  double reached_s = 0;                                                ///< time of the last predicted row
  std::optional<Verdict> verdict;                                      ///< of a run to the last row; none where it ended early
  ChiSquared as_given;  ///< of the scenario's own numbers, none of them fitted; of the rows that were reached
  FitOutcome fit = FitOutcome::not_asked;
  std::string fit_reason;            ///< why not converged; empty where it did, or was not asked for
  int iterations = 0;                ///< of the fit
  std::int64_t predictions = 0;      ///< motions computed
  std::optional<ChiSquared> fitted;  ///< of a fit that converged
  std::vector<ParameterEstimate> estimates;
  std::vector<std::vector<double>> correlation;  ///< of the estimates' errors; empty where there are none
  std::vector<MeasurementResidual> residuals;    ///< of the fitted numbers where the fit converged, else of the scenario's
  std::optional<std::size_t> largest;            ///< the residual of largest normalised size
  std::vector<std::string> notes;

  /// Whether measurement and scenario agree: the prediction reached the last row, a fit that was asked for converged, and the
  /// scatter that is left has a chance of at least kLeastPValue. Without degrees of freedom nothing contradicts.
  bool agrees() const;
};

/// Holds a measurement against a scenario.
/// @param overrides  `--set` pairs
/// @param estimates  at most 8 names of numbers to be fitted by weighted least squares, starting at the scenario's:
///   - a JSON pointer of a number of site, earth, body, release, platform or effects, changed as --set would;
///   - latitude_deg, gravity_m_s2, spin_rad_s, tilt_deg, rotation_rate_rad_s: the pointers of these inputs; where the scenario
///     gives no gravity, the latitude takes that of the ellipsoid along;
///   - omega_sin_latitude_rad_s: the vertical component of the Earth's rate, while its northward component and apparent
///     gravity stay as they are; effects that look at the latitude themselves, a tide or a gravity gradient, see it changed.
/// Errors of measured values are taken for normal and independent of each other. The least sum of squares is looked for from
/// the start on; azimuths that are a turn off may have several.
/// @throws ScenarioError for a scenario, a name or a row that cannot be compared, rows among them that are later than the time
/// until which a run of the scenario is reliable, where it is unstable or chaotic. Numerical trouble is the report's `status`.
/// @param watch  may end it early: then status or fit is `interrupted`
/// ArithmeticError as `run` does. While it runs, GSL's error handler, which is one for the process, is off.
MeasurementReport compare_with_measurement(const ScenarioSource& source,
                                           const std::vector<std::pair<std::string, std::string>>& overrides,
                                           const Measurement& measurement, const std::vector<std::string>& estimates,
                                           const Watch& watch = {});

/// The report as one JSON document, "earthtop-measurement-1.json"; what is not finite is null.
std::string measurement_json(const MeasurementReport& report);

}  // namespace earthtop
