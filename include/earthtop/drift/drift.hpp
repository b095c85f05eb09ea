/// The drift: how far the motion on the rotating Earth departs from the non-rotating prediction, measured without
/// cancellation, and its summary over a run.
#pragma once

#include <array>
#include <optional>
#include <vector>

namespace earthtop {

/// One output time. Rotating is the motion on the turning Earth, `ref` the non-rotating prediction; drift is always
/// rotating minus reference.
struct DriftRow {
  double t_s = 0;
  std::array<double, 4> q_LB = {1, 0, 0, 0};  ///< (w, x, y, z)
  std::array<double, 3> w_LB_B = {};          ///< rad/s
  std::array<double, 4> ref_q_LB = {1, 0, 0, 0};
  std::array<double, 3> ref_w_LB_B = {};
  std::array<double, 3> axis_L = {0, 0, 1};  ///< body axis 3: East, North, Up
  std::array<double, 3> ref_axis_L = {0, 0, 1};
  double drift_axis_rad = 0;                ///< angle between the two axes
  double drift_axis_bound_rad = 0;          ///< bound on the error of the above
  std::optional<double> drift_azimuth_rad;  ///< difference of compass azimuths, continuous; none where an axis is vertical
  double drift_tilt_rad = 0;
  double drift_attitude_rad = 0;        ///< angle of R_ref^T R_rot, 0 to pi
  double drift_attitude_bound_rad = 0;  ///< bound on the error of the above
  double drift_spin_rad = 0;            ///< spin phase, continuous
};

/// A least-squares line through the azimuth drift of all rows, and what is left of it. The standard error takes the
/// residuals as independent, which an oscillation is not: it is the scatter of the fit, not an error of the numbers.
struct SecularDrift {
  double azimuth_rate_rad_s = 0;
  double azimuth_rate_standard_error_rad_s = 0;
  double azimuth_oscillation_rad = 0;            ///< largest distance of a row from the line
  double mean_precession_rate_change_rad_s = 0;  ///< counterclockwise about Up: minus the azimuth rate
};

/// A run's drift in a few numbers. Bounds are the largest of all rows.
struct DriftSummary {
  double axis_final_rad = 0;
  double axis_max_rad = 0;
  double axis_bound_rad = 0;
  double attitude_final_rad = 0;
  double attitude_bound_rad = 0;
  double spin_final_rad = 0;
  std::optional<double> azimuth_final_rad;
  double tilt_final_rad = 0;
  std::optional<double> axis_final_over_earth_angle;  ///< axis_final / (|Omega| t)
  std::optional<SecularDrift> secular;                ///< none where fewer than three rows have an azimuth
  std::optional<double> threshold_time_s;             ///< when drift_axis_rad first passes the threshold asked for
};

/// Summarises the rows; `threshold_time_s` is left to the integration, which sees every step.
DriftSummary summarize_drift(const std::vector<DriftRow>& rows, double rotation_rate_rad_s);

}  // namespace earthtop
