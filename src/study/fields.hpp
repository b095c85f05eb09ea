// SPDX-License-Identifier: GPL-3.0-or-later
/// The table of a study file's fields.
#pragma once

#include "input/fields.hpp"

namespace earthtop::study {

/// Every key of a study file.
const input::FieldTable& fields();

}  // namespace earthtop::study
