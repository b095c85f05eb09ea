// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/measured_start.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "measure/measured_motion.hpp"

namespace earthtop::measure {
namespace {

/// The mean rate of an angle that is counted on over whole turns (rad/s); none for few values, or where rows are too far apart to count.
/// @param least_rad  the angle through which it turns at least
std::optional<double> mean_rate(const std::vector<MeasurementResidual>& residuals, double MeasurementResidual::*angle,
                                double least_rad) {
  constexpr double kCounted = 0.8 * std::numbers::pi;  // from one row to the next: more may be less, the other way round
  constexpr std::size_t kFewest = 8;
  double t = 0, a = 0, tt = 0, ta = 0, turned = 0, before = 0;
  std::size_t count = 0;
  double first_s = 0;
  for (const MeasurementResidual& residual : residuals) {
    if ((residual.quantity != "azimuth" && residual.quantity != "axis_azimuth") || std::isnan(residual.*angle)) continue;
    if (count == 0) first_s = residual.t_s;
    const double step = count == 0 ? 0 : std::remainder(residual.*angle - before, kWholeTurn);
    if (std::abs(step) > kCounted) return std::nullopt;
    before = residual.*angle;
    turned += step;
    const double at = residual.t_s - first_s;
    t += at, a += turned, tt += at * at, ta += at * turned;
    ++count;
  }
  const auto n = static_cast<double>(count);
  if (count < kFewest || std::abs(turned) < least_rad || !(n * tt > t * t)) return std::nullopt;
  return (n * ta - t * a) / (n * tt - t * t);
}

bool is_spin(const EstimatedInput& input) {
  return input.pointer == "/release/spin_rad_s" || input.pointer == "/release/spin_rpm" ||
         input.pointer == "/release/angular_velocity_body_rad_s/2";
}

}  // namespace

std::vector<double> start_by_precession(const JointInputs& inputs, const std::vector<VariedRelease>& releases) {
  constexpr double kAlike = 0.02, kMost = 10;  // of rates, and their ratio: beyond it the motion is no slow precession
  std::vector<double> start;
  for (const JointInput& input : inputs.list()) start.push_back(input.start);
  for (std::size_t r = 0; r < releases.size(); ++r) {
    const auto measured = mean_rate(releases[r].residuals, &MeasurementResidual::measured, std::numbers::pi);
    const auto predicted = mean_rate(releases[r].residuals, &MeasurementResidual::predicted, 0);
    if (!measured || !predicted) continue;
    const double ratio = *predicted / *measured;
    if (std::abs(ratio - 1) < kAlike || !(std::abs(ratio) < kMost) || !(std::abs(ratio) > 1 / kMost)) continue;
    for (const std::size_t place : inputs.places(r))
      if (is_spin(inputs.list()[place]) && place < inputs.fitted() && inputs.list()[place].start == start[place])
        start[place] *= ratio;
  }
  return start;
}

}  // namespace earthtop::measure
