// SPDX-License-Identifier: GPL-3.0-or-later
/// The integration that a run's bounds come from.
#pragma once

#include "earthtop/scene/scene.hpp"

namespace earthtop {

/// The second integration: in another observer's equations, of the same form, and by another method wherever one is affordable.
/// Two runs of one method make the same error where output times, not the tolerance, cut their steps: their distance then says
/// nothing. extrapolation, the cheapest of those that know nothing of the model, stands against all others, and rkf78 against
/// it; only in float128, where rkf78 would take ten times as long as both runs, does extrapolation stand against itself.
///
/// The tolerance is a thousandth, or the least one that the digits allow, so that the distance is the error of the rows. Two
/// methods may differ by a factor of a hundred in the error that they make at one tolerance: at a tenth or a hundredth of it,
/// or at ten times as much, both could err alike, and to the same side. Of doubles the least one is 1e-13, where the second
/// integration errs by rounding as much as by its steps. In long double, where rkf78 at the least tolerance would cost a third
/// more than all the rest, it stands against extrapolation at ten times the tolerance; and so it does with dry friction, which
/// jumps where a motion turns round: the least steps there are short enough as it is.
///
/// closed_form has no error that an integration could see: its own statement is far below. What is left is what the rounding of
/// the scene makes of the motion, and the same closed form of the nudged scene shows that at the price of the rows. That the
/// formula is the motion, no comparison within a run has to show: the tests hold it against integrations of every scene it
/// fits.
///
/// With dry friction both are in body axes, where a motion at rest is held.
///
/// Against long_horizon no method that follows the nutation is affordable where that method is worth taking: there it stands
/// against itself in steps that are shorter and have no common measure with the first ones (the observer names them), which
/// excite other nutation; a trial would but find the first steps again. Where a run has few nutations, extrapolation.
/// @param first  the options of the run's first integration
IntegrationOptions second_options(const Scene& scene, const IntegrationOptions& first);

}  // namespace earthtop
