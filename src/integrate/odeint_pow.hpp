// SPDX-License-Identifier: GPL-3.0-or-later
/// odeint's step size controls call std::pow, whose last digit depends on the processor. Included before everything else, this
/// has a source call real::pow by that name; a header that was precompiled has seen the name already, so such sources do
/// without.
#pragma once

#ifdef _GLIBCXX_CMATH
#error "included after <cmath>: the C library's pow would be called"
#endif
#pragma redefine_extname pow earthtop_pow
