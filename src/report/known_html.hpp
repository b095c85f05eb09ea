// SPDX-License-Identifier: GPL-3.0-or-later
/// Numbers with their errors, both in one unit, as a page shows them.
#pragma once

#include <string>
#include <string_view>

#include "text/number_words.hpp"

namespace earthtop::report {

/// "235.189″ ± 0.012″": the number to the second digit of its error. The element's machine-readable value stays in SI units and is
/// exact to the last bit. Without an error that is known, the number alone.
/// @param strong  whether the number is emphasised
std::string known_html(double si, double error_si, const ReadableUnit& unit, bool strong = false);
/// The same in a unit that needs no factor: "rad/s".
std::string known_html(double value, double error, std::string_view unit);

/// An angle and its error in the unit of the angle's size.
std::string known_angle_html(double rad, double error_rad, bool strong = false);

/// The error alone, as it stands behind its number.
std::string error_html(double si, double error_si, const ReadableUnit& unit);

}  // namespace earthtop::report
