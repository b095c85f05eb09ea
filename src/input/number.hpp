// SPDX-License-Identifier: GPL-3.0-or-later
/// Converts JSON decimals to doubles, without silent infinities and zeros.
#pragma once

#include <string_view>

namespace earthtop::input {

enum class NumberFit { fits, too_large, too_small };

/// Converts a JSON number to the nearest double. @returns `too_small` for a nonzero number that would become zero; -0 becomes 0
NumberFit decimal_to_double(std::string_view digits, double& value);

}  // namespace earthtop::input
