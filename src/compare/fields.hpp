// SPDX-License-Identifier: GPL-3.0-or-later
/// The tables of the keys of mapping and tolerance files.
#pragma once

#include "input/fields.hpp"

namespace earthtop::compare {

/// Every key of a mapping file, which states the meaning of the columns of another program's CSV file.
const input::FieldTable& mapping_fields();
/// Every key of a tolerance file.
const input::FieldTable& tolerances_fields();

}  // namespace earthtop::compare
