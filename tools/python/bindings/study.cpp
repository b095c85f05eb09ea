// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/study/study.hpp"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "bindings.hpp"
#include "earthtop/study/run_study.hpp"
#include "earthtop/study/study_columns.hpp"
#include "waiting.hpp"

namespace earthtop::python {
namespace {

namespace fs = std::filesystem;

/// An array of shape (rows) that owns the numbers; None if there are none.
template <class Number>
py::object array_of(std::vector<Number>&& numbers) {
  if (numbers.empty()) return py::none();
  auto* kept = new std::vector<Number>(std::move(numbers));
  const py::capsule owner(kept, [](void* memory) { delete static_cast<std::vector<Number>*>(memory); });
  return py::array_t<Number>(static_cast<py::ssize_t>(kept->size()), kept->data(), owner);
}

StudyRunReport run_and_write(const ScenarioSource& source, StudyRunOptions options, bool writes_results, const Watch& watch) {
  const Study study = parse_study(source);
  options.watch = watch;
  const Watch points = watch.part(0, 1, "points");
  options.on_progress = [&](const StudyProgress& progress) { points.reach(progress.share); };
  if (writes_results) check_study_results(options.dir, study, options.force);
  StudyRunReport report = run_study(study, options);
  if (writes_results && !report.interrupted) write_study_results(report.store, watch, options.force);
  return report;
}

}  // namespace

void bind_study(py::module_& module) {
  module.def(
      "run_study",
      [](const std::string& file, const std::string& text, const fs::path& dir, unsigned jobs, bool force, bool keep_going,
         bool retry_failed, bool repair, bool writes_results, const py::object& on_progress) {
        StudyRunOptions options;
        options.dir = dir;
        options.jobs = jobs;
        options.force = force;
        options.keep_going = keep_going;
        options.retry_failed = retry_failed;
        options.repair = repair;
        const StudyRunReport report = result_of(on_progress, [&](const Watch& watch) {
          return run_and_write({file, text}, options, writes_results, watch);
        });
        return report.store.string();
      },
      py::arg("file"), py::arg("text"), py::arg("dir"), py::arg("jobs"), py::arg("force"), py::arg("keep_going"),
      py::arg("retry_failed"), py::arg("repair"), py::arg("writes_results"), py::arg("on_progress"),
      "Computes the points that the store in the directory lacks; returns the store's path.");
  module.def(
      "study_columns",
      [](const fs::path& given) {
        const auto read = [&](const Watch& watch) { return study_columns(store_at(given), watch); };
        py::list list;
        for (StudyColumn& column : result_of(py::none(), read))
          list.append(py::make_tuple(column.name, column.has_numbers, array_of(std::move(column.numbers)),
                                     py::tuple(py::cast(column.words)), array_of(std::move(column.places))));
        return list;
      },
      py::arg("store"),
      "Columns of a study's table: (name, whether it has numbers, numbers, words, places among the words); an empty array is "
      "None.");
  module.def(
      "study_json",
      [](const fs::path& given) {
        return result_of(py::none(), [&](const Watch& watch) { return study_json(store_at(given), watch); });
      },
      py::arg("store"), "The document of a study's store.");
  module.def(
      "study_note",
      [](const fs::path& given) {
        return result_of(py::none(), [&](const Watch&) { return check_study_store(store_at(given)).note; });
      },
      py::arg("store"), "A sentence on a store that has no checksums; empty where it has some.");
}

}  // namespace earthtop::python
