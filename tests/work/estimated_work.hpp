// SPDX-License-Identifier: GPL-3.0-or-later
/// Checks whether runs take about the work that was estimated for them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "earthtop/scene/scene.hpp"
#include "work/work_scenes.hpp"

namespace earthtop::testing {

/// The work used divided by the work estimated, over all integrations.
inline double ratio(const WorkDone& done) {
  double promised = 0, used = 0;
  for (std::size_t i = 0; i < 3; ++i) promised += done.promised[i].evaluations, used += done.used[i].evaluations;
  // Less than a tenth of a second of work, below which the estimate need not be right.
  constexpr double kFew = 1e5;
  return (used + kFew) / (promised + kFew);
}

/// For scenes from gentle to stiff, with every effect, method and precision: the work is at most ten times the estimate, where
/// a run would be stopped, and within a factor of three in four of five scenes.
inline void expect_work_as_estimated(int scenes_a_kind) {
  std::vector<double> ratios;
  for (const WorkKind& kind : work_kinds())
    for (int i = 0; i < scenes_a_kind; ++i) {
      const Scenario scenario = work_scene(kind, static_cast<std::uint64_t>(i));
      if (Scene(scenario).method_refusal(scenario.numerics.method)) continue;
      const WorkDone done = work_done(scenario);
      if (done.status[0] != RunStatus::completed && done.status[0] != RunStatus::step_limit) continue;  // failed before its end
      ratios.push_back(ratio(done));
      EXPECT_LT(ratios.back(), 10) << kind.name << ' ' << i;
      EXPECT_GT(ratios.back(), 0.02) << kind.name << ' ' << i;
      EXPECT_NE(done.status[0], RunStatus::step_limit) << kind.name << ' ' << i;
      EXPECT_NE(done.status[1], RunStatus::step_limit) << kind.name << ' ' << i;
    }
  std::sort(ratios.begin(), ratios.end());
  const auto at = [&](double share) {
    return ratios[static_cast<std::size_t>(share * static_cast<double>(ratios.size() - 1))];
  };
  const auto near = std::count_if(ratios.begin(), ratios.end(), [](double r) { return r > 1.0 / 3 && r < 3; });
  EXPECT_GT(static_cast<double>(near), 0.8 * static_cast<double>(ratios.size()));
  ::testing::Test::RecordProperty("least_median_largest",
                                  std::to_string(at(0)) + " " + std::to_string(at(0.5)) + " " + std::to_string(at(1)));
}

}  // namespace earthtop::testing
