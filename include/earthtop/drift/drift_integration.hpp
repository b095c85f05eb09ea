// SPDX-License-Identifier: GPL-3.0-or-later
/// Integrates the rotating motion, the non-rotating prediction and the deviation between them, side by side, in one
/// observer's variables, each from release to end.
#pragma once

#include <optional>
#include <vector>

#include "earthtop/drift/deviation.hpp"
#include "earthtop/drift/stop_event.hpp"
#include "earthtop/drift/threshold.hpp"
#include "earthtop/integrate/motion_integration.hpp"
#include "earthtop/watch.hpp"

namespace earthtop {

/// Everything at one instant, in the variables that all observers share; SI units.
template <class T>
struct DriftState {
  T t_s = T(0);
  Quaternion<T> q_LB;  ///< rotating motion, integrated itself
  Vec3<T> w_LB_B = Vec3<T>::Zero();
  Quaternion<T> ref_q_LB;  ///< non-rotating prediction
  Vec3<T> ref_w_LB_B = Vec3<T>::Zero();
  /// e = (e_w, epsilon e_v_scaled), the quaternion of R_ref^T R_rot, from the deviation equations.
  T e_w = T(1);
  Vec3<T> e_v_scaled = Vec3<T>::Zero();
  T epsilon = T(1);
};

/// How far the axis and the attitude have drifted, without cancellation. Angles in rad; the vectors over epsilon.
template <class T>
struct DriftMeasures {
  T axis;      ///< angle between the two axes
  T attitude;  ///< angle of R_ref^T R_rot, 0 to pi
  T tilt;      ///< tilt of the rotating axis less that of the reference
  bool azimuth_defined;
  T azimuth;                         ///< compass azimuth less that of the reference, -pi to pi; 0 where not defined
  T half_spin;                       ///< atan2(e_z, e_w), half the spin phase drift, -pi to pi
  Vec3<T> axis_difference_L_scaled;  ///< (n_rot - n_ref) / epsilon
  Vec3<T> attitude_vector_L_scaled;  ///< vector part of R_rot R_ref^T / epsilon
};
template <class T>
DriftMeasures<T> measure_drift(const DriftState<T>& state);
extern template DriftMeasures<double> measure_drift(const DriftState<double>&);
extern template DriftMeasures<long double> measure_drift(const DriftState<long double>&);
extern template DriftMeasures<float128> measure_drift(const DriftState<float128>&);

/// The two angles that can go round, each as the sine and cosine (times a positive number) whose atan2 it is: cheap enough
/// to be followed from step to step.
template <class T>
struct DriftPhases {
  T half_spin_sine, half_spin_cosine;
  bool azimuth_defined;
  T azimuth_sine, azimuth_cosine;
};
/// Reads only `ref_q_LB`, `e_w`, `e_v_scaled` and `epsilon`.
template <class T>
DriftPhases<T> drift_phases(const DriftState<T>& state);
extern template DriftPhases<double> drift_phases(const DriftState<double>&);
extern template DriftPhases<long double> drift_phases(const DriftState<long double>&);
extern template DriftPhases<float128> drift_phases(const DriftState<float128>&);

/// A state at an output time with its measures, the angles continuous since the release.
template <class T>
struct DriftSample {
  DriftState<T> state;
  DriftMeasures<T> measures;
  T spin = T(0);     ///< spin phase drift, continuous (rad)
  T azimuth = T(0);  ///< azimuth drift, continuous (rad); meaningless where `measures.azimuth_defined` is false
  // What the method itself states of its errors, for the scene as given; 0 where it states nothing (rad).
  T attitude_error = T(0);  ///< bound on that of both attitudes
  T drift_error = T(0);     ///< bound on that of the drift
};

/// Where the rotating motion of a sample comes from: integrated in its own state, or composed from the reference and the
/// deviation, which saves a third of the work (body and inertial axes; in the laboratory it is integrated in any case).
enum class RotatingMotion { integrated, composed };

template <class T>
struct DriftProblem : MotionProblem<T> {
  std::optional<double> threshold_rad;
  RotatingMotion rotating = RotatingMotion::integrated;
};

template <class T>
struct DriftTrajectory {
  RunStatus status = RunStatus::completed;
  std::vector<DriftSample<T>> samples;
  StepCounters counters;
  std::optional<double> step_s;                 ///< of a fixed-step method, as taken in the first interval
  std::vector<StopEvent> stops;                 ///< ascending in time
  std::optional<ThresholdRecord<T>> threshold;  ///< in seconds; where a threshold is asked for
  std::optional<KickSteps> kick_steps;          ///< those that long_horizon found last
};

/// @param watch  may end it early with RunStatus::interrupted.
/// @throws std::logic_error for a reduced form where the model has none or in body axes; for a method that is not built for T:
/// see `is_built`.
template <class T>
DriftTrajectory<T> integrate_drift(const DriftProblem<T>& problem, const IntegrationOptions& options, const Watch& watch = {});
extern template DriftTrajectory<double> integrate_drift(const DriftProblem<double>&, const IntegrationOptions&, const Watch&);
extern template DriftTrajectory<long double> integrate_drift(const DriftProblem<long double>&, const IntegrationOptions&,
                                                             const Watch&);
extern template DriftTrajectory<float128> integrate_drift(const DriftProblem<float128>&, const IntegrationOptions&,
                                                          const Watch&);

}  // namespace earthtop
