// SPDX-License-Identifier: GPL-3.0-or-later
/// Makes a source call real::pow where it says std::pow: the step size controls of odeint do, and the last digit of the C
/// library's pow depends on the processor. This header must be included before everything else. A precompiled header would
/// already have declared pow, so sources that include this one are compiled without.
#pragma once

#ifdef _GLIBCXX_CMATH
#error "included after <cmath>: the C library's pow would be called"
#endif
#pragma redefine_extname pow earthtop_pow
