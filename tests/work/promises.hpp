// SPDX-License-Identifier: GPL-3.0-or-later
/// Whether runs take the work that was promised of them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "earthtop/scene/scene.hpp"
#include "work/work_scenes.hpp"

namespace earthtop::testing {

/// Used over promised, of all that was integrated.
inline double ratio(const WorkDone& done) {
  double promised = 0, used = 0;
  for (std::size_t i = 0; i < 3; ++i) promised += done.promised[i].evaluations, used += done.used[i].evaluations;
  // Less than a tenth of a second, of which nothing more is promised.
  constexpr double kFew = 1e5;
  return (used + kFew) / (promised + kFew);
}

/// Scenes from gentle to stiff, of every effect, method and precision: work is no more than ten times what was promised of it,
/// where a run would be stopped, and within a factor of three for four in five.
inline void expect_promises_kept(int scenes_a_kind) {
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
