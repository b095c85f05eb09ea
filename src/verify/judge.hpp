// SPDX-License-Identifier: GPL-3.0-or-later
/// The kinds of criteria, one row each, with the functions that judge them. A function returns the error in the unit of the
/// criterion. @throws NotJudged, ScenarioError
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

/// Which runs a criterion takes, for the estimate of its work.
enum class RunsTaken {
  none,
  one,                 ///< of the scene so changed
  that_and_unchanged,  ///< and of the scene as it is
  all_methods,         ///< of the scene so changed, by each method that can
  its_own              ///< `order_work` says how many
};

struct Kind {
  CriterionKind kind;
  std::string_view word;  ///< as it is printed
  double (*error)(const CriterionSpec&, Runs&);
  RunsTaken takes = RunsTaken::one;
};

inline constexpr Kind kKinds[] = {
    {CriterionKind::value, "value", value_error},
    {CriterionKind::invariant, "invariant", invariant_error},
    {CriterionKind::closed_form, "closed form", closed_form_error},
    {CriterionKind::equivalence, "equivalence", equivalence_error, RunsTaken::that_and_unchanged},
    {CriterionKind::exactly_zero, "exactly zero", exactly_zero_error, RunsTaken::all_methods},
    {CriterionKind::order, "order", order_error, RunsTaken::its_own},
    {CriterionKind::verdict, "verdict", verdict_error},
    {CriterionKind::refused, "refused", refused_error, RunsTaken::none},
};

}  // namespace earthtop::verify_detail
