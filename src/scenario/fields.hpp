// SPDX-License-Identifier: GPL-3.0-or-later
/// The table of a scenario's fields.
#pragma once

#include "input/fields.hpp"

namespace earthtop::scenario {

using input::FieldTable;

/// Returns the table of every key of a scenario.
const FieldTable& fields();

}  // namespace earthtop::scenario
