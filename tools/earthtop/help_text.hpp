// SPDX-License-Identifier: GPL-3.0-or-later
/// The help on a terminal, made from the same table as the manual.
#pragma once

#include <cstddef>
#include <string>

namespace earthtop::tool {

struct NamedVerb;

/// Writes what --help prints about a verb: what it does, its operands and options, examples and exit statuses. About the program: its
/// verbs in groups, commands to begin with, and all exit statuses.
/// @param width  columns of a line
std::string help_text(const NamedVerb& named, std::size_t width);

}  // namespace earthtop::tool
