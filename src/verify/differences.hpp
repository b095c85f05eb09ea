// SPDX-License-Identifier: GPL-3.0-or-later
/// Measures of the difference between rows.
#pragma once

#include <array>

#include "earthtop/drift/drift.hpp"

namespace earthtop::verify_detail {

/// The larger of two errors; NaN counts as larger than any number.
inline double worse(double a, double b) { return !(b <= a) ? b : a; }

/// The angle between two attitudes (w, x, y, z), computed in float80 (rad); norms and signs do not matter.
double attitude_distance(const std::array<double, 4>& p, const std::array<double, 4>& q);

/// The error of a motion that ran backwards, relative to the release to which it should have returned: the angle between the
/// attitudes (rad), or the difference of the rates over the release's rate, whichever is larger.
double return_error(const DriftRow& returned, const DriftRow& release);

}  // namespace earthtop::verify_detail
