// SPDX-License-Identifier: GPL-3.0-or-later
/// Integrates three things side by side from the release to the end of a run, in the variables of one observer: the rotating
/// motion (on the rotating Earth), the non-rotating prediction (the reference), and the deviation between them.
#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "earthtop/drift/contact_event.hpp"
#include "earthtop/drift/contact_state.hpp"
#include "earthtop/drift/deviation.hpp"
#include "earthtop/drift/gimbal_event.hpp"
#include "earthtop/drift/gimbal_state.hpp"
#include "earthtop/drift/rotor_state.hpp"
#include "earthtop/drift/stop_event.hpp"
#include "earthtop/drift/threshold.hpp"
#include "earthtop/drift/trend.hpp"
#include "earthtop/integrate/motion_integration.hpp"
#include "earthtop/model/contact_release.hpp"
#include "earthtop/watch.hpp"

namespace earthtop {

/// Both motions and their deviation at one instant, in variables that do not depend on the observer; SI units.
template <class T>
struct DriftState {
  T t_s = T(0);
  Quaternion<T> q_LB;  ///< rotating motion
  Vec3<T> w_LB_B = Vec3<T>::Zero();
  Quaternion<T> ref_q_LB;  ///< non-rotating prediction
  Vec3<T> ref_w_LB_B = Vec3<T>::Zero();
  /// e = (e_w, epsilon e_v_scaled), the quaternion of R_ref^T R_rot, from the deviation equations.
  T e_w = T(1);
  Vec3<T> e_v_scaled = Vec3<T>::Zero();
  T epsilon = T(1);
  Vec3<T> watched_axis_B = Vec3<T>::UnitZ();  ///< the axis of which a threshold is watched: body axis 3, or a rotor's
};

/// How far the axis and the attitude have drifted, found without cancellation. Angles in rad; the vectors are divided by
/// epsilon.
template <class T>
struct DriftMeasures {
  T axis;      ///< angle between the two axes
  T attitude;  ///< angle of R_ref^T R_rot, 0 to pi
  T tilt;      ///< angle of the rotating axis to Up minus that of the reference axis
  bool azimuth_defined;
  T azimuth;                         ///< compass azimuth minus that of the reference, -pi to pi; 0 where it is not defined
  T half_spin;                       ///< atan2(e_z, e_w), half the spin phase drift, -pi to pi
  Vec3<T> axis_difference_L_scaled;  ///< (n_rot - n_ref) / epsilon
  Vec3<T> attitude_vector_L_scaled;  ///< vector part of R_rot R_ref^T / epsilon
};
/// The part of a drift that is sought: everything that a row shows, or only what an error bound compares, which are the angles `axis` and
/// `attitude` and both vectors. The other measures are then 0, and no azimuth is defined.
enum class DriftSought { rows, distances };

template <class T>
DriftMeasures<T> measure_drift(const DriftState<T>& state, DriftSought sought = DriftSought::rows);
extern template DriftMeasures<double> measure_drift(const DriftState<double>&, DriftSought);
extern template DriftMeasures<float80> measure_drift(const DriftState<float80>&, DriftSought);
extern template DriftMeasures<float128> measure_drift(const DriftState<float128>&, DriftSought);

/// The drift of any body axis (a unit vector), and that of the axis watched.
template <class T>
AxisDrift<T> drift_of_axis(const DriftState<T>& state, const Vec3<T>& axis_B);
template <class T>
AxisDrift<T> watched_drift(const DriftState<T>& state) {
  if (state.watched_axis_B != Vec3<T>(Vec3<T>::UnitZ())) return drift_of_axis(state, state.watched_axis_B);
  const DriftMeasures<T> measures = measure_drift(state, DriftSought::distances);
  return {measures.axis, measures.axis_difference_L_scaled};
}
extern template AxisDrift<double> drift_of_axis(const DriftState<double>&, const Vec3<double>&);
extern template AxisDrift<float80> drift_of_axis(const DriftState<float80>&, const Vec3<float80>&);
extern template AxisDrift<float128> drift_of_axis(const DriftState<float128>&, const Vec3<float128>&);

/// The two drift angles that can go through more than a full turn, the half spin and the azimuth. Each is given by its sine and
/// cosine, both times the same positive number: these are cheap enough to be followed from step to step.
template <class T>
struct DriftPhases {
  T half_spin_sine, half_spin_cosine;
  bool azimuth_defined;
  T azimuth_sine, azimuth_cosine;
};
/// @param state  of which only `ref_q_LB`, `e_w`, `e_v_scaled` and `epsilon` are read
template <class T>
DriftPhases<T> drift_phases(const DriftState<T>& state);
extern template DriftPhases<double> drift_phases(const DriftState<double>&);
extern template DriftPhases<float80> drift_phases(const DriftState<float80>&);
extern template DriftPhases<float128> drift_phases(const DriftState<float128>&);

/// The state at an output time and its measures. Spin and azimuth are followed since the release, and so are continuous.
template <class T>
struct DriftSample {
  DriftState<T> state;
  DriftMeasures<T> measures;
  T spin = T(0);     ///< spin phase drift, continuous (rad)
  T azimuth = T(0);  ///< azimuth drift, continuous (rad); meaningless where `measures.azimuth_defined` is false
  // Errors that the method itself states for the scene as given (rad); 0 where it states none.
  T attitude_error = T(0);  ///< bound on the error of both attitudes
  T drift_error = T(0);     ///< bound on the error of the drift
  /// The contact of a top on a table, in natural units; it is apart, as samples of other tops would be twice as large.
  std::shared_ptr<const ContactDriftState<T>> contact{};
  std::shared_ptr<const RotorState<T>> rotor{};     ///< of a gyrostat
  std::shared_ptr<const GimbalState<T>> gimbals{};  ///< of a Cardan suspension
};

/// The azimuths of a sample, for the trend.
AzimuthSample azimuth_sample(const DriftSample<double>& sample);

/// Where the rotating motion of a sample comes from: it is integrated as a state of its own, or composed from the reference and
/// the deviation, which saves a third of the work (in body and inertial axes; in laboratory axes it is always integrated).
enum class RotatingMotion { integrated, composed };

/// A table on which the top stands instead of turning about a fixed pivot.
template <class T>
struct TableProblem {
  Contact<T> contact;
  ContactRelease<T> start;
  double max_tilt_rad = HUGE_VAL;              ///< tilt from the table's normal at which the rim touches
  std::optional<double> static_coefficient{};  ///< friction over normal force above which a rolling tip would slip
};

class MotionWay;

/// A problem of which both motions and their deviation are sought.
template <class T>
struct DriftProblem : MotionProblem<T> {
  std::optional<double> threshold_rad;  ///< axis drift of which the first passing is sought (rad)
  RotatingMotion rotating = RotatingMotion::integrated;
  DriftSought sought = DriftSought::rows;  ///< with `distances` the samples' spin and azimuth are not followed
  std::optional<TableProblem<T>> table;    ///< none: a fixed pivot
  /// What integrations of a run in double remember for later looks at it; null: nothing.
  std::shared_ptr<MotionWay> way;
  /// Whether the times are looks and not rows. The integration then begins anew at stops that others have left on the way, and long_horizon
  /// goes from one look to the next by series; so the last digits at a time depend on what was looked at before.
  bool are_looks = false;

  /// The attitude at release in the laboratory; on a table that of the release is relative to the table.
  Quaternion<T> released_attitude() const { return table ? table->start.q_LH * this->release.q_LB : this->release.q_LB; }
};

/// Both motions and the drift at the output times, and how their integration ended. Ended early, it has fewer samples.
template <class T>
struct DriftTrajectory {
  RunStatus status = RunStatus::completed;
  std::vector<DriftSample<T>> samples;
  StepCounters counters;
  std::optional<double> step_s;                 ///< step of a fixed-step method in the first output interval (s)
  std::vector<StopEvent> stops;                 ///< ascending in time
  std::vector<ContactEvent> contact_events;     ///< ascending in time
  std::vector<GimbalEvent> gimbal_events;       ///< ascending in time
  std::optional<ThresholdRecord<T>> threshold;  ///< in seconds; none where no threshold is asked for
  std::optional<KickSteps> kick_steps;          ///< the steps that long_horizon found last
};

/// Integrates both motions and their deviation from the release to the last output time.
/// @param watch  may end the integration early, with RunStatus::interrupted
/// @throws std::logic_error for the reduced form in body axes or of a model that has none, and for a method that is not built
/// for T (see `is_built`) or does not suit the model.
template <class T>
DriftTrajectory<T> integrate_drift(const DriftProblem<T>& problem, const IntegrationOptions& options, const Watch& watch = {});
extern template DriftTrajectory<double> integrate_drift(const DriftProblem<double>&, const IntegrationOptions&, const Watch&);
extern template DriftTrajectory<float80> integrate_drift(const DriftProblem<float80>&, const IntegrationOptions&, const Watch&);
extern template DriftTrajectory<float128> integrate_drift(const DriftProblem<float128>&, const IntegrationOptions&,
                                                          const Watch&);

}  // namespace earthtop
