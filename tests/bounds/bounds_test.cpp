// A small sample of the coverage of the bounds; the whole table is made by earthtop-bound-coverage.
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
      ++scenes, beyond += coverage.used > 1, tight += coverage.tight;
    }
  EXPECT_EQ(scenes, 66);
  EXPECT_LE(beyond, 1);
  EXPECT_GE(tight, 57);
}

}  // namespace
}  // namespace earthtop::testing
