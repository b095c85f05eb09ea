// SPDX-License-Identifier: GPL-3.0-or-later
// Estimates from 1,000 simulated measurements scatter as planned, within 8 %: 3.6 times the 2.2 % by which the standard deviation of
// 1,000 normal numbers scatters itself. Their mean is within 0.1 planned errors of the truth, 3.2 times its own standard error.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "plan/scatter.hpp"

namespace earthtop::testing {
namespace {

TEST(PlanScatter, ThousandEstimatesScatterAsPlanned) {
  for (const ScatterCase& what : scatter_cases()) {
    const Scatter scatter = scatter_of(what, 1000);
    for (std::size_t j = 0; j < scatter.names.size(); ++j) {
      const std::string name = what.name + ' ' + scatter.names[j];
      fmt::print("{}: scatter {:.4f} of the planned one, mean {:+.4f} planned errors\n", name, scatter.over_prediction[j],
                 scatter.mean_pull[j]);
      EXPECT_NEAR(scatter.over_prediction[j], 1, 0.08) << name;
      EXPECT_NEAR(scatter.mean_pull[j], 0, 0.1) << name;
    }
  }
}

}  // namespace
}  // namespace earthtop::testing
