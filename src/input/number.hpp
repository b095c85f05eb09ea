// SPDX-License-Identifier: GPL-3.0-or-later
/// JSON decimals to doubles, without silent infinities and zeros.
#pragma once

#include <string_view>

namespace earthtop::input {

enum class NumberFit { fits, too_large, too_small };

/// The nearest double to a JSON number; `too_small` for one that is not zero but would become zero. -0 becomes 0.
NumberFit decimal_to_double(std::string_view digits, double& value);

}  // namespace earthtop::input
