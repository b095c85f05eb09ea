// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "bindings.hpp"
#include "earthtop/budget/budget.hpp"
#include "earthtop/compare/compare.hpp"
#include "earthtop/report/report.hpp"
#include "earthtop/results/results.hpp"
#include "earthtop/run/contact_explanation.hpp"
#include "earthtop/scenario/support.hpp"
#include "waiting.hpp"

namespace earthtop::python {
namespace {

std::string explained(Scene scene, const Watch& watch) {
  if (scene.support().has_contact) return contact_explanation_json(explain_contact(scene, watch), scene);
  const auto budget = explain_effects(scene, watch);
  return budget ? budget_json(*budget, scene) : "";
}

Tolerances tolerances_of(const std::string& file, const std::string& profile) {
  Tolerances tolerances;
  if (!file.empty()) tolerances = read_tolerances(file);
  if (profile.empty()) return tolerances;
  for (const Profile known : {Profile::bitwise, Profile::regression, Profile::physics})
    if (to_string(known) == profile) {
      tolerances.profile = known;
      return tolerances;
    }
  throw ScenarioError("", "profile must be \"bitwise\", \"regression\" or \"physics\"");
}

py::tuple compared(const std::string& reference, const std::string& candidate, const std::string& profile,
                   const std::string& tolerances, const std::string& mapping, const std::vector<std::string>& may_change,
                   bool may_lack_rows, std::optional<double> steps_ratio, std::optional<double> seconds_ratio,
                   const py::object& on_progress) {
  const CompareReport report = result_of(on_progress, [&](const Watch& watch) {
    CompareOptions options;
    options.tolerances = tolerances_of(tolerances, profile);
    if (steps_ratio) options.tolerances.steps_ratio = steps_ratio;
    if (seconds_ratio) options.tolerances.seconds_ratio = seconds_ratio;
    options.mapping = mapping;
    options.may_change = may_change;
    options.may_lack_rows = may_lack_rows;
    options.with_curves = true;
    options.watch = watch.part(0, 1, "rows");
    return compare_results(reference, candidate, options);
  });
  return py::make_tuple(comparison_json(report), svg(comparison_figure(report)), comparison_junit(report), report.unverified());
}

}  // namespace

void bind_documents(py::module_& module) {
  module.def(
      "explain",
      [](const Scene& scene, const py::object& on_progress) {
        return result_of(on_progress, [&](const Watch& watch) { return explained(scene, watch); });
      },
      py::arg("scene"), py::arg("on_progress"), "The effect budget of a scene as a document.");
  module.def("compare", &compared, py::arg("reference"), py::arg("candidate"), py::arg("profile"), py::arg("tolerances"),
             py::arg("mapping"), py::arg("may_change"), py::arg("may_lack_rows"), py::arg("steps_ratio"),
             py::arg("seconds_ratio"), py::arg("on_progress"),
             "Compares what two paths hold: (document, picture as SVG, JUnit XML, notes on what could not be verified).");
  module.def(
      "make_report",
      [](const std::filesystem::path& what) {
        Report report = result_of(py::none(), [&](const Watch& watch) { return make_report(what, watch); });
        return py::make_tuple(std::move(report.html), std::move(report.pictures), std::move(report.notes));
      },
      py::arg("what"), "The page of what a path holds: (html, [(name, svg)], notes on what could not be verified).");
  module.def("resealed", &resealed, py::arg("document"), "A document that was changed, with the checksum that fits.");
  module.def("report_file", &report_file, py::arg("what"), "Where the page of a path is put by default.");
}

}  // namespace earthtop::python
