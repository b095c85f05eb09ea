// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "earthtop/error.hpp"

namespace earthtop::python {

/// The findings as Python sees them: tuples (file, line, column, pointer, message, text), line and column None where unknown.
pybind11::list findings(const std::string& file, const std::vector<Diagnostic>& diagnostics);

}  // namespace earthtop::python
