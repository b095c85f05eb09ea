// SPDX-License-Identifier: GPL-3.0-or-later
/// The program as a verb: what can be said of it on the command line.
#pragma once

#include <memory>

#include "command_line.hpp"

namespace earthtop::tool {

/// With all verbs, of which some refer to it.
std::unique_ptr<const Verb> describe_program();

}  // namespace earthtop::tool
