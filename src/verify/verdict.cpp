// SPDX-License-Identifier: GPL-3.0-or-later
// The run's verdict on the reliability of its own drift.
#include <fmt/core.h>

#include <algorithm>

#include "verify/judge.hpp"

namespace earthtop::verify_detail {

double verdict_error(const CriterionSpec& criterion, Runs& runs) {
  const VerdictReport& verdict = runs.run(criterion.set).verdict;
  if (to_string(verdict.verdict) != criterion.quantity)
    throw NotJudged(fmt::format("the verdict is {}: {}", to_string(verdict.verdict), verdict.reason));
  if (criterion.values.empty()) return 0;
  if (!verdict.from_s) throw NotJudged("it holds to the end of the run");
  const auto [earliest, latest] = std::minmax_element(criterion.values.begin(), criterion.values.end());
  return std::max({0.0, *earliest - *verdict.from_s, *verdict.from_s - *latest});
}

}  // namespace earthtop::verify_detail
