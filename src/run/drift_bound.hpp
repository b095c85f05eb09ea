/// The error bound of a drift: the distance to a second integration, in another observer's equations and at another
/// tolerance, grown to be safe.
#pragma once

#include <algorithm>

#include "earthtop/drift/drift_integration.hpp"

namespace earthtop {

/// Follows two integrations row by row. The bound is kSafety times the largest distance so far, plus what rounding the scene
/// itself to double precision (its inertia, its attitude) can do to the drift, which both integrations share: a relative
/// eps in a rate grows with the phase swept.
///
/// The second integration runs at ten times the tolerance of an 8th-order method whose error is proportional to it, so its
/// own error is the larger one of the two and their distance is about ten times the error of the rows; where round-off
/// decides, both have errors of like size, which kSafety covers. Distances are taken between the *vectors* of the drift in
/// laboratory axes as well as between the angles: a vector does not pass through zero by chance.
class DriftBound {
 public:
  static constexpr double kSafety = 3;
  static constexpr double kRoundOff = 2048 * 2.2e-16;
  static constexpr double kRoundOffPerRadian = 2 * 2.2e-16;

  /// @param phase  swept so far by the fastest rate of the motion (rad)
  void include(const DriftMeasures<double>& rows, const DriftMeasures<double>& second, double epsilon, double phase) {
    const double axis_vector = epsilon * norm(Vec3<double>(rows.axis_difference_L_scaled - second.axis_difference_L_scaled));
    const double turn_vector =
        2 * epsilon * norm(Vec3<double>(rows.attitude_vector_L_scaled - second.attitude_vector_L_scaled));
    axis_distance_ = std::max({axis_distance_, std::abs(rows.axis - second.axis), axis_vector});
    attitude_distance_ = std::max({attitude_distance_, std::abs(rows.attitude - second.attitude), turn_vector});
    axis_largest_ = std::max(axis_largest_, rows.axis);
    attitude_largest_ = std::max(attitude_largest_, rows.attitude);
    round_off_ = kRoundOff + kRoundOffPerRadian * phase;
  }
  double axis() const { return kSafety * axis_distance_ + round_off_ * axis_largest_; }
  /// Not below the bound of the axis, which is part of the attitude: in an unstable scene two runs can agree by chance in one.
  double attitude() const { return kSafety * std::max(attitude_distance_, axis_distance_) + round_off_ * attitude_largest_; }

 private:
  double axis_distance_ = 0, attitude_distance_ = 0, axis_largest_ = 0, attitude_largest_ = 0, round_off_ = 0;
};

}  // namespace earthtop
