// SPDX-License-Identifier: GPL-3.0-or-later
/// Comparison of a measured motion with a scenario: residuals, chi-squared, and estimates of the scenario's numbers.
///
/// The prediction is one integration in double at the measured times, good to some 1e-11 rad; that error is small against any
/// measurement's, and is not added to it. Where disturbances grow, the prediction means nothing after the time that a run's
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
#include "earthtop/measure/exact_input.hpp"
#include "earthtop/measure/rate_finding.hpp"
#include "earthtop/plot/plot.hpp"
#include "earthtop/run.hpp"
#include "earthtop/scenario/scenario.hpp"

namespace earthtop {

/// The quantities that can be measured: those of body axis 3, in the laboratory (East, North, Up): compass azimuth, clockwise from
/// North seen from above; tilt from Up; the axis itself; and the drifts of azimuth and tilt, which are the motion on the
/// rotating Earth minus the non-rotating prediction, as one gets them from a measured motion and a calculated one. The rate of a
/// rotor relative to the body, as a tachometer in the frame reads it, and the angles of gimbals. The body's spin, which is the component of
/// its rate in the laboratory along body axis 3, and its rates along body axes, in the laboratory and inertial, as a gyroscope chip has them.
/// The contact point of a top on a table. Of a pendulum the ellipse of its swing (closed_form/swing.hpp). Turning points: the extreme of an
/// angle next to the row's time. And times: in which the axis's azimuth goes round once from the row's time on, and at which it has gone
/// round a number of times since the release.
enum class MeasuredQuantity {
  azimuth,
  tilt,
  axis,
  drift_azimuth,
  drift_tilt,
  rotor_rate,
  outer_angle,
  inner_angle,
  spin,
  w_LB_B_x,
  w_LB_B_y,
  w_LB_B_z,
  w_IB_B_x,
  w_IB_B_y,
  w_IB_B_z,
  tip_L_x,
  tip_L_y,
  swing_azimuth,
  swing_major,
  swing_minor,
  azimuth_turning,
  tilt_turning,
  outer_angle_turning,
  inner_angle_turning,
  precession_period,
  passage
};
inline constexpr std::size_t kMeasuredQuantities = 26;
std::string_view to_string(MeasuredQuantity quantity);

/// Which extreme a turning point is.
enum class Extreme : std::uint8_t { either, maximum, minimum };

struct MeasuredValue {
  MeasuredQuantity quantity = MeasuredQuantity::azimuth;
  double t_s = 0;                  ///< time since the release (s)
  double value = 0;                ///< in rad, azimuths modulo 2 pi; in rad/s, m or s; not used for an axis
  std::array<double, 3> axis_L{};  ///< for an axis: unit vector in laboratory axes
  double standard_error = 0;       ///< in the same unit; for an axis (rad): of each of the two components at right angles to it
  std::uint64_t line = 0;          ///< line number in the file
  Extreme extreme = Extreme::either;  ///< of a turning point
  double turns =
      0;  ///< of a passage: how often the azimuth has gone round since the release; 0: as often as fits the time best
};

struct Measurement {
  std::string file;
  std::uint64_t rows = 0;               ///< number of data lines
  std::vector<MeasuredValue> values;    ///< in the file's order, which is that of ascending times
  std::vector<std::string> notes = {};  ///< on what was left out
};

/// What has to be said of a file besides what its header says.
struct MeasurementFormat {
  /// What the file's columns are: "Time (s)=t_s", "phi=azimuth_deg"; with a word on the sense in which it is counted: "phi=azimuth_deg:mathematical".
  /// A column that becomes `_` is left out.
  std::vector<std::string> columns = {};
  std::vector<std::string> sigmas =
      {};                    ///< standard errors of all values of a quantity, instead of a column: "azimuth_deg=0.2"
  double time_offset_s = 0;  ///< what the file's clock shows at the release; rows before it are left out
};

/// Reads a table with a header line. Columns, each with its unit in its name:
///   t_s, t_ms or t_min                             since the release, ascending; several rows may have one time. Where only passages were
///                                                  timed it may be left out
///   azimuth_rad, _deg or _arcsec                   with its standard error azimuth_se_rad, _deg or _arcsec
///   and so on for each quantity: angles in rad, deg or arcsec; rates in rad_s, rpm or deg_s; tip_L_x and _y in m or mm; times in s
///   axis_L_x, axis_L_y, axis_L_z                   unit vector, normalised here; with axis_se_*
///   extreme                                        of turning points, max or min; without it the one next in time is meant
///   passage_turns                                  of passages: how often the azimuth has gone round since the release
/// An empty cell was not measured; a measured value needs its standard error, above 0. Commas, semicolons or tabs separate the cells; where
/// no comma does, decimal signs may be commas. Lines that begin with # are comments. Columns with other names are left out, with a note;
/// those that look like a slip in a known name are refused, unless they begin with `_`. At most 200,000 rows.
/// @throws ScenarioError with what is wrong, where in the file, and what is allowed; ReadError
Measurement read_measurement(const std::string& csv_file, const MeasurementFormat& format = {});
/// The same of a text.   @param name  what it is called in messages and in the report
Measurement parse_measurement(const std::string& name, std::string csv, const MeasurementFormat& format = {});

/// One measured number and the predicted one. A measured axis gives two of these: `axis_tilt` and `axis_azimuth`. Their
/// residuals are the components of the turn from the predicted to the measured axis along growing tilt and along growing
/// azimuth (the latter a difference of azimuths times sin(tilt)), while measured and predicted are tilts and azimuths.
struct MeasurementResidual {
  double t_s = 0;
  std::uint64_t line = 0;
  std::string_view quantity;
  double measured = 0;   ///< in rad, rad/s, m or s; so are the next three
  double predicted = 0;  ///< NaN for the azimuth of a vertical axis
  double residual = 0;   ///< measured minus predicted; from -pi to pi for azimuths, half of that for a swing's plane
  double standard_error = 0;
  /// Where errors are correlated in time: what is new in the normalised residual beside those before it, in its own standard
  /// errors. These are independent of each other.
  std::optional<double> whitened = {};
  double normalised() const { return residual / standard_error; }
  /// The number whose square enters chi-squared.
  double independent() const { return whitened ? *whitened : normalised(); }
};

/// The sum of the squares of the normalised residuals, or of the whitened ones where errors are correlated, and of the priors'.
/// A prior is a datum: it counts as a degree of freedom.
struct ChiSquared {
  double value = 0;
  double of_priors = 0;  ///< the priors' share of the value
  std::int64_t degrees_of_freedom = 0;
  /// The probability of a larger value, if scenario and standard errors are right and errors are normally distributed; none
  /// without degrees of freedom.
  std::optional<double> p_value;
};

enum class FitOutcome {
  not_asked,
  converged,
  not_determined,     ///< the predicted values do not change with an input, or with a combination of them
  not_converged,      ///< no minimum of the sum of squares within the allowed iterations
  false_minimum,      ///< no minimum was found but one in which measured and predicted angles part by more than a quarter turn
  prediction_failed,  ///< no motion could be computed for numbers near the scenario's
  interrupted
};
std::string_view to_string(FitOutcome outcome);

/// How the minimum of the sum of squares was searched.
struct FitSearch {
  /// Above this chi-squared per degree of freedom a minimum may be a false one, and a start is far off.
  static constexpr double kDoubted = 10;

  std::size_t spans = 0;  ///< growing spans of the data that led to the result; 0: all rows were fitted from the start
  int attempts = 0;       ///< fits of all rows that were tried, each from another start or over other spans
  int minima = 0;         ///< those that converged
};

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
  std::optional<RateFinding> finding = {};  ///< of an estimate of the Earth's rate, with the scaled error if that is said
  std::vector<ExactInput> exact = {};       ///< inputs that were taken as exact and shift it, those that shift it most first
  std::size_t release = 0;                  ///< of several, the one whose number it is, counted from 1; 0: that of all

  /// The standard error that is said with the estimate. @param by_scatter  whether the scaled one is
  const std::optional<double>& said_error(bool by_scatter) const {
    return by_scatter && standard_error_scaled ? standard_error_scaled : standard_error;
  }
};

/// A standard error of the scenario's `uncertainty` or `instrument` block that entered the fit: the input is known beforehand to be
/// `mean`.
struct Prior {
  std::string name;   ///< one of kInputNames, or the pointer of one of kInstrument
  std::string input;  ///< the estimated input that it is about, as the user named it
  std::string unit;   ///< of the input
  double mean = 0;    ///< the scenario's value
  double standard_error = 0;
  std::optional<double> pull;  ///< the estimate minus the mean, in standard errors of the prior; none without a fit
  std::size_t release = 0;     ///< as of an estimate
};
struct UnusedPrior {
  std::string name;  ///< as of a prior
  std::string reason;
};

/// Inputs beside the estimated ones whose change would mend a bad fit, to first order in the residuals.
struct FitHint {
  struct Value {
    std::string name;  ///< as `--estimate` takes it
    std::string unit;
    double value = 0;  ///< that it would have; the scenario's numbers are the estimated ones otherwise
    double standard_error = 0;
    std::size_t release = 0;  ///< as of an estimate
  };
  std::vector<Value> values;
  double chi_squared = 0;  ///< that would be left
};

/// The motion that the residuals are taken against, at one time of a picture.
struct CurvePoint {
  double t_s = 0;
  double azimuth_rad = 0;  ///< modulo 2 pi; NaN where the axis is vertical
  double tilt_rad = 0;
  double drift_azimuth_rad = 0, drift_tilt_rad = 0;  ///< NaN unless drifts were measured
  double rotor_rate_rad_s = 0;                       ///< NaN without a rotor
  double outer_angle_rad = 0, inner_angle_rad = 0;   ///< NaN without gimbals
  std::vector<double> others =
      {};  ///< by MeasuredQuantity, of those that were measured besides, else NaN; empty where none was
};

/// The wishes of the caller of a comparison.
struct MeasurementOptions {
  /// At most 8 names of numbers to be fitted by weighted least squares, starting at the scenario's:
  ///   - a JSON pointer of a number of site, earth, body, release, platform or effects, changed as --set would;
  ///   - latitude_deg, gravity_m_s2, spin_rad_s, tilt_deg, rotation_rate_rad_s: the pointers of these inputs; where the scenario
  ///     gives no gravity, the ellipsoid's gravity changes with the latitude;
  ///   - omega_sin_latitude_rad_s: the vertical component of the Earth's rate, while its northward component and apparent
  ///     gravity stay as they are; effects that use the latitude themselves, a tide or a gravity gradient, get the changed one.
  ///   - omega_cos_latitude_rad_s: its northward component, likewise; a gyrocompass feels this one only;
  ///   - inertia_ratio: I3/I1 about the pivot, with I1 and I2 as they are; center_of_mass_m: the distance of the centre of mass
  ///     from the pivot, with the inertia about the pivot as it is.
  std::vector<std::string> estimates = {};
  /// Whether the standard errors of the scenario's `uncertainty` and `instrument` blocks enter the fit, as normal priors on the
  /// estimated inputs.
  bool priors = false;
  /// Above 0: the errors of each measured quantity are correlated in time, by exp(-dt / correlation_time_s) between errors in
  /// units of their standard errors; those of different quantities are independent of each other (s).
  double correlation_time_s = 0;
  /// Number of the report's points between the release and the last measured time, for a picture: kCurvePoints, or 0 for none. It
  /// becomes as many as resolve the fastest swings of the axis.
  std::size_t curve_points = 0;
  static constexpr std::size_t kCurvePoints = 1001;
  /// Names of numbers that have one value in all of several releases. They are estimated, whether `estimates` has them or
  /// not; each release has its own value of the others.
  std::vector<std::string> shared = {};
};

/// A fit, and whether measured and predicted values agree.
struct FitReport {
  /// Below this p-value the scatter counts as larger than the stated errors explain.
  static constexpr double kLeastPValue = 1e-3;

  ChiSquared as_given;  ///< with the scenario's own numbers, none of them fitted; over the rows that were reached
  FitOutcome fit = FitOutcome::not_asked;
  std::string fit_reason;  ///< why the fit did not converge; empty where it did, or was not asked for
  int iterations = 0;      ///< iterations of the fit over all rows that led to the result
  FitSearch search;
  std::int64_t predictions = 0;      ///< number of motions computed
  std::optional<ChiSquared> fitted;  ///< with the fitted numbers; none unless the fit converged
  std::vector<ParameterEstimate> estimates;
  std::vector<std::vector<double>> correlation;  ///< correlation matrix of the estimates' errors; empty where there are none
  std::vector<FitHint> hints;                    ///< where the fit is bad: what would mend it, the best first
  std::vector<Prior> priors;                     ///< those that entered the fit
  std::vector<UnusedPrior> unused_priors;        ///< those that were asked for and did not
  double correlation_time_s = 0;                 ///< as stated; 0: errors are independent of each other
  std::vector<std::string> notes;

  /// Whether the residuals after the fit scatter by more than the stated errors explain.
  bool scatters_more() const { return fitted && fitted->p_value && *fitted->p_value < kLeastPValue; }
  /// Whether an estimate contradicts the known rate of the Earth.
  bool contradicts_known_rate() const;

 protected:
  /// Whether a fit that was asked for converged, the residuals do not scatter more than stated, and no estimate contradicts the
  /// known rate of the Earth.
  bool fit_agrees() const;
};

struct MeasurementReport : FitReport {
  std::string scenario_name;
  std::string scenario_sha256;  ///< hash of the scenario as given, overrides included
  std::string file;
  std::uint64_t rows = 0;
  std::vector<std::pair<MeasuredQuantity, std::uint64_t>> quantities;  ///< each measured quantity with its number of values
  RunStatus status = RunStatus::completed;                             ///< of the prediction with the scenario's own numbers
  double reached_s = 0;                                                ///< time of the last predicted row
  std::optional<Verdict> verdict;                                      ///< of a run to the last row; none if it ended early
  std::vector<MeasurementResidual> residuals;  ///< with the fitted numbers if the fit converged, else with the scenario's
  std::vector<CurvePoint> curve;               ///< with the same numbers; empty if it was not asked for
  bool curve_is_mean = false;  ///< whether its points are means over some of the axis's swings, which are too many to be drawn
  std::optional<std::size_t> largest;  ///< index of the residual whose normalised size is largest

  /// Whether measurement and scenario agree: the prediction reached the last row, a fit that was asked for converged, the
  /// p-value of the residuals is at least kLeastPValue, and no estimate contradicts the known rate of the Earth. Without degrees
  /// of freedom there is no p-value to contradict.
  bool agrees() const;
};

/// A release of a top: the scenario of its motion, and what was measured of it.
struct MeasuredRelease {
  ScenarioSource source;
  std::vector<std::pair<std::string, std::string>> overrides;  ///< `--set` pairs
  Measurement measurement;
  std::vector<std::string> estimates = {};  ///< numbers that are estimated for this release besides those of all
};

/// One answer from several releases.
struct ReleasesReport : FitReport {
  /// Each release with its own residuals and its own part of chi-squared, which has no degrees of freedom of its own: those are the
  /// number of its values. Its estimates are those that its scenario has, shared ones among them, without correlations or findings.
  std::vector<MeasurementReport> releases;

  /// Whether all predictions reached their last rows, and the fit agrees, as for one release.
  bool agrees() const;
  /// That of the first release whose prediction did not reach its last row.
  RunStatus status() const;
};

/// Compares a measurement with a scenario.
/// @param overrides  `--set` pairs
/// Errors of measured values are assumed to be normally distributed and, unless a correlation time is stated, independent of
/// each other. The search for the minimum of the sum of squares begins at the scenario's numbers. Where these are far off it goes by
/// growing spans of the data, and tries other starts as long as the residuals are far above their errors.
/// @throws ScenarioError for a scenario, a name or a row that cannot be compared, rows among them that are later than the time
/// until which a run of the scenario is reliable, where it is unstable or chaotic; ArithmeticError as `run` does. Numerical
/// trouble is not an error: it is the report's `status`.
/// @param watch  may end the work early: then status or fit is `interrupted`
/// While this runs, GSL's error handler, of which the process has only one, is off.
MeasurementReport compare_with_measurement(const ScenarioSource& source,
                                           const std::vector<std::pair<std::string, std::string>>& overrides,
                                           const Measurement& measurement, const MeasurementOptions& options = {},
                                           const Watch& watch = {});

/// Compares several releases with their scenarios by one fit, in which some numbers are the same for all. One release is compared as
/// by `compare_with_measurement`.
/// @throws ScenarioError as that, and for a shared number that the scenarios do not start with the same value; at most 64 releases
ReleasesReport compare_releases(const std::vector<MeasuredRelease>& releases, const MeasurementOptions& options = {},
                                const Watch& watch = {});

/// The scenario of a measurement that begins after the release: its release is the state of the first row, whose rates are given along
/// body axes, and start at the scenario's.
/// @param overrides  `--set` pairs, which are put into the text
/// @throws ScenarioError for a scenario whose release is no attitude by tilt and azimuth, on a table or in gimbals
ScenarioSource with_free_start(const ScenarioSource& source, const std::vector<std::pair<std::string, std::string>>& overrides);
/// The names with those of the numbers that such a start estimates, the axis's attitude and the rates, behind them, each once.
std::vector<std::string> with_free_start_estimates(std::vector<std::string> names);

/// Says what the data show about an input, e.g. "the tilt at release is 12.10 ± 0.05 deg; the scenario's 12 is 2.0 sigma below
/// it". Of an estimate with a finding it says that, and which errors of other inputs would do it where it contradicts. Empty
/// without an estimate.
/// @param by_scatter  take the standard error scaled by the scatter, and say so
std::string estimate_sentence(const ParameterEstimate& estimate, bool by_scatter);

/// Says what would mend a bad fit: "/instrument/time_offset_s = 0.0036 ± 0.0001 s would leave chi-squared 1776, to first order; estimate it"
std::string hint_sentence(const FitHint& hint);

/// A paragraph for a paper: what was fitted to which data with which result, what the errors are, and on which inputs it rests most.
/// Empty where nothing was fitted, or the fit does not agree.
std::string quotation(const MeasurementReport& report);
std::string quotation(const ReleasesReport& report);

/// "5.16e-5 ± 0.30e-5": a value and its standard error, both down to the error's second digit.
std::string with_standard_error(double value, double error);

/// The measured values with their error bars, the model's curve, and the residuals in standard errors, over time. Azimuths are
/// counted on over whole turns. Of more than 600 values of a quantity those are drawn whose residuals are least and largest in
/// each of 300 spans.
Figure measurement_figure(const MeasurementReport& report);
/// How often each size of a residual occurs, in standard errors, next to what normally distributed errors would give.
Figure residuals_histogram(const MeasurementReport& report);

/// The report as one JSON document, "earthtop-measurement-1.json"; what is not finite is null.
std::string measurement_json(const MeasurementReport& report);
/// The report as one JSON document, "earthtop-releases-1.json": the fit as in "earthtop-measurement-1.json", and each release.
std::string releases_json(const ReleasesReport& report);
/// Puts the report's estimates into a scenario's text, after the overrides: compared with the same measurement it gives the
/// residuals of the fit, to the last bit. What else the text holds stays as it is, comments and layout included,
/// but for `headline` and `criteria`, which are about the scenario's own numbers.
/// @param file  where the text is to be written: files that it names are looked for in its directory
/// @throws ScenarioError where the fit did not converge, or no scenario in that place has these values
std::string fitted_scenario(const ScenarioSource& source, const std::vector<std::pair<std::string, std::string>>& overrides,
                            const MeasurementReport& report, const std::string& file);
/// Checks beforehand that a scenario with these overrides can be written to that place. @throws ScenarioError
void require_writable_scenario(const ScenarioSource& source, const std::vector<std::pair<std::string, std::string>>& overrides,
                               const std::string& file);

}  // namespace earthtop
