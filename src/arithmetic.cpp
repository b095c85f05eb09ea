// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/arithmetic.hpp"

#include <cfenv>
#include <cmath>
#include <limits>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace earthtop {
namespace {

/// Hides a value from the optimizer, so that the processor has to compute with it at run time.
template <class T>
T opaque(T x) {
  volatile T kept = x;
  return kept;
}

/// Whether sums are rounded to nearest, not up, down or towards zero. x86 has a mode for each of its two units, and `fegetround`
/// knows one of them.
template <class T>
bool rounds_to_nearest() {
  const T one = opaque(T(1)), little = opaque(std::numeric_limits<T>::epsilon() / 8);
  return opaque(one + little) == 1 && opaque(one - little) == 1;
}

bool keeps_all_digits_of_long_double() {
  const long double one = opaque(1.0L), last = opaque(std::numeric_limits<long double>::epsilon());
  return opaque(one + last) - one == last;
}

/// Whether a division by zero, an overflow or the like ends the process instead of giving infinity or NaN.
bool exceptions_trap() {
#if defined(__SSE2__)
  if ((_mm_getcsr() & _MM_MASK_MASK) != _MM_MASK_MASK) return true;
#endif
#if defined(__GLIBC__)
  return fegetexcept() != 0;
#else
  return false;
#endif
}

}  // namespace

NoTraps::NoTraps() { std::feholdexcept(&before_); }
NoTraps::~NoTraps() { std::fesetenv(&before_); }

std::string arithmetic_faults() {
  std::string faults;
  const auto expect = [&](bool sound, const char* fault) {
    if (sound) return;
    if (!faults.empty()) faults += ", ";
    faults += fault;
  };
  expect(!exceptions_trap(), "floating-point exceptions are trapped");
  const NoTraps none;  // the questions below raise some
  const bool nearest = rounds_to_nearest<double>() && rounds_to_nearest<long double>();
  expect(nearest, "numbers are not rounded to nearest");
  expect(!nearest || keeps_all_digits_of_long_double(), "long double is rounded to fewer digits than it has");
  const double least = opaque(std::numeric_limits<double>::denorm_min()), normal = opaque(std::numeric_limits<double>::min());
  expect(least + least == 2 * std::numeric_limits<double>::denorm_min() && opaque(normal / 2) > 0,
         "subnormal numbers are flushed to zero");
  // (1 + u)^2 = 1 + 2u + u^2 is rounded to 1 + 2u; only a fused multiply-add would see the u^2.
  const double u = 0x1p-30, a = opaque(1 + u), b = opaque(-(1 + 2 * u));
  expect(!nearest || a * a + b == 0, "products and sums are contracted");
  const double one = opaque(1.0), tiny = opaque(0x1p-60);
  expect(!nearest || (one + tiny) - one == 0, "sums are reassociated");
  const double zero = opaque(0.0), nan = opaque(std::numeric_limits<double>::quiet_NaN());
  expect(nan != nan && !(nan == nan), "NaN is not preserved");
  expect(std::signbit(opaque(-zero)) && std::signbit(-zero * one), "signed zeros are not preserved");
  return faults;
}

void require_ieee_arithmetic() {
  if (const std::string faults = arithmetic_faults(); !faults.empty())
    throw ArithmeticError("the arithmetic is not that of IEEE 754 by default: " + faults +
                          "; build without -ffast-math and -ffp-contract, and let nothing in the process change the rounding "
                          "mode, the precision of long double, the treatment of subnormal numbers, or what is trapped");
}

}  // namespace earthtop
