// SPDX-License-Identifier: GPL-3.0-or-later
/// Answers to words of the command line that are not known: what was wrong, and what was probably meant.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace earthtop::tool {

struct NamedVerb;
struct Verb;

/// The complaint of an argument that the verb does not take: of an option that it does not have, a verb that does not exist, or
/// an operand too many.
std::string complaint_of_unknown(const NamedVerb& named, std::string_view argument);

/// The complaint of a value that is none of the words allowed; empty if it is one of them.
std::string complaint_of_word(std::string_view given, const std::vector<std::string>& words);

/// The verb that words name: "study", "merge". Without words, the program itself. @throws UsageError
NamedVerb find_verb(const Verb& program, const std::vector<std::string>& words);

}  // namespace earthtop::tool
