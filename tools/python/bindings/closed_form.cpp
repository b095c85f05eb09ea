// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings.hpp"

namespace earthtop::python {

void bind_closed_form(py::module_&) {}

}  // namespace earthtop::python
