/// The integration that a run's bounds come from.
#pragma once

#include "earthtop/integrate/options.hpp"

namespace earthtop {

/// The second integration: in another observer's equations, of the same form, and by another method wherever one is affordable.
/// Two runs of one method make the same error where output times, not the tolerance, cut their steps: their distance then says
/// nothing. extrapolation, the cheapest of those that know nothing of the model, stands against all others, and rkf78 against
/// it; only in float128, where rkf78 would take ten times as long as both runs, does extrapolation stand against itself. The
/// tolerance is a hundredth, so that the distance is the error of the rows; where the digits do not allow that ten times as
/// large, so that it is more.
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
/// @param phase  of the fastest rate over the run (rad)
IntegrationOptions second_options(const IntegrationOptions& first, ModelForm form, Precision precision, double phase,
                                  bool dry_friction);

}  // namespace earthtop
