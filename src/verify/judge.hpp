// SPDX-License-Identifier: GPL-3.0-or-later
/// One function for each kind of criterion. It returns the error, in the unit of the criterion.   @throws NotJudged,
/// ScenarioError
#pragma once

#include "verify/runs.hpp"

namespace earthtop::verify_detail {

double value_error(const CriterionSpec& criterion, Runs& runs);
double invariant_error(const CriterionSpec& criterion, Runs& runs);
double closed_form_error(const CriterionSpec& criterion, Runs& runs);
double equivalence_error(const CriterionSpec& criterion, Runs& runs);
/// The number of values that are not exactly 0.
double exactly_zero_error(const CriterionSpec& criterion, Runs& runs);
double order_error(const CriterionSpec& criterion, Runs& runs);
/// Its cost, in the seconds of `estimated_seconds`.
double order_work(const CriterionSpec& criterion, const Runs& runs);
/// How far the time from which the verdict holds lies outside the allowed range (s); 0 inside.
double verdict_error(const CriterionSpec& criterion, Runs& runs);
/// 0 if the scene is refused, else 1.
double refused_error(const CriterionSpec& criterion, Runs& runs);

}  // namespace earthtop::verify_detail
