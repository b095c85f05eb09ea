// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings.hpp"

namespace earthtop::python {

void bind_study(py::module_&) {}

}  // namespace earthtop::python
