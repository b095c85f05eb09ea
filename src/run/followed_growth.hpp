// SPDX-License-Identifier: GPL-3.0-or-later
/// How disturbances have grown along the motions of a run, as a verdict needs it, whatever supports the top.
#pragma once

#include <cmath>
#include <optional>

#include "earthtop/run.hpp"

namespace earthtop {

/// The growth of disturbances along both motions, combined.
struct FollowedGrowth {
  std::optional<double> exponential_s;  ///< when it was first a hundred times faster than the angle swept (s)
  /// When rounding has grown to an angle that takes digits which a drift needs, and from when it has fallen below that (s).
  std::optional<double> round_off_s, round_off_until_s;
  std::optional<double> critical_spin_s, late_exponent_1_s;
  double mean_exponent_1_s = 0;
  double departure = 0;
  bool completed = true;
  double followed_s = HUGE_VAL;  ///< time to which the motions were followed (s)
};

/// What the growth of disturbances says about a run.
struct GrowthFound {
  std::optional<VerdictReport> settled{};  ///< the verdict, where no growth had to be followed
  FollowedGrowth growth{};
  bool is_integrable = false;
  /// Whether the verdict tells when the drift has grown to an angle at which growth is no longer linear.
  bool tells_of_drift = false;
  /// Whether friction takes energy: neighbouring motions then come together wherever nothing drives them apart.
  bool contracts = false;
};

}  // namespace earthtop
