// SPDX-License-Identifier: GPL-3.0-or-later
#include "verify/judge.hpp"

namespace earthtop::verify_detail {

double refused_error(const CriterionSpec& criterion, Runs& runs) {
  try {
    runs.scene(criterion.set);
  } catch (const ScenarioError&) {
    return 0;
  }
  return 1;
}

}  // namespace earthtop::verify_detail
