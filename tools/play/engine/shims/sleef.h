// SPDX-License-Identifier: GPL-3.0-or-later
/// The functions of SLEEF that the core library calls, transcribed from this machine's library by transcribe_sleef.py.
#pragma once

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  double x, y;
} Sleef_double_2;

#define EARTHTOP_SLEEF(name) double Sleef_cinz_##name##purec(double)
EARTHTOP_SLEEF(sind1_u10);
EARTHTOP_SLEEF(cosd1_u10);
EARTHTOP_SLEEF(tand1_u10);
EARTHTOP_SLEEF(asind1_u10);
EARTHTOP_SLEEF(acosd1_u10);
EARTHTOP_SLEEF(atand1_u10);
EARTHTOP_SLEEF(expd1_u10);
EARTHTOP_SLEEF(exp2d1_u10);
EARTHTOP_SLEEF(exp10d1_u10);
EARTHTOP_SLEEF(expm1d1_u10);
EARTHTOP_SLEEF(logd1_u10);
EARTHTOP_SLEEF(log2d1_u10);
EARTHTOP_SLEEF(log10d1_u10);
EARTHTOP_SLEEF(log1pd1_u10);
EARTHTOP_SLEEF(cbrtd1_u10);
EARTHTOP_SLEEF(sinhd1_u10);
EARTHTOP_SLEEF(coshd1_u10);
EARTHTOP_SLEEF(tanhd1_u10);
EARTHTOP_SLEEF(asinhd1_u10);
EARTHTOP_SLEEF(acoshd1_u10);
EARTHTOP_SLEEF(atanhd1_u10);
EARTHTOP_SLEEF(erfd1_u10);
EARTHTOP_SLEEF(erfcd1_u15);
EARTHTOP_SLEEF(tgammad1_u10);
EARTHTOP_SLEEF(lgammad1_u10);
#undef EARTHTOP_SLEEF
double Sleef_cinz_atan2d1_u10purec(double y, double x);
double Sleef_cinz_powd1_u10purec(double x, double y);
Sleef_double_2 Sleef_cinz_sincosd1_u10purec(double);

#ifdef __cplusplus
}
#endif
