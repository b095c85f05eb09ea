// SPDX-License-Identifier: GPL-3.0-or-later
/// "Did you mean": the known word that a misspelled one was probably meant to be.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace earthtop::input {

/// The best of the candidates: same letters in another case, the same quantity with its unit missing ("mass" for "mass_kg")
/// or another unit ("mass_grams"), or a few letters away. Nothing where no candidate comes near.
std::optional<std::string_view> suggest(std::string_view given, const std::vector<std::string_view>& candidates);

}  // namespace earthtop::input
