// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/arithmetic.hpp"

#include <gtest/gtest.h>

#include <cfenv>
#include <limits>

#include "earthtop/run.hpp"
#include "support/scenes.hpp"
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace earthtop {
namespace {

TEST(Arithmetic, IsIeeeInThisBuild) { EXPECT_EQ(arithmetic_faults(), ""); }

TEST(Arithmetic, OtherRoundingIsFoundAndARunRefused) {
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    std::fesetround(mode);
    const std::string faults = arithmetic_faults();
    bool refused = false;
    try {
      run(testing::toy_top());
    } catch (const ArithmeticError&) {
      refused = true;
    }
    std::fesetround(FE_TONEAREST);
    EXPECT_NE(faults.find("not rounded to nearest"), std::string::npos);
    EXPECT_TRUE(refused);
  }
}

#if defined(__SSE2__)
TEST(Arithmetic, FlushingSubnormalsIsFound) {
  const unsigned before = _mm_getcsr();
  for (const unsigned bits : {0x8000U, 0x0040U, 0x8040U}) {  // flush to zero, denormals are zero
    _mm_setcsr(before | bits);
    const std::string faults = arithmetic_faults();
    _mm_setcsr(before);
    EXPECT_NE(faults.find("flushed to zero"), std::string::npos) << bits;
  }
}
#endif

}  // namespace
}  // namespace earthtop
