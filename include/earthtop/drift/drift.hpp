// SPDX-License-Identifier: GPL-3.0-or-later
/// The drift: how far the motion on the rotating Earth departs from the non-rotating prediction, measured without
/// cancellation, and its summary over a run.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "earthtop/real.hpp"

namespace earthtop {

/// One output time. Rotating is the motion on the turning Earth, `ref` the non-rotating prediction; drift is always
/// rotating minus reference. Rows of extended precision stand in float128, which holds a long double unchanged.
template <class T>
struct BasicDriftRow {
  T t_s = T(0);
  std::array<T, 4> q_LB = {T(1), T(0), T(0), T(0)};  ///< (w, x, y, z)
  std::array<T, 3> w_LB_B = {};                      ///< rad/s
  std::array<T, 4> ref_q_LB = {T(1), T(0), T(0), T(0)};
  std::array<T, 3> ref_w_LB_B = {};
  std::array<T, 3> axis_L = {T(0), T(0), T(1)};  ///< body axis 3: East, North, Up
  std::array<T, 3> ref_axis_L = {T(0), T(0), T(1)};
  T drift_axis_rad = T(0);             ///< angle between the two axes
  T drift_axis_bound_rad = T(0);       ///< bound on the error of the above
  std::optional<T> drift_azimuth_rad;  ///< difference of compass azimuths, continuous; none where an axis is vertical
  T drift_tilt_rad = T(0);
  T drift_attitude_rad = T(0);        ///< angle of R_ref^T R_rot, 0 to pi
  T drift_attitude_bound_rad = T(0);  ///< bound on the error of the above
  T drift_spin_rad = T(0);            ///< spin phase, continuous
  bool drift_reliable = true;         ///< false from the verdict's time on
};
using DriftRow = BasicDriftRow<double>;
using ExtendedDriftRow = BasicDriftRow<float128>;

/// A least-squares line through the azimuth drift of all rows, and what is left of it. The standard error takes the
/// residuals as independent, which an oscillation is not: it is the scatter of the fit, not an error of the numbers.
struct SecularDrift {
  double azimuth_rate_rad_s = 0;
  double azimuth_rate_standard_error_rad_s = 0;
  double azimuth_oscillation_rad = 0;            ///< largest distance of a row from the line
  double mean_precession_rate_change_rad_s = 0;  ///< counterclockwise about Up: minus the azimuth rate
};

/// Whether the axis drift passes a threshold, in view of the error of the drift.
enum class ThresholdCrossing {
  not_reached,
  clear,       ///< it passes, and its error moves the time by no more than is said
  tangential,  ///< it turns back so near to the threshold that within its error it passes, or does not, or another time
  uncertain    ///< the run ends too near to the threshold to tell, or the error is no smaller than the threshold
};
std::string_view to_string(ThresholdCrossing crossing);

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
  std::optional<double> axis_final_over_earth_angle;    ///< axis_final / (|Omega| t)
  std::optional<SecularDrift> secular;                  ///< none where fewer than three rows have an azimuth
  std::optional<double> threshold_time_s;               ///< when drift_axis_rad first passes the threshold asked for
  std::optional<double> threshold_time_bound_s;         ///< bound on the error of that; none but for a clear crossing
  std::optional<ThresholdCrossing> threshold_crossing;  ///< none where no threshold is asked for
};

/// Summarises the rows; the threshold is left to the integrations, which see every step.
DriftSummary summarize_drift(const std::vector<DriftRow>& rows, double rotation_rate_rad_s);

}  // namespace earthtop
