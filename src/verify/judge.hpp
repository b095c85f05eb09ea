// SPDX-License-Identifier: GPL-3.0-or-later
/// One function for each kind of criterion: the error, in the unit of the criterion. @throws NotJudged, ScenarioError
#pragma once

#include "verify/runs.hpp"

namespace earthtop::verify_detail {

double value_error(const CriterionSpec& criterion, Runs& runs);
double invariant_error(const CriterionSpec& criterion, Runs& runs);
double closed_form_error(const CriterionSpec& criterion, Runs& runs);
double equivalence_error(const CriterionSpec& criterion, Runs& runs);
/// Numbers that are not 0 in all their bits.
double exactly_zero_error(const CriterionSpec& criterion, Runs& runs);
double order_error(const CriterionSpec& criterion, Runs& runs);
/// The seconds that it takes on one core.
double order_work(const CriterionSpec& criterion, const Runs& runs);
/// How far the time from which the verdict holds is outside of the range allowed (s); 0 within.
double verdict_error(const CriterionSpec& criterion, Runs& runs);
/// 0 where the scene is refused, else 1.
double refused_error(const CriterionSpec& criterion, Runs& runs);

}  // namespace earthtop::verify_detail
