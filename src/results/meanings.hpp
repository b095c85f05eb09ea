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

}  // namespace earthtop
