// SPDX-License-Identifier: GPL-3.0-or-later
/// Suggestions of the kind "did you mean": the known word that a misspelled one probably stands for.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace earthtop::input {

/// Returns the best candidate: the same letters in another case, the same quantity with its unit missing ("mass" for
/// "mass_kg") or in another unit ("mass_grams"), or a word that differs by a few letters. Empty if no candidate is near.
std::optional<std::string_view> suggest(std::string_view given, const std::vector<std::string_view>& candidates);

/// Returns a word in lower case, with '_' for '-': words that differ in these only are meant to be the same.
std::string lower_case(std::string_view text);

/// Returns whether one letter inserted, left out, replaced or swapped with its neighbour turns one into the other, in any case.
bool is_one_letter_off(std::string_view given, std::string_view word);

}  // namespace earthtop::input
