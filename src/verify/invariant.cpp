// SPDX-License-Identifier: GPL-3.0-or-later
// Quantities that the exact motion conserves: the largest change over the rows, relative to the sum of the sizes of the
// quantity's terms.
#include "run/invariant_follower.hpp"
#include "text/number_words.hpp"
#include "verify/judge.hpp"

namespace earthtop::verify_detail {
namespace {

double relative_change(const InvariantReport& invariant) {
  return share_of(invariant.largest_change, invariant.scale).value_or(invariant.largest_change);
}

}  // namespace

double invariant_error(const CriterionSpec& criterion, Runs& runs) {
  const RunResult& result = runs.run(criterion.set);
  for (const ConservedQuantity<double>& quantity : kConserved<double>)
    if (quantity.name == criterion.quantity && quantity.on_pivot != nullptr && quantity.holds_on_pivot == nullptr)
      return relative_change(followed_on_pivot(quantity, result.modelled.model<double>(), result.rows));
  for (const InvariantReport& invariant : result.invariants)
    if (invariant.name == criterion.quantity) return relative_change(invariant);
  throw NotJudged("this scenario does not conserve it");
}

}  // namespace earthtop::verify_detail
