// SPDX-License-Identifier: GPL-3.0-or-later
/// How a run finds the derivatives of its drift by the inputs, and at what cost.
#pragma once

#include <optional>
#include <string>

#include "earthtop/scene/scene.hpp"

namespace earthtop {

/// The tolerance at which a run integrates the drift's derivatives, and the one of a second integration, whose distance from the
/// first tells the error. Local errors are of the order of the tolerance, so that the second's errors are some hundredfold.
inline constexpr double kSensitivityTolerance = 1e-11, kCoarseSensitivityTolerance = 1e-9;

/// The variational equations of both motions, or differences of the drifts of scenes in which an input is changed a little.
enum class SensitivityRoute { variations, differences };

/// A route and its estimated time (s) on one core; or why there are no derivatives.
struct SensitivityPlan {
  SensitivityRoute route = SensitivityRoute::variations;
  double seconds = 0;
  std::string refusal;
};
/// Chooses the route. Variations exist without dry friction, and on a table also with it where it is regularised or does not let
/// the tip slip. They are taken where they last ten seconds at most; otherwise the cheaper route is taken.
/// @param time_s  the time at which the derivatives are wanted (s)
SensitivityPlan plan_sensitivities(const Scene& scene, double time_s);

/// Estimates the time (s) to integrate the derivatives by this number of inputs, from the release to `time_s` (s).
double variations_seconds(const Scene& scene, double time_s, double relative_tolerance, std::size_t inputs);

/// The scene whose drifts are integrated for differences: in double precision and to its default tolerance at least, with the
/// method of the given scene, and with nothing else asked for.
Scene scene_for_differences(const Scene& scene);
/// The phase (rad) through which a motion goes until `time_s`: of its slowest turning, at whose pace a drift depends on most
/// inputs, and of its fastest.
struct Phases {
  double slow, fast;
};
Phases phases_until(const Scene& scene, double time_s);

}  // namespace earthtop
