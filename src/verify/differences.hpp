// SPDX-License-Identifier: GPL-3.0-or-later
/// How far rows are apart, as numbers.
#pragma once

#include <array>

#include "earthtop/drift/drift.hpp"

namespace earthtop::verify_detail {

/// The larger; a number that is none is larger than all.
inline double worse(double a, double b) { return !(b <= a) ? b : a; }

/// The angle between two attitudes (w, x, y, z) in long double (rad); the norms do not matter, nor the signs.
double attitude_distance(const std::array<double, 4>& p, const std::array<double, 4>& q);

/// From the end of a motion that ran backwards to the release it should have come to: the angle between the attitudes (rad), or
/// the difference of the rates over the release's, whichever is larger.
double return_error(const DriftRow& returned, const DriftRow& release);

}  // namespace earthtop::verify_detail
