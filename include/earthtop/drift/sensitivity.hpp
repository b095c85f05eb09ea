// SPDX-License-Identifier: GPL-3.0-or-later
/// How the drift changes with the inputs: its derivatives, from the variational equations of the reference motion and of the
/// deviation, both differentiated exactly (jets) and integrated beside them.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "earthtop/integrate/motion_integration.hpp"
#include "earthtop/watch.hpp"

namespace earthtop {

/// What the equations read of one input: derivatives of model and release by it, in the model's natural units; and torques of
/// which the input is the strength, 0 in the motion itself.
struct ProblemDerivative {
  Mat3<double> I_BP_B = Mat3<double>::Zero(), I_BP_B_inverse = Mat3<double>::Zero(), S_BP_B = Mat3<double>::Zero();
  Vec3<double> mass_moment_B = Vec3<double>::Zero(), apparent_gravity_L = Vec3<double>::Zero();
  Vec3<double> W_IL_L_scaled = Vec3<double>::Zero();  ///< of the Earth's rate over the model's own, unchanged epsilon
  Quaternion<double> q_LB{0, Vec3<double>::Zero()};
  Vec3<double> w_XB_B = Vec3<double>::Zero();
  double coriolis = 0, centrifugal = 0;  ///< of the torques' weights
  double release = 0;                    ///< of the part of the deviation's rate that the release gives it
  AppliedTorques<double> applied;
  TideSeries<double> tide;
};

/// A number and its derivatives by the inputs.
struct Differentiated {
  double value = 0;
  std::vector<double> derivatives;
};

/// Inputs followed at once: with more the motion is repeated less often, and each step costs more.
inline constexpr std::size_t kInputsAtOnce = 4;

/// How two directions move with one input, by the length of the change, per unit of it (rad).
struct Responses {
  double displacement_final = 0, displacement_largest = 0;  ///< of the reference's axis
  double drift_final = 0, drift_largest = 0;                ///< of the rotating axis less that of the reference
};

/// The drift at one time, by all inputs (rad).
struct DriftSensitivity {
  RunStatus status = RunStatus::completed;
  Differentiated axis, attitude, tilt;
  std::optional<Differentiated> azimuth;  ///< none where an axis is vertical
  std::vector<Responses> responses;
  StepCounters counters;
};

/// What a step of both motions looks like from outside: time (natural units), the reference, and the rotating motion.
struct FollowedStep {
  double t;
  Quaternion<double> ref_q_LB;
  Vec3<double> ref_w_LB_B;
  Quaternion<double> q_LB;
  Vec3<double> w_LB_B;
};

/// Integrates in body axes, for any scene. The derivatives' errors are held to `relative_tolerance` of their own size, or of a
/// thousandth of a radian and of the unit of rate: inputs are best measured in units that give derivatives of order 1.
/// @param inputs  of the model and release of `problem`, any number: they are followed four at a time   @param time_s  after
/// the release
/// @param on_step  sees the release and every step; may be null
DriftSensitivity drift_sensitivity(const MotionProblem<double>& problem, const std::vector<ProblemDerivative>& inputs,
                                   double time_s, double relative_tolerance, const Watch& watch = {},
                                   const std::function<void(const FollowedStep&)>& on_step = nullptr);

}  // namespace earthtop
