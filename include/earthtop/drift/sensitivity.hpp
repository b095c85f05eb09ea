// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds the derivatives of the drift with respect to inputs, such as moments of inertia or rates at release. The equations of the
/// reference motion and of the deviation are recorded and differentiated operation by operation (integrate/taylor/tangents.hpp),
/// and the derivatives are integrated alongside the two by Taylor series: a symmetric top's without its spin where nothing breaks
/// the symmetry, any other body's in body axes, or on a table in laboratory axes.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/model/converted.hpp"
#include "earthtop/watch.hpp"

namespace earthtop {

/// The derivatives by one input of the numbers that move a platform, and of the pivot's place on it.
struct PlatformDerivative {
  double rate = 0, acceleration = 0, amplitude = 0, frequency = 0, phase = 0;
  Vec3<double> pivot_offset_P = Vec3<double>::Zero();
};

/// The derivatives by one input of the numbers of a table and of the start on it; all of them 0 unless they are set. The weights
/// of [F]'s torques are among them, as a contact has its own.
struct TableDerivative {
  Contact<double> contact;
  ContactRelease<double> start;
  EARTHTOP_MEMBERS(contact, start)

  TableDerivative() {
    for_each_number([](double& number) { number = 0; }, *this);
  }
};

/// The derivatives by one input of everything that the equations read: of the model, of the release and of a table, in the
/// model's natural units. Where the input is a coefficient to which a torque is proportional, `applied` and `tide` hold that torque at
/// strength 1.
struct ProblemDerivative {
  Mat3<double> I_BP_B = Mat3<double>::Zero(), I_BP_B_inverse = Mat3<double>::Zero(), S_BP_B = Mat3<double>::Zero();
  Vec3<double> mass_moment_B = Vec3<double>::Zero(), apparent_gravity_L = Vec3<double>::Zero();
  Vec3<double> W_IL_L_scaled = Vec3<double>::Zero();  ///< of the Earth's rate, over the epsilon of the model (held fixed)
  Quaternion<double> q_LB{0, Vec3<double>::Zero()};
  Vec3<double> w_XB_B = Vec3<double>::Zero();
  double coriolis = 0, centrifugal = 0;  ///< derivatives of the weights of [F]'s torques
  double release = 0;                    ///< derivative of the share of the Earth's rate in the deviation's rate at release
  PlatformDerivative platform;
  AppliedTorques<double> applied;
  TideSeries<double> tide;
  Journey<double> journey;  ///< parts of a journey, of one kind with the problem's
  TableDerivative table;
};

/// A number and its derivatives by the inputs, in their order.
struct Differentiated {
  double value = 0;
  std::vector<double> derivatives;
};

/// The number of inputs followed at once. With more of them the motion would be repeated less often, but each step cost more.
inline constexpr std::size_t kInputsAtOnce = 4;

/// How far the two axes move with one input: the lengths of their changes per unit of the input (rad), at the end and the
/// largest of all steps.
struct Responses {
  double displacement_final = 0, displacement_largest = 0;  ///< change of the reference's axis
  double drift_final = 0, drift_largest = 0;                ///< change of the rotating axis minus that of the reference's
};

/// The drift at one time (rad) and its derivatives by all inputs (rad per unit of the input).
struct DriftSensitivity {
  RunStatus status = RunStatus::completed;
  Differentiated axis, attitude, tilt;
  std::optional<Differentiated> azimuth;  ///< none where an axis is vertical
  std::vector<Responses> responses;
  StepCounters counters;
};

/// Both motions at the end of a step, as `on_step` sees them; in natural units.
struct FollowedStep {
  double t;
  Quaternion<double> ref_q_LB;
  Vec3<double> ref_w_LB_B;
  Quaternion<double> q_LB;
  Vec3<double> w_LB_B;
};

/// What is wanted besides the derivatives at the end.
enum class SensitivitySought { nothing, responses };

/// Integrates both motions' equations and their derivatives by the inputs, for any scene on a pivot whose friction has no corner.
/// The error of a step is held to `relative_tolerance` of the size of each derivative, or of a thousandth (of a radian, or of the
/// unit of rate) where that is smaller. Inputs are therefore best measured in units that give derivatives of order 1.
/// @param inputs  any number of inputs of the problem's model, release and table; they are followed kInputsAtOnce at a time
/// @param time_s  the time after the release at which the derivatives are wanted (s)
/// @param watch  may end the integration early, with RunStatus::interrupted
/// @param on_step  sees the release and some times in every step; may be null
/// @returns the derivatives; `responses` stay empty unless they are sought. RunStatus::step_underflow where the motion comes to a
/// corner, as dry or quadratic friction has one at rest
DriftSensitivity drift_sensitivity(const MotionProblem<double>& problem, const std::vector<ProblemDerivative>& inputs,
                                   double time_s, double relative_tolerance, const Watch& watch = {},
                                   SensitivitySought sought = SensitivitySought::nothing,
                                   const std::function<void(const FollowedStep&)>& on_step = nullptr);
/// The same for a top on a table; where the problem has no table, for one on its pivot. The status is RunStatus::step_underflow
/// also where dry friction without a regularisation lets the tip slip.
DriftSensitivity drift_sensitivity(const DriftProblem<double>& problem, const std::vector<ProblemDerivative>& inputs,
                                   double time_s, double relative_tolerance, const Watch& watch = {},
                                   SensitivitySought sought = SensitivitySought::nothing,
                                   const std::function<void(const FollowedStep&)>& on_step = nullptr);

}  // namespace earthtop
