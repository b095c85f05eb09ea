// SPDX-License-Identifier: GPL-3.0-or-later
/// The program's own command-line table.
#pragma once

#include <memory>

#include "command_line.hpp"

namespace earthtop::tool {

/// The program with all its verbs, some of which keep references to it.
std::unique_ptr<const Verb> describe_program();

}  // namespace earthtop::tool
