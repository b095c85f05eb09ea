// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/arithmetic.hpp"

#include <gtest/gtest.h>

#include <cfenv>
#include <limits>

#include "earthtop/run.hpp"
#include "earthtop/run_batch.hpp"
#include "support/scenes.hpp"
#if defined(__SSE2__)
#include <fpu_control.h>
#include <xmmintrin.h>
#endif

namespace earthtop {
namespace {

TEST(Arithmetic, IsIeeeInThisBuild) { EXPECT_EQ(arithmetic_faults(), ""); }

/// In an environment that `change` makes, `fault` alone is found, and a run and a batch are refused in its words.
template <class Change>
void expect_found(const char* fault, const Change& change) {
  const Scene scene(testing::toy_top());
  std::fenv_t before;
  std::fegetenv(&before);
  change();
  const std::string faults = arithmetic_faults();
  std::string alone, batch;
  try {
    run(scene);
  } catch (const ArithmeticError& error) {
    alone = error.what();
  }
  try {
    run_batch(std::span(&scene, 1));
  } catch (const ArithmeticError& error) {
    batch = error.what();
  }
  std::fesetenv(&before);
  EXPECT_EQ(faults, fault);
  EXPECT_EQ(alone, "the arithmetic is not that of IEEE 754 by default: " + faults +
                       "; build without -ffast-math and -ffp-contract, and let nothing in the process change the rounding "
                       "mode, the precision of long double, the treatment of subnormal numbers, or what is trapped");
  EXPECT_EQ(batch, alone);
}

TEST(Arithmetic, OtherRoundingIsFound) {
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO})
    expect_found("numbers are not rounded to nearest", [&] { std::fesetround(mode); });
}

#if defined(__GLIBC__) && (defined(__x86_64__) || defined(__i386__))
TEST(Arithmetic, TrapsAreFound) {
  for (const int traps : {FE_DIVBYZERO, FE_INVALID, FE_OVERFLOW, FE_UNDERFLOW, FE_INEXACT, FE_ALL_EXCEPT})
    expect_found("floating-point exceptions are trapped", [&] { feenableexcept(traps); });
}
#endif

#if defined(__SSE2__)
TEST(Arithmetic, StatesOfOneUnitAreFound) {
  const auto set = [](unsigned bits) { return [bits] { _mm_setcsr(_mm_getcsr() | bits); }; };
  for (const unsigned bits : {0x8000U, 0x0040U, 0x8040U})  // flush to zero, denormals are zero
    expect_found("subnormal numbers are flushed to zero", set(bits));
  for (const unsigned mode : {_MM_ROUND_DOWN, _MM_ROUND_UP, _MM_ROUND_TOWARD_ZERO})
    expect_found("numbers are not rounded to nearest", set(mode));
  for (const unsigned exception : {_MM_MASK_INVALID, _MM_MASK_DIV_ZERO, _MM_MASK_OVERFLOW, _MM_MASK_INEXACT})
    expect_found("floating-point exceptions are trapped", [&] { _mm_setcsr(_mm_getcsr() & ~exception); });
  const auto control = [](int without, int with) {
    return [without, with] {
      fpu_control_t word;
      _FPU_GETCW(word);
      word = static_cast<fpu_control_t>((word & ~without) | with);
      _FPU_SETCW(word);
    };
  };
  for (const int digits : {_FPU_DOUBLE, _FPU_SINGLE})
    expect_found("long double is rounded to fewer digits than it has", control(_FPU_EXTENDED, digits));
  for (const int mode : {_FPU_RC_DOWN, _FPU_RC_UP, _FPU_RC_ZERO})
    expect_found("numbers are not rounded to nearest", control(0, mode));
  expect_found("floating-point exceptions are trapped", control(_FPU_MASK_ZM, 0));
}
#endif

TEST(Arithmetic, NoTrapsPutsTheEnvironmentBack) {
  std::feclearexcept(FE_ALL_EXCEPT);
  std::feraiseexcept(FE_OVERFLOW);
  std::fesetround(FE_UPWARD);
  {
    const NoTraps held;
    EXPECT_EQ(std::fetestexcept(FE_ALL_EXCEPT), 0);
    EXPECT_EQ(std::fegetround(), FE_UPWARD);
    std::feraiseexcept(FE_DIVBYZERO);
  }
  const int mode = std::fegetround(), raised = std::fetestexcept(FE_OVERFLOW | FE_DIVBYZERO);
  std::fesetround(FE_TONEAREST);
  std::feclearexcept(FE_ALL_EXCEPT);
  EXPECT_EQ(mode, FE_UPWARD);
  EXPECT_EQ(raised, FE_OVERFLOW);
}

}  // namespace
}  // namespace earthtop
