// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/stl.h>

#include "bindings.hpp"
#include "default_arithmetic.hpp"
#include "earthtop/results/top_lines.hpp"
#include "earthtop/run.hpp"
#include "earthtop/scenario/reference.hpp"
#include "earthtop/scene/scene.hpp"
#include "errors.hpp"

namespace earthtop::python {
namespace {

/// A property of a scene, computed with default arithmetic.
template <class Get>
auto property(Get get) {
  return [get](const Scene& scene) {
    const DefaultArithmetic arithmetic;
    return get(scene);
  };
}

}  // namespace

void bind_scenario(py::module_& module) {
  py::class_<Scene>(module, "Scene", "A scenario that has been checked and resolved; it never changes.")
      .def_property_readonly("name", [](const Scene& scene) { return scene.scenario().name; })
      .def_property_readonly("sha256", property([](const Scene& scene) { return scene.sha256(); }))
      .def_property_readonly("canonical", property([](const Scene& scene) { return canonical_json(scene.scenario()); }),
                             "canonical text of the scenario: one line of JSON with every default written out")
      .def_property_readonly("top", property([](const Scene& scene) { return top_json(scene); }), "figures of the top, as JSON")
      .def_property_readonly("method",
                             property([](const Scene& scene) { return std::string(to_string(scene.choice().options.method)); }))
      .def_property_readonly("estimated_seconds", property([](const Scene& scene) { return estimated_run_seconds(scene); }))
      .def_property_readonly("rows", property([](const Scene& scene) {
                               return output_times(scene.scenario().duration_s, scene.scenario().output_step_s).size();
                             }));

  module.def(
      "examine",
      [](const std::string& file, const std::string& text, const Overrides& overrides) {
        ScenarioReport report;
        {
          const py::gil_scoped_release released;
          const DefaultArithmetic arithmetic;
          report = examine_scenario({file, text}, overrides);
        }
        py::object scene = report.scene ? py::cast(*report.scene) : py::none();
        return py::make_tuple(std::move(scene), report.error_count, findings(file, report.errors),
                              findings(file, report.warnings));
      },
      py::arg("file"), py::arg("text"), py::arg("overrides"),
      "Checks a scenario's text: (scene or None, number of all errors, errors, warnings).");
  module.def(
      "read_scenario",
      [](const std::string& path) {
        ScenarioSource source = read_scenario_source(path);
        return std::make_pair(source.file, source.text);
      },
      py::arg("path"), "Reads a scenario file: (name for messages, text).");
  module.def("changed_text", &changed_text, py::arg("text"), py::arg("overrides"),
             "A scenario's text with changes in it; everything else stays as it is.");
  module.def("scenario_pointer", &scenario_pointer, py::arg("key"), "The JSON pointer of the key that a user names.");
  module.def("scenario_pointers", &scenario_pointers, "JSON pointers of all single values of a scenario.");
}

}  // namespace earthtop::python
