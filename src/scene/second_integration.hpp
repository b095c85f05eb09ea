// SPDX-License-Identifier: GPL-3.0-or-later
/// Options of the second integration, from which a run's error bounds are computed.
#pragma once

#include <optional>

#include "earthtop/scene/scene.hpp"

namespace earthtop {

/// Returns the options of the second integration. It uses another observer's equations of the same form, and another method
/// wherever that is affordable. Two runs of one method make the same error where output times, not the tolerance, limit their
/// steps; their distance then says nothing about the error. `extrapolation`, the cheapest method that uses no knowledge of the
/// model, checks all other methods but two. It is checked by `taylor` itself, which has the least rounding and in long double a
/// fraction of the cost of any other method; where no series exists by rkf78, and in float128, where that would take ten times as
/// long as both runs, by itself.
///
/// `taylor` checks itself, in the equations of another observer. Its series have only rounding for an error, and output times do
/// not limit its steps: so the two integrations share neither steps nor rounding, and the series of the second one come from
/// other equations than those of the first. `extrapolation` has more rounding, which would be the bound: on the scenes in
/// `scenarios` and `scenarios/hard` the bounds are mostly closer with the check by `taylor`, by 1.4 to some 800 times; two of
/// unstable or chaotic motions are wider.
///
/// The tolerance is a thousandth of the first one, or the least one that the precision allows, so that the distance is the
/// error of the rows. At one tolerance the errors of two methods may differ by a factor of a hundred; at a tenth, a hundredth
/// or ten times the tolerance both errors could therefore be equal in size and sign. So it was with dry friction, where rkf78 and
/// an extrapolation at ten times its tolerance came to errors of one sign that agreed to 8 %. In double the least tolerance is 1e-13,
/// where the second integration has as much rounding error as step error.
///
/// closed_form has no error that an integration could detect: the error that it states is far smaller. What remains is the
/// effect of the scene's rounding on the motion. The same closed form of the nudged scene shows this effect at the cost of the
/// rows. The tests, not the run, show that the formula is the motion: they compare it with integrations of every kind of scene
/// that it fits.
///
/// A plain symmetric top that any method steps through for longer than a moment is checked by fourier, where that takes less than half of
/// the time: its sums have nothing in common with steps. fourier itself has no steps either. It checks itself, from the nudged scene, in other axes and on a finer grid: so the Fourier sums of the two
/// have other coefficients. The tests compare them with integrations.
///
/// With dry friction that may stop a motion both integrations use body axes, in which a motion at rest can be held.
///
/// Without one of [F]'s torques the second integration uses the laboratory's equations, by another method. Only there is the torque
/// simply absent: in the two other observers' equations it is subtracted, and where the drift without it is of second order in the
/// Earth's rate, the rounding of that difference is larger than the error of the rows by up to 1e8 times. Steps are sized for a
/// deviation of first order, so the tolerance may be the least one.
///
/// long_horizon is checked by `taylor`, which follows the nutation, where that takes less time than long_horizon itself or, if a
/// scenario names long_horizon, so little that nobody notices it: its bound is then that of a series, and what long_horizon states
/// of its own error adds nothing to it. Where `auto` has taken long_horizon for its speed the cost decides alone, without a cliff.
/// Elsewhere it checks itself, with steps that are shorter than the first ones and incommensurate with them (the observer
/// selects them), so that they excite a different nutation; finding the steps by trial again would give the first steps.
/// @param first  the options of the run's first integration
IntegrationOptions second_options(const Scene& scene, const IntegrationOptions& first);

/// Returns the options with which a second integration is tried again where no step was short enough; none if that is no use. The
/// torque of dry friction jumps where a pendulum turns round, and no step passes a jump at the least tolerances. At a hundred times
/// the first tolerance the error of the second integration is the larger one by far.
std::optional<IntegrationOptions> looser_second_options(const Scene& scene, const IntegrationOptions& first,
                                                        const IntegrationOptions& failed);

}  // namespace earthtop
