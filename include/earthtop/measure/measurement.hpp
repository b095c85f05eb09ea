// SPDX-License-Identifier: GPL-3.0-or-later
/// Comparison of a measured motion with a scenario: residuals, chi-squared, and estimates of the scenario's numbers.
///
/// The prediction is one integration in double at the measured times, good to some 1e-11 rad; that error is small against any
/// measurement's, and is not added to it. Where disturbances grow, the prediction means nothing from the time on that a run's
/// verdict names: later rows are refused.
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
  double t_s = 0;                  ///< time since the release (s)
  double angle_rad = 0;            ///< measured angle (rad); azimuths modulo 2 pi; not used for an axis
  std::array<double, 3> axis_L{};  ///< for an axis: unit vector in laboratory axes
  double standard_error_rad = 0;   ///< (rad); for an axis: of each of the two components at right angles to it
  std::uint64_t line = 0;          ///< line number in the file
};

struct Measurement {
  std::string file;
  std::uint64_t rows = 0;             ///< number of data lines
  std::vector<MeasuredValue> values;  ///< in the file's order, which is that of ascending times
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

/// One measured number and the predicted one. A measured axis gives two of these: `axis_tilt` and `axis_azimuth`. Their
/// residuals are the components of the turn from the predicted to the measured axis along growing tilt and along growing
/// azimuth (the latter a difference of azimuths times sin(tilt)), while measured and predicted are tilts and azimuths.
struct MeasurementResidual {
  double t_s = 0;
  std::uint64_t line = 0;
  std::string_view quantity;
  double measured_rad = 0;
  double predicted_rad = 0;  ///< NaN for the azimuth of a vertical axis
  double residual_rad = 0;   ///< measured less predicted; from -pi to pi for azimuths
  double standard_error_rad = 0;
  double normalised() const { return residual_rad / standard_error_rad; }
};

/// The sum of the squares of the normalised residuals.
struct ChiSquared {
  double value = 0;
  std::int64_t degrees_of_freedom = 0;
  /// Chance of a larger value, if scenario and standard errors are right and errors are normal; none without degrees of
  /// freedom.
  std::optional<double> p_value;
};

enum class FitOutcome {
  not_asked,
  converged,
  not_determined,     ///< the predicted values do not change with an input, or with a combination of them
  not_converged,      ///< no least sum of squares within the allowed iterations
  prediction_failed,  ///< no motion could be computed for numbers near the scenario's
  interrupted
};
std::string_view to_string(FitOutcome outcome);

/// One of the scenario's numbers, estimated from the measurement, in `unit`.
struct ParameterEstimate {
  std::string name;
  std::string unit;
  double start = 0;                      ///< the scenario's value
  std::optional<double> estimate;        ///< none where the fit did not converge
  std::optional<double> standard_error;  ///< from the stated standard errors
  /// The standard error multiplied by sqrt(chi-squared / degrees of freedom) where that is above 1, so that it reflects the
  /// scatter of the residuals.
  std::optional<double> standard_error_scaled;
};

struct MeasurementReport {
  /// Below this chance (p-value) the scatter is taken to be larger than the stated errors explain.
  static constexpr double kLeastPValue = 1e-3;

  std::string scenario_name;
  std::string scenario_sha256;  ///< hash of the scenario as given, overrides included
  std::string file;
  std::uint64_t rows = 0;
  std::vector<std::pair<MeasuredQuantity, std::uint64_t>> quantities;  ///< each measured quantity with its number of values
  RunStatus status = RunStatus::completed;                             ///< of the prediction with the scenario's own numbers
  double reached_s = 0;                                                ///< time of the last predicted row
  std::optional<Verdict> verdict;                                      ///< of a run to the last row; none if it ended early
  ChiSquared as_given;  ///< with the scenario's own numbers, none of them fitted; over the rows that were reached
  FitOutcome fit = FitOutcome::not_asked;
  std::string fit_reason;            ///< why the fit did not converge; empty where it did, or was not asked for
  int iterations = 0;                ///< iterations of the fit
  std::int64_t predictions = 0;      ///< number of motions computed
  std::optional<ChiSquared> fitted;  ///< with the fitted numbers; none unless the fit converged
  std::vector<ParameterEstimate> estimates;
  std::vector<std::vector<double>> correlation;  ///< correlation matrix of the estimates' errors; empty where there are none
  std::vector<MeasurementResidual> residuals;    ///< with the fitted numbers if the fit converged, else with the scenario's
  std::optional<std::size_t> largest;            ///< index of the residual whose normalised size is largest
  std::vector<std::string> notes;

  /// Whether measurement and scenario agree: the prediction reached the last row, a fit that was asked for converged, and the
  /// p-value of the residuals is at least kLeastPValue. Without degrees of freedom there is no p-value to contradict.
  bool agrees() const;
};

/// Compares a measurement with a scenario.
/// @param overrides  `--set` pairs
/// @param estimates  at most 8 names of numbers to be fitted by weighted least squares, starting at the scenario's:
///   - a JSON pointer of a number of site, earth, body, release, platform or effects, changed as --set would;
///   - latitude_deg, gravity_m_s2, spin_rad_s, tilt_deg, rotation_rate_rad_s: the pointers of these inputs; where the scenario
///     gives no gravity, the ellipsoid's gravity changes with the latitude;
///   - omega_sin_latitude_rad_s: the vertical component of the Earth's rate, while its northward component and apparent
///     gravity stay as they are; effects that use the latitude themselves, a tide or a gravity gradient, get the changed one;
///   - omega_cos_latitude_rad_s: its northward component, likewise; a gyrocompass feels this one only;
///   - inertia_ratio: I3/I1 about the pivot, with I1 and I2 as they are; center_of_mass_m: the distance of the centre of mass
///     from the pivot, with the inertia about the pivot as it is.
/// Errors of measured values are assumed to be normal and independent of each other. The search for the least sum of squares
/// begins at the scenario's numbers; where azimuths may be off by a full turn, there may be several minima.
/// @throws ScenarioError for a scenario, a name or a row that cannot be compared, rows among them that are later than the time
/// until which a run of the scenario is reliable, where it is unstable or chaotic; ArithmeticError as `run` does. Numerical
/// trouble is no error: it is the report's `status`.
/// @param watch  may end the work early: then status or fit is `interrupted`
/// While this runs, GSL's error handler, of which the process has only one, is off.
MeasurementReport compare_with_measurement(const ScenarioSource& source,
                                           const std::vector<std::pair<std::string, std::string>>& overrides,
                                           const Measurement& measurement, const std::vector<std::string>& estimates,
                                           const Watch& watch = {});

/// The report as one JSON document, "earthtop-measurement-1.json"; what is not finite is null.
std::string measurement_json(const MeasurementReport& report);

}  // namespace earthtop
