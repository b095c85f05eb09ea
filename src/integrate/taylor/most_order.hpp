// SPDX-License-Identifier: GPL-3.0-or-later
/// The highest order a Taylor series is taken to.
#pragma once

#include "earthtop/real.hpp"

namespace earthtop::taylor {

template <class T>
inline constexpr int kMostOrder = 32;
template <>
inline constexpr int kMostOrder<float128> = 64;

}  // namespace earthtop::taylor
