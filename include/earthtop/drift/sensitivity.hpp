/// How the drift changes with the inputs: its derivatives, from the variational equations of the reference motion and of the
/// deviation, both differentiated exactly (jets) and integrated beside them.
#pragma once

#include <array>
#include <atomic>
#include <optional>

#include "earthtop/integrate/motion_integration.hpp"

namespace earthtop {

inline constexpr std::size_t kInputs = 7;

/// What the equations read of one input: derivatives of model and release by it, in the model's natural units.
struct ProblemDerivative {
  Mat3<double> I_BP_B = Mat3<double>::Zero(), I_BP_B_inverse = Mat3<double>::Zero(), S_BP_B = Mat3<double>::Zero();
  Vec3<double> mass_moment_B = Vec3<double>::Zero(), apparent_gravity_L = Vec3<double>::Zero();
  Vec3<double> W_IL_L_scaled = Vec3<double>::Zero();  ///< of the Earth's rate over the model's own, unchanged epsilon
  Quaternion<double> q_LB{0, Vec3<double>::Zero()};
  Vec3<double> w_XB_B = Vec3<double>::Zero();
};

/// A number and its derivatives by the inputs.
struct Differentiated {
  double value = 0;
  std::array<double, kInputs> derivatives = {};
};

/// The drift at one time, by all inputs (rad).
struct DriftSensitivity {
  RunStatus status = RunStatus::completed;
  Differentiated axis, attitude, tilt;
  std::optional<Differentiated> azimuth;  ///< none where an axis is vertical
  StepCounters counters;
};

/// Integrates in body axes, for any body in a plain scene. The derivatives' errors are held to `relative_tolerance` of their
/// own size.
/// @param inputs  of the model and release of `problem`   @param time_s  after the release
/// @throws std::logic_error for a scene that is not plain
DriftSensitivity drift_sensitivity(const MotionProblem<double>& problem, const std::array<ProblemDerivative, kInputs>& inputs,
                                   double time_s, double relative_tolerance, const std::atomic<bool>* stop = nullptr);

}  // namespace earthtop
