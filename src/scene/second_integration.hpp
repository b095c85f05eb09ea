// SPDX-License-Identifier: GPL-3.0-or-later
/// Options of the second integration, from which a run's error bounds are computed.
#pragma once

#include "earthtop/scene/scene.hpp"

namespace earthtop {

/// Returns the options of the second integration. It uses another observer's equations of the same form, and another method
/// wherever that is affordable. Two runs of one method make the same error where output times, not the tolerance, limit their
/// steps; their distance then says nothing about the error. `extrapolation`, the cheapest method that uses no knowledge of the
/// model, checks all other methods but two, and rkf78 checks `extrapolation`. Only in float128, where rkf78 would take ten times
/// as long as both runs, does `extrapolation` check itself.
///
/// `taylor` checks itself, in the equations of another observer. Its series have only rounding for an error, and output times do
/// not limit its steps: so the two integrations share neither steps nor rounding, and the series of the second one come from
/// other equations than those of the first. `extrapolation` has more rounding, which would be the bound: on the scenes in
/// `scenarios` and `scenarios/hard` the bounds are mostly closer with the check by `taylor`, by 1.4 to some 800 times; two of
/// unstable or chaotic motions are wider.
///
/// The tolerance is a thousandth of the first one, or the least one that the precision allows, so that the distance is the
/// error of the rows. At one tolerance the errors of two methods may differ by a factor of a hundred; at a tenth, a hundredth
/// or ten times the tolerance both errors could therefore be equal in size and sign. In double the least tolerance is 1e-13,
/// where the second integration has as much rounding error as step error. In long double, rkf78 at the least tolerance would
/// cost a third more than all the rest, so it checks `extrapolation` at ten times the tolerance. The same holds with dry
/// friction, whose torque jumps where a motion reverses: there the least steps are short enough already.
///
/// closed_form has no error that an integration could detect: the error that it states is far smaller. What remains is the
/// effect of the scene's rounding on the motion. The same closed form of the nudged scene shows this effect at the cost of the
/// rows. The tests, not the run, show that the formula is the motion: they compare it with integrations of every kind of scene
/// that it fits.
///
/// With dry friction both integrations use body axes, in which a motion at rest can be held; not so where `taylor` integrates,
/// which is made for tops that do not come to rest.
///
/// long_horizon is checked by `taylor`, which follows the nutation, where that takes less time than long_horizon itself.
/// Elsewhere it checks itself, with steps that are shorter than the first ones and incommensurate with them (the observer
/// selects them), so that they excite a different nutation; finding the steps by trial again would give the first steps.
/// @param first  the options of the run's first integration
IntegrationOptions second_options(const Scene& scene, const IntegrationOptions& first);

}  // namespace earthtop
