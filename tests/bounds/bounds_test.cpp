// SPDX-License-Identifier: GPL-3.0-or-later
// Small samples of the coverage of the error bounds; earthtop-bound-coverage makes the complete tables.
#include <gtest/gtest.h>

#include "bounds/coverage.hpp"
#include "bounds/strata.hpp"

namespace earthtop::testing {
namespace {

TEST(Bounds, HoldOverASampleOfAllStrata) {
  int scenes = 0, beyond = 0, tight = 0;
  for (const Stratum& stratum : strata())
    for (std::uint64_t i = 1000; i < 1003; ++i) {
      const bool long_run = stratum.name == "long horizon";
      const Scenario scenario = random_scene_of(stratum, i, long_run ? 1e4 : 3, long_run ? 3e4 : 200);
      SCOPED_TRACE(std::string(stratum.name) + ", " + scenario.name);
      const Coverage coverage = bound_coverage(scenario);
      if (coverage.verdict.verdict == Verdict::reliable) {
        EXPECT_LE(coverage.used, 1);
      }
      EXPECT_LE(coverage.used, 3);
      ++scenes, beyond += coverage.used > 1, tight += coverage.tight();
    }
  EXPECT_EQ(scenes, 72);
  EXPECT_LE(beyond, 1);
  EXPECT_GE(tight, 62);
}

/// If the rows and the second integration err in the same direction and by nearly as much, their distance says little about
/// either error. For methods that a user names, this happens by chance; so 8 scenes of each stratum are tried, with every
/// method among them.
TEST(Bounds, HoldOverASampleOfMethodsNamedByHand) {
  std::array<int, kMethodCount> scenes_of{};
  int tight = 0, scenes = 0;
  for (const Stratum& stratum : strata())
    for (std::uint64_t i = 2000; i < 2008; ++i) {
      const Scenario scenario = random_scene_by_hand(stratum, i, 3, 500);
      SCOPED_TRACE(std::string(stratum.name) + ", " + scenario.name + ": " + canonical_json(scenario));
      const Coverage coverage = bound_coverage(scenario, Truth::bits64);
      EXPECT_LE(coverage.used, coverage.verdict.verdict == Verdict::reliable ? 1 : 3);
      ++scenes, tight += coverage.tight();
      ++scenes_of.at(static_cast<std::size_t>(coverage.method));
    }
  EXPECT_GE(tight, scenes * 9 / 10);
  for (const MethodRow& row : kMethodRows)
    EXPECT_GE(scenes_of.at(static_cast<std::size_t>(row.method)), row.method == Method::automatic ? 0 : 2) << row.word;
}

/// Cases in which the method errs in the same direction as a second integration with a looser tolerance would; in three of them
/// the error was then above its bound. In the first one both erred by some 3.5e-10 rad and were only 3.5e-11 rad apart.
TEST(Bounds, HoldWhereALooserSecondIntegrationErrsAlike) {
  Scenario cusped = parse_scenario(read_scenario_source(EARTHTOP_SCENARIOS "/cusped-top.json"));
  cusped.numerics.method = Method::rkf78;
  const auto by_hand = [](std::size_t stratum, std::uint64_t index) {
    return random_scene_by_hand(strata()[stratum], index, 3, 1500);
  };
  for (const Scenario& scenario : {cusped, by_hand(12, 17), by_hand(23, 14)}) {
    SCOPED_TRACE(canonical_json(scenario));
    const Coverage coverage = bound_coverage(scenario, Truth::bits64);
    EXPECT_LE(coverage.used, 0.3);  // the second one's error is at most a third of the rows', the multiple ten
    EXPECT_GE(coverage.states.error, 0.01 * coverage.states.bound);
  }
}

}  // namespace
}  // namespace earthtop::testing
