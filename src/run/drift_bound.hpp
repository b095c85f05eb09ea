/// The error bound of a drift: the distance to a second integration, in another observer's equations and at another
/// tolerance, grown to be safe.
#pragma once

#include <algorithm>

#include "earthtop/drift/drift_integration.hpp"

namespace earthtop {

/// Moves a problem by some units in the last place of its attitude, rates and moments, in no special direction: well over what
/// rounding the scene to double precision did to it, so that two runs of which one is nudged do not share that error.
inline void nudge(DriftProblem<double>& problem) {
  constexpr double kUnit = 8 * 2.2e-16;
  const Vec3<double> turn = kUnit * Vec3<double>(0.6, -0.5, 0.7);
  problem.release.q_LB = (problem.release.q_LB * Quaternion<double>{1, turn / 2}).normalized();
  Vec3<double>& w_XB_B = problem.release.w_XB_B;
  // Against the whole rate: round-off turns a spin about a principal axis away from it, however exactly it was released there.
  w_XB_B += kUnit * norm(w_XB_B) * Vec3<double>(0.6, -0.5, -0.7);
  problem.model.mass_moment_B *= 1 + kUnit;
  // Each moment its own way, the tensor and its inverse alike; but a symmetric top is one exactly.
  Model<double>& model = problem.model;
  Vec3<double> stretch(1 + kUnit, 1 - kUnit, 1 + kUnit / 2);
  if (const int axis = symmetry_axis(model.I_BP_B, model.mass_moment_B); axis >= 0)
    stretch[(axis + 1) % 3] = stretch[(axis + 2) % 3];
  model.I_BP_B_inverse = stretch.asDiagonal() * model.I_BP_B_inverse * stretch.asDiagonal();
  model.I_BP_B = stretch.cwiseInverse().asDiagonal() * model.I_BP_B * stretch.cwiseInverse().asDiagonal();
}

/// Follows two integrations row by row. The bound is kSafety times the largest distance so far, plus the round-off of the
/// measures themselves.
///
/// The second integration runs at ten times the tolerance of an 8th-order method whose error is proportional to it, so its
/// own error is the larger one of the two and their distance is about ten times the error of the rows; where round-off
/// decides, both have errors of like size, which kSafety covers. It starts from a nudged scene, so that the growth of the
/// scene's own rounding shows too. Distances are taken between the *vectors* of the drift in
/// laboratory axes as well as between the angles: a vector does not pass through zero by chance.
class DriftBound {
 public:
  static constexpr double kSafety = 3;
  static constexpr double kRoundOff = 1024 * 2.2e-16;

  void include(const DriftMeasures<double>& rows, const DriftMeasures<double>& second, double epsilon) {
    const double axis_vector = epsilon * norm(Vec3<double>(rows.axis_difference_L_scaled - second.axis_difference_L_scaled));
    const double turn_vector =
        2 * epsilon * norm(Vec3<double>(rows.attitude_vector_L_scaled - second.attitude_vector_L_scaled));
    axis_distance_ = std::max({axis_distance_, std::abs(rows.axis - second.axis), axis_vector});
    attitude_distance_ = std::max({attitude_distance_, std::abs(rows.attitude - second.attitude), turn_vector});
    axis_largest_ = std::max(axis_largest_, rows.axis);
    attitude_largest_ = std::max(attitude_largest_, rows.attitude);
  }
  double axis() const { return kSafety * axis_distance_ + kRoundOff * axis_largest_; }
  /// Not below the bound of the axis, which is part of the attitude: in an unstable scene two runs can agree by chance in one.
  double attitude() const { return kSafety * std::max(attitude_distance_, axis_distance_) + kRoundOff * attitude_largest_; }

 private:
  double axis_distance_ = 0, attitude_distance_ = 0, axis_largest_ = 0, attitude_largest_ = 0;
};

}  // namespace earthtop
