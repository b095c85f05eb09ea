// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/arithmetic.hpp"

#include <cfenv>
#include <cmath>
#include <limits>

namespace earthtop {
namespace {

/// Hides a value from the optimizer, so that the processor has to compute with it at run time.
double opaque(double x) {
  volatile double kept = x;
  return kept;
}

}  // namespace

std::string arithmetic_faults() {
  std::string faults;
  const auto expect = [&](bool sound, const char* fault) {
    if (sound) return;
    if (!faults.empty()) faults += ", ";
    faults += fault;
  };
  expect(std::fegetround() == FE_TONEAREST, "numbers are not rounded to nearest");
  const double least = opaque(std::numeric_limits<double>::denorm_min()), normal = opaque(std::numeric_limits<double>::min());
  expect(least + least == 2 * std::numeric_limits<double>::denorm_min() && opaque(normal / 2) > 0,
         "subnormal numbers are flushed to zero");
  // (1 + u)^2 = 1 + 2u + u^2 is rounded to 1 + 2u; only a fused multiply-add would see the u^2.
  const double u = 0x1p-30, a = opaque(1 + u), b = opaque(-(1 + 2 * u));
  expect(a * a + b == 0, "products and sums are contracted");
  const double one = opaque(1), tiny = opaque(0x1p-60);
  expect((one + tiny) - one == 0, "sums are reassociated");
  const double zero = opaque(0), nan = opaque(std::numeric_limits<double>::quiet_NaN());
  expect(nan != nan && !(nan == nan), "NaN is not preserved");
  expect(std::signbit(opaque(-zero)) && std::signbit(-zero * one), "signed zeros are not preserved");
  return faults;
}

void require_ieee_arithmetic() {
  if (const std::string faults = arithmetic_faults(); !faults.empty())
    throw ArithmeticError("the arithmetic is not that of IEEE 754: " + faults +
                          "; the digits of the results would differ: build without -ffast-math and -ffp-contract, and let "
                          "nothing in the process change the rounding mode or the treatment of subnormal numbers");
}

}  // namespace earthtop
