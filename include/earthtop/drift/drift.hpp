// SPDX-License-Identifier: GPL-3.0-or-later
/// The drift, which is how far the motion on the rotating Earth departs from the non-rotating prediction, measured without
/// cancellation; and its summary over a run.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "earthtop/real.hpp"

namespace earthtop {

/// How the tip touches the table: it slides or rolls in both predictions, or one of them slides and the other rolls.
enum class ContactState { slide, roll, mixed };
std::string_view to_string(ContactState state);

/// The part of a row of a top on a table besides attitudes and rates. The tip is the contact point; positions are horizontal,
/// from the laboratory's origin, to East and North (on a tilted table along its axes 1 and 2).
template <class T>
struct BasicContactRow {
  std::array<T, 2> tip_m = {}, ref_tip_m = {};
  T slip_m_s = T(0), ref_slip_m_s = T(0);
  T normal_force_N = T(0), ref_normal_force_N = T(0);
  std::array<T, 2> drift_tip_xy_m = {};  ///< rotating minus reference
  T drift_tip_m = T(0);                  ///< its length
  T drift_tip_bound_m = T(0);            ///< bound on the error of `drift_tip_m`
  T drift_slip_m_s = T(0);
  T drift_spin_rate_rad_s = T(0);  ///< difference of the inertial rates about axis 3
  ContactState state = ContactState::slide;
};

/// The part of a row of a gyrostat (model/rotor.hpp). Rate and angle are those of the rotor relative to the body, the angle since the
/// release; its axis is in East, North, Up.
template <class T>
struct BasicRotorRow {
  T rate_rad_s = T(0), angle_rad = T(0);
  std::array<T, 3> axis_L = {};
  T ref_rate_rad_s = T(0), ref_angle_rad = T(0);
  std::array<T, 3> ref_axis_L = {};
  T drift_rate_rad_s = T(0), drift_angle_rad = T(0);              ///< rotating minus reference
  T drift_axis_rad = T(0);                                        ///< angle between the rotor's two axes
  T drift_axis_bound_rad = T(0);                                  ///< bound on the error of `drift_axis_rad`
  T drift_rate_bound_rad_s = T(0), drift_angle_bound_rad = T(0);  ///< the same of the other two
};

/// What of the drift of a Cardan suspension is judged: an axis, the rotor's or body axis 3, or the angle of the only gimbal that is free
/// where there is no rotor.
enum class GimbalHeadline { axis, outer, inner };

/// The part of a row of a Cardan suspension (model/gimbals.hpp): both angles and their rates.
template <class T>
struct BasicGimbalRow {
  T outer_angle_rad = T(0), inner_angle_rad = T(0);
  T outer_rate_rad_s = T(0), inner_rate_rad_s = T(0);
  T ref_outer_angle_rad = T(0), ref_inner_angle_rad = T(0);
  T ref_outer_rate_rad_s = T(0), ref_inner_rate_rad_s = T(0);
  T drift_outer_angle_rad = T(0), drift_inner_angle_rad = T(0);  ///< rotating minus reference
  T drift_outer_rate_rad_s = T(0), drift_inner_rate_rad_s = T(0);
  T drift_outer_angle_bound_rad = T(0), drift_inner_angle_bound_rad = T(0);
  GimbalHeadline headline = GimbalHeadline::axis;
};

/// The part of a row of a laboratory on a journey: where it is, and how it moves over the Earth.
template <class T>
struct BasicJourneyRow {
  T latitude_deg = T(0), longitude_deg = T(0), height_m = T(0);
  T course_deg = T(0);                 ///< compass course, 0 to 360
  T speed_m_s = T(0);                  ///< horizontal
  std::array<T, 3> w_IL_L_rad_s = {};  ///< rate of the laboratory in space
  std::array<T, 3> G_L_m_s2 = {};      ///< it takes the place of apparent gravity at the pivot
};

/// Both motions and the drift at one output time. `ref` marks the non-rotating prediction; attitude, rate and axis without it
/// belong to the motion on the rotating Earth. A drift is always rotating minus reference. Rows of extended precision are kept
/// in float128, which holds a float80 unchanged.
template <class T>
struct BasicDriftRow {
  T t_s = T(0);
  std::array<T, 4> q_LB = {T(1), T(0), T(0), T(0)};  ///< (w, x, y, z)
  std::array<T, 3> w_LB_B = {};                      ///< rad/s
  std::array<T, 4> ref_q_LB = {T(1), T(0), T(0), T(0)};
  std::array<T, 3> ref_w_LB_B = {};
  std::array<T, 3> axis_L = {T(0), T(0), T(1)};  ///< body axis 3 in East, North, Up
  std::array<T, 3> ref_axis_L = {T(0), T(0), T(1)};
  T drift_axis_rad = T(0);                      ///< angle between the two axes
  T drift_axis_bound_rad = T(0);                ///< bound on the error of `drift_axis_rad`
  std::optional<T> drift_azimuth_rad;           ///< difference of compass azimuths, continuous; none where an axis is vertical
  T drift_tilt_rad = T(0);                      ///< difference of the axes' angles to the vertical
  T drift_attitude_rad = T(0);                  ///< angle of R_ref^T R_rot, 0 to pi
  T drift_attitude_bound_rad = T(0);            ///< bound on the error of `drift_attitude_rad`
  T drift_spin_rad = T(0);                      ///< difference of the spin phases, continuous
  bool drift_reliable = true;                   ///< false from the time at which the run's verdict calls the drift unreliable
  std::optional<BasicContactRow<T>> contact;    ///< of a top on a table
  std::optional<BasicRotorRow<T>> rotor;        ///< of a gyrostat
  std::optional<BasicGimbalRow<T>> gimbals;     ///< in the rows of a Cardan suspension
  std::optional<BasicJourneyRow<T>> journey{};  ///< of a laboratory that travels
};
using DriftRow = BasicDriftRow<double>;
using ExtendedDriftRow = BasicDriftRow<float128>;

/// The sine of the angle between the vertical and the axis that is nearer to it: an error of an axis divided by it is one of its azimuth.
double horizontal(const DriftRow& row);

/// The trend of the azimuth drift: its secular rate, apart from the swings at the frequencies of precession and nutation. It comes
/// from looks at the motions at times of its own, and so does not depend on the output times.
///
/// The rate of a top on which only gravity and the Earth's rotation act is that of all time, and the bound contains its error in
/// about 95 of 100 such tops. Where anything else acts, as friction does, the rate is the mean over the window and nothing more.
struct SecularDrift {
  std::optional<double> azimuth_rate_rad_s;           ///< none where it is not determined, for the `reason`
  std::optional<double> azimuth_rate_bound_95_rad_s;  ///< none where there is no rate
  std::optional<double> turns_seen;                   ///< of the reference's azimuth within the window
  std::array<double, 2> window_s = {};                ///< begin and end of what the rate comes from
  std::optional<double> azimuth_oscillation_rad;      ///< largest distance from the line, half of the whole swing
  bool of_window = false;                             ///< whether the rate is only the mean over the window
  std::string reason;                                 ///< why it is not determined, or why it is only a mean; else empty
  double azimuth_oscillation_bound_rad = 0;           ///< bound on the error of the swing about the line of this rate
  /// When the azimuth drift is farthest below and above the line (s).
  std::array<double, 2> azimuth_oscillation_at_s = {};
};

/// Whether the axis drift passes a threshold, given the error of the drift.
enum class ThresholdCrossing {
  not_reached,
  clear,       ///< the drift passes, and its error moves the time by no more than the bound that is given
  tangential,  ///< it turns back so near the threshold that, within its error, it may not pass, or at a quite different time
  uncertain    ///< the run ends too near the threshold to tell, or the error is no smaller than the threshold
};
std::string_view to_string(ThresholdCrossing crossing);

/// A run's drift in a few numbers. Each bound is the largest of all rows. The largest drifts are those of the motion, not of the rows,
/// with their times and with bounds of their own.
struct DriftSummary {
  double axis_final_rad = 0;
  double axis_max_rad = 0;
  double axis_bound_rad = 0;
  double attitude_final_rad = 0;
  double attitude_bound_rad = 0;
  double spin_final_rad = 0;
  std::optional<double> azimuth_final_rad;
  double tilt_final_rad = 0;
  std::optional<double> axis_final_over_earth_angle;          ///< axis_final / (|Omega| t)
  std::optional<SecularDrift> secular;                        ///< none where fewer than three rows have an azimuth
  std::optional<double> threshold_time_s;                     ///< when drift_axis_rad first passes the threshold asked for
  std::optional<double> threshold_time_bound_s;               ///< bound on that time's error; only for a clear crossing
  std::optional<ThresholdCrossing> threshold_crossing;        ///< none where no threshold is asked for
  std::optional<double> tip_final_m, tip_max_m, tip_bound_m;  ///< of a top on a table
  // Each of the largest drifts has the time at which it is reached, and the bound on its error.
  double axis_max_at_s = 0;
  double axis_max_bound_rad = 0;
  /// The largest sizes of the drift's parts; of the azimuth none where an axis is vertical all the time.
  std::optional<double> azimuth_max_rad;
  double azimuth_max_at_s = 0, azimuth_max_bound_rad = 0;
  double tilt_max_rad = 0, tilt_max_at_s = 0, tilt_max_bound_rad = 0;
  std::optional<double> tip_max_at_s, tip_max_bound_m;
  /// Of a gyrostat: the same of the rotor's axis.
  std::optional<double> rotor_axis_final_rad, rotor_axis_max_rad, rotor_axis_bound_rad;
  std::optional<double> rotor_axis_max_at_s, rotor_axis_max_bound_rad;
  /// Of a Cardan suspension: the same of its angles. The drift at the end has its sign, the largest is a size.
  struct OfAngle {
    double final_rad = 0, max_rad = 0, bound_rad = 0;
    double max_at_s = 0, max_bound_rad = 0;
  };
  std::optional<OfAngle> outer_angle, inner_angle;
  GimbalHeadline headline = GimbalHeadline::axis;
  /// The bound of the drift that is judged: of a rotor's axis, of a gimbal's angle, else of body axis 3.
  double watched_axis_bound_rad() const {
    if (headline == GimbalHeadline::outer) return outer_angle->bound_rad;
    if (headline == GimbalHeadline::inner) return inner_angle->bound_rad;
    return rotor_axis_bound_rad.value_or(axis_bound_rad);
  }
};

/// Summarises the rows. The members on the threshold and the trend stay empty: the integrations, which see every step, find
/// them. The largest drifts are those of the rows until the motion between them has been searched.
/// @param rows  of one run, in the order of time   @param rotation_rate_rad_s  of the Earth
DriftSummary summarize_drift(const std::vector<DriftRow>& rows, double rotation_rate_rad_s);

}  // namespace earthtop
