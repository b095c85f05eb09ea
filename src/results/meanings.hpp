// SPDX-License-Identifier: GPL-3.0-or-later
/// What the numbers and words of summary.json mean, in a phrase each, for lists of them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace earthtop {

/// The dotted paths of all numbers, words and flags that some run's summary.json has. A list has its first element, with the
/// number 0, for all; a vector each of its components.
std::vector<std::string> summary_paths();

/// The unit of what stands at a dotted path; empty for words and pure numbers.
std::string unit_of_path(std::string_view path);
/// Its meaning in a phrase; empty where there is none.
std::string meaning_of_path(std::string_view path);

/// The words by which a page calls a number, instead of its key.
struct QuantityWords {
  std::string words;
  std::string unit;  ///< empty for words and pure numbers
};
/// The words for something that a study varies, or that a fit estimates: the name that its author gave it without the unit in it, or else
/// the scenario's key.
/// @param name  may be the pointer itself   @param pointer  into the scenario; may be empty
QuantityWords words_of_setting(std::string_view name, std::string_view pointer);
/// The words for something that a study collects: the meaning of its path, or the name that its author gave it instead.
QuantityWords words_of_quantity(std::string_view name, std::string_view path);
/// A unit as it is printed in a text: "kg m^2" -> "kg m²", "deg" -> "°".
std::string unit_in_signs(std::string_view unit);

}  // namespace earthtop
