// SPDX-License-Identifier: GPL-3.0-or-later
/// Changes single values in a JSON text and leaves the rest of it as it is: layout, comments, the order of keys.
#pragma once

#include <string>
#include <string_view>

namespace earthtop::input {

/// Replaces or adds the value at a pointer as an override `--set pointer=value` does: objects missing on the way are made, and
/// a value that is not JSON becomes a string.
/// @param text  valid JSON without repeated keys, perhaps with a byte order mark
/// @param pointer  a JSON pointer; each step but the last leads through an object, or to an element that an array has
/// @returns the changed text   @throws ScenarioError where the pointer leads to no such place
std::string with_value(std::string_view text, std::string_view pointer, std::string_view value);

/// Removes the member of an object at a pointer that leads through objects; a text without it stays as it is.
std::string without_member(std::string_view text, std::string_view pointer);

}  // namespace earthtop::input
