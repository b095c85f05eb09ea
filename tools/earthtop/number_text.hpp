// SPDX-License-Identifier: GPL-3.0-or-later
/// Numbers as the terminal shows them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace earthtop::tool {

/// The value with one digit more than its bound leaves certain, or with seven digits if the bound is zero.
std::string with_bound(double value, double bound, std::string_view unit);

/// The time with one digit more than its bound leaves certain.
std::string time_with_bound(double t_s, const std::optional<double>& bound_s);

/// A length in a handy unit, from metres to nanometres.
std::string pictured_length(double m);

}  // namespace earthtop::tool
