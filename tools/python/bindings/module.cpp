// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings.hpp"
#include "earthtop/results/provenance.hpp"

PYBIND11_MODULE(_core, module) {
  using namespace earthtop::python;
  module.doc() = "The compiled part of the package earthtop; import earthtop instead.";
  module.attr("version") = earthtop::build_info().version;
  module.attr("commit") = earthtop::build_info().commit;
  module.attr("pybind11") = PYBIND11_TOSTRING(PYBIND11_VERSION_MAJOR) "." PYBIND11_TOSTRING(PYBIND11_VERSION_MINOR);
  bind_errors(module);
  bind_scenario(module);
  bind_results(module);
  bind_closed_form(module);
  bind_study(module);
  bind_documents(module);
  bind_measure(module);
}
