// SPDX-License-Identifier: GPL-3.0-or-later
/// A number as a title has it: with few digits.
#pragma once

#include <string>

namespace earthtop {

/// At most four significant digits, and no more than the number's error leaves: "235.2".
/// @param value, error  finite, error >= 0, in any common unit
std::string short_number(double value, double error);

}  // namespace earthtop
