// SPDX-License-Identifier: GPL-3.0-or-later
/// Keys that give a quantity in another unit than the table's key does (mass_g for mass_kg), and abbreviated keys. Both are found
/// from the units of the fields and one table of unit symbols, so that no key has to be listed.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "input/fields.hpp"

namespace earthtop::input {

struct ForeignUnit {
  std::string message;     ///< the right key and the factor: "give mass_kg; 1 g = 0.001 kg"
  std::string_view meant;  ///< the key of the object itself that was meant; it may be an object that holds the right key
};

/// Explains an unknown key that consists of the stem of a known key, or of an abbreviation of it, and of another unit of the same
/// dimension. Where several keys of the object give the quantity, all are named. Empty for any other key.
/// @param pattern  pattern of the object whose keys may be meant
/// @param with_path  whether the message names keys with their paths, as the key stands in another object
std::optional<ForeignUnit> foreign_unit(const FieldTable& table, std::string_view key, std::string_view pattern,
                                        bool with_path = false);

/// Returns the first key of the object whose stem a key abbreviates ("lat" or "lat_deg" for latitude_deg), or calls by another name
/// ("altitude_m" for height_m); empty for any other key.
std::optional<std::string_view> abbreviated(const FieldTable& table, std::string_view key, std::string_view pattern);

/// Returns a name in lower case without the words at its end that name units, symbols or spoken: "mass" of "mass_kg" and of
/// "mass_grams". A name that consists of them alone is left as it is.
std::string_view without_unit(std::string_view lower);

/// Returns the keys of an object that give the quantity of an earlier key of the object in another unit, as spin_rpm does after
/// spin_rad_s.
std::vector<std::string_view> keys_in_second_units(const FieldTable& table, std::string_view pattern);

}  // namespace earthtop::input
