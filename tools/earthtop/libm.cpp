// SPDX-License-Identifier: GPL-3.0-or-later
/// The C library's elementary functions, defined anew for the libraries that the program is linked with.
///
/// ERFA (positions of Moon, Sun and pole), GeographicLib (gravity at the site), GSL and SUNDIALS call the C library's
/// functions. Their last digit depends on the processor, and part of it reaches the results. A name that the program defines
/// takes precedence over the C library's in shared libraries, too, so all of these use the same functions as earthtop itself.
/// hypot is not among them: the C library computes it by exact operations, with the same code on all processors.
#include "earthtop/elementary.hpp"

namespace real = earthtop::real;

// The rest of the program is compiled with hidden symbols, which shared libraries would not find.
#pragma GCC visibility push(default)

extern "C" {
double sin(double x) noexcept { return real::sin(x); }
double cos(double x) noexcept { return real::cos(x); }
double tan(double x) noexcept { return real::tan(x); }
void sincos(double x, double* sine, double* cosine) noexcept {
  const auto both = real::sin_cos(x);
  *sine = both.sin;
  *cosine = both.cos;
}
double asin(double x) noexcept { return real::asin(x); }
double acos(double x) noexcept { return real::acos(x); }
double atan(double x) noexcept { return real::atan(x); }
double atan2(double y, double x) noexcept { return real::atan2(y, x); }
double exp(double x) noexcept { return real::exp(x); }
double exp2(double x) noexcept { return real::exp2(x); }
double exp10(double x) noexcept { return real::exp10(x); }
double expm1(double x) noexcept { return real::expm1(x); }
double log(double x) noexcept { return real::log(x); }
double log2(double x) noexcept { return real::log2(x); }
double log10(double x) noexcept { return real::log10(x); }
double log1p(double x) noexcept { return real::log1p(x); }
double pow(double x, double y) noexcept { return real::pow(x, y); }
double cbrt(double x) noexcept { return real::cbrt(x); }
double sinh(double x) noexcept { return real::sinh(x); }
double cosh(double x) noexcept { return real::cosh(x); }
double tanh(double x) noexcept { return real::tanh(x); }
double asinh(double x) noexcept { return real::asinh(x); }
double acosh(double x) noexcept { return real::acosh(x); }
double atanh(double x) noexcept { return real::atanh(x); }
double erf(double x) noexcept { return real::erf(x); }
double erfc(double x) noexcept { return real::erfc(x); }
double tgamma(double x) noexcept { return real::tgamma(x); }
double lgamma(double x) noexcept { return real::lgamma(x); }
}

#pragma GCC visibility pop
