// SPDX-License-Identifier: GPL-3.0-or-later
/// A run's motion in few characters, for the pictures that move.
#pragma once

#include <span>

#include "report/html.hpp"

namespace earthtop::report {

/// Numbers in steps of a share of their extent, 2^-bits: `from`, `unit` and `text`, in which the second differences of the steps stand
/// in 64 characters of five bits each and one that says whether more follow. assets/unpack.js reads it.
/// @param list  finite numbers
Json packed(std::span<const double> list, int bits);

/// Two axes over time. The second one stands as its difference from the first, which may be small. A component that stays away from
/// zero is left out, since the others tell it.
/// @param axis, reference  three finite components for each time
Json packed_axes(std::span<const double> axis, std::span<const double> reference);

/// Times: their ends where they are in equal steps.
Json packed_times(std::span<const double> times_s);

}  // namespace earthtop::report
