// SPDX-License-Identifier: GPL-3.0-or-later
/// The parts of the extension module earthtop._core. The Python package around it is what people use; this module only passes
/// numbers, texts and JSON documents.
#pragma once

#include <pybind11/pybind11.h>

namespace earthtop::python {

namespace py = pybind11;

void bind_errors(py::module_& module);
void bind_scenario(py::module_& module);
void bind_results(py::module_& module);
void bind_closed_form(py::module_& module);
void bind_study(py::module_& module);
void bind_documents(py::module_& module);
void bind_measure(py::module_& module);

}  // namespace earthtop::python
