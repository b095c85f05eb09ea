// SPDX-License-Identifier: GPL-3.0-or-later
/// Describes an option, in help and manual alike.
#pragma once

#include <string>
#include <vector>

namespace earthtop::tool {

struct Option;
struct Verb;

/// "a, b, c".
std::string comma_list(const std::vector<std::string>& words);

/// The effect of an option, and the limits on its value.
std::string option_meaning(const Option& option, const Verb& verb);

}  // namespace earthtop::tool
