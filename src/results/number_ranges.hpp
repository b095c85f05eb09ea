// SPDX-License-Identifier: GPL-3.0-or-later
/// What the numbers in the program's own files may be. The name of a number tells: that of a JSON member, or of a column.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace earthtop {

/// The ranges of numbers, by what they are.
enum class NumberRange {
  any,           ///< every number
  not_negative,  ///< a bound, a standard error, a tolerance, a time that something took
  count,         ///< a whole number that is not negative
  probability,   ///< from 0 to 1
  correlation,   ///< from -1 to 1, but for rounding
  flag           ///< 0 or 1
};

/// The range of the numbers of a name.
/// @param parent  the name of the object, or list of objects, that has the member
NumberRange range_of(std::string_view name, std::string_view parent = {});

/// What a number would have to be, for a message; empty where it is in its range. NaN, which stands for no number, is in each.
std::string_view fault_of(NumberRange range, double number);

/// Holds all numbers of a document against their ranges. What is below "scenario" is passed over: it is checked as a scenario.
/// @param file  the document's name, for messages   @throws ScenarioError with the pointers of all numbers that are out of range
void check_ranges(const nlohmann::ordered_json& document, const std::string& file);

}  // namespace earthtop
