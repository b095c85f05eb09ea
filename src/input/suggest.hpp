// SPDX-License-Identifier: GPL-3.0-or-later
/// Suggestions of the kind "did you mean": the known word that a misspelled one probably stands for.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace earthtop::input {

/// How near a suggestion is. A name consists of words, joined by '_', of which the last ones may spell a unit.
enum class Nearness {
  same,       ///< every word is the same, but for case and unit: "Mass" for "mass_kg", "mass_grams", too
  misspelt,   ///< every word is a misspelling of its counterpart, or only the joints differ: "tip_raduis_m", "centerofmass"
  incomplete  ///< words are missing: "tolerance" for "relative_tolerance"
};

struct Suggestion {
  std::string_view word;
  Nearness nearness;
};

/// Returns the nearest candidate; empty if none is near, or if several are incomplete in the same way. A word that is no
/// misspelling of the candidate's means something else: "rim_radius_m" is not "tip_radius_m", nor "tip_mass_kg".
std::optional<Suggestion> nearest(std::string_view given, const std::vector<std::string_view>& candidates);

/// The same without its nearness.
std::optional<std::string_view> suggest(std::string_view given, const std::vector<std::string_view>& candidates);

/// Returns a word in lower case, with '_' for '-': words that differ in these only are meant to be the same.
std::string lower_case(std::string_view text);

/// Returns whether one letter inserted, left out, replaced or swapped with its neighbour turns one into the other, in any case.
bool is_one_letter_off(std::string_view given, std::string_view word);

}  // namespace earthtop::input
