// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cmath>
#define SLEEF_VERSION_MAJOR 0
#define SLEEF_VERSION_MINOR 0
#define SLEEF_VERSION_PATCHLEVEL 0
#define F1(name) inline double Sleef_cinz_##name##d1_u10purec(double x) { return std::name(x); }
F1(sin) F1(cos) F1(tan) F1(asin) F1(acos) F1(atan) F1(exp) F1(exp2) F1(expm1) F1(log) F1(log2) F1(log10) F1(log1p) F1(cbrt) F1(sinh) F1(cosh) F1(tanh) F1(asinh) F1(acosh) F1(atanh) F1(erf) F1(tgamma) F1(lgamma)
inline double Sleef_cinz_erfcd1_u15purec(double x) { return std::erfc(x); }
inline double Sleef_cinz_exp10d1_u10purec(double x) { return std::pow(10, x); }
inline double Sleef_cinz_atan2d1_u10purec(double y, double x) { return std::atan2(y, x); }
inline double Sleef_cinz_powd1_u10purec(double y, double x) { return std::pow(y, x); }
struct Sleef_double_2 { double x, y; };
inline Sleef_double_2 Sleef_cinz_sincosd1_u10purec(double x) { return {std::sin(x), std::cos(x)}; }
