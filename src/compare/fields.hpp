// SPDX-License-Identifier: GPL-3.0-or-later
/// The tables of fields of the files that a comparison takes.
#pragma once

#include "input/fields.hpp"

namespace earthtop::compare {

/// Every key of a mapping file, which says what the columns of another program's CSV file mean.
const input::FieldTable& mapping_fields();
/// Every key of a tolerance file.
const input::FieldTable& tolerances_fields();

}  // namespace earthtop::compare
