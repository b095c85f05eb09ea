// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/results/results.hpp"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <memory>

#include "bindings.hpp"
#include "default_arithmetic.hpp"
#include "earthtop/results/output_files.hpp"
#include "earthtop/results/row_arrays.hpp"
#include "earthtop/run.hpp"
#include "waiting.hpp"

namespace earthtop::python {
namespace {

using SharedResult = std::shared_ptr<const RunResult>;

/// A capsule that owns something as long as arrays refer to its memory.
template <class Owned>
py::capsule keeper(Owned owned) {
  auto* kept = new Owned(std::move(owned));
  return py::capsule(kept, [](void* memory) { delete static_cast<Owned*>(memory); });
}

py::array read_only(py::array array) {
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// An array of shape (rows) or (rows, components) over numbers in memory. @param owner  keeps the memory alive
template <class Number>
py::array view(const RowArray& array, const Number* first, py::ssize_t stride, const py::capsule& owner) {
  const auto rows = static_cast<py::ssize_t>(array.rows), width = static_cast<py::ssize_t>(array.width());
  std::vector<py::ssize_t> shape = {rows}, strides = {stride};
  if (!array.components.empty()) {
    shape.push_back(width);
    strides.push_back(sizeof(Number));
  }
  return read_only(py::array(py::dtype::of<Number>(), shape, strides, first, owner));
}

py::array array_of(RowArray&& array, const py::capsule& result) {
  if (array.first != nullptr || array.rows == 0) return view(array, array.first, array.stride_bytes, result);
  const py::capsule owner = keeper(std::move(array));
  const auto& kept = *owner.get_pointer<RowArray>();
  if (kept.places.empty()) {
    const auto stride = static_cast<py::ssize_t>(kept.width() * sizeof(double));
    return view(kept, kept.copied.data(), stride, owner);
  }
  py::array places = view(kept, kept.places.data(), 1, owner);
  return kept.words.empty() ? places.attr("view")("bool") : std::move(places);
}

/// Describes the arrays: list of (name, array, meaning, columns, words).
py::list described(std::vector<RowArray>&& arrays, const SharedResult& result) {
  const py::capsule owner = keeper(result);
  py::list list;
  for (RowArray& array : arrays) {
    const py::tuple columns = py::cast(array.columns);
    const std::string name = array.name;
    const std::string_view meaning = array.meaning, words = array.words;
    list.append(py::make_tuple(name, array_of(std::move(array), owner), meaning, columns, words));
  }
  return list;
}

/// Describes all arrays that there can be: list of (name, components, meaning, columns, words, whether it is a flag).
py::list kinds(const std::vector<RowArray>& arrays) {
  py::list list;
  for (const RowArray& array : arrays)
    list.append(py::make_tuple(array.name, array.components, array.meaning, py::tuple(py::cast(array.columns)), array.words,
                               array.is_flag));
  return list;
}

/// A function that makes something of a result, with default arithmetic.
template <class Make>
auto made_of(Make make) {
  return [make](const std::shared_ptr<RunResult>& self) {
    const DefaultArithmetic arithmetic;
    return make(*self);
  };
}

}  // namespace

void bind_results(py::module_& module) {
  using Class = py::class_<RunResult, std::shared_ptr<RunResult>>;
  using Self = const std::shared_ptr<RunResult>&;
  Class(module, "RunResult", "What a run returns.")
      .def("row_arrays", [](Self self) { return described(made_of(row_arrays)(self), self); })
      .def("look_arrays", [](Self self) { return described(made_of(look_arrays)(self), self); })
      .def_property_readonly("looks_a_window", [](Self self) { return self->looks_a_window; })
      .def("torque_arrays", [](Self self) { return described(made_of(torque_arrays)(self), self); })
      .def("summary_json", made_of(summary_json))
      .def("timing_json", made_of(timing_json))
      .def("drift_svg", made_of([](const RunResult& result) { return svg(drift_figure(result)); }))
      .def("trajectory_csv", made_of(trajectory_csv))
      .def("torques_csv",
           [](Self self) -> py::object { return self->ledger ? py::object(py::str(made_of(torques_csv)(self))) : py::none(); })
      .def("write", [](Self self, const std::filesystem::path& dir, bool force) {
        wait_for(py::none(), [&](const Watch& watch) { write_results(*self, dir, force, watch); });
      });
  module.def("row_array_kinds", [] { return kinds(row_array_kinds()); });
  module.def("torque_array_kinds", [] { return kinds(torque_array_kinds()); });
  module.def(
      "read_result_texts",
      [](const std::filesystem::path& directory) {
        std::vector<std::string> notes;
        ResultTexts texts = read_result_texts(directory, &notes);
        return py::make_tuple(std::move(texts), std::move(notes));
      },
      py::arg("directory"), "The files of results: (texts by names, notes on what could not be verified).");
  module.def("write_result_texts", [](const ResultTexts& texts, const Scene& scene, const std::filesystem::path& dir,
                                      bool force) { write_results(texts, scene, dir, force); });
  py::enum_<OutputKind>(module, "OutputKind")
      .value("page", OutputKind::page)
      .value("page_picture", OutputKind::page_picture)
      .value("document", OutputKind::document)
      .value("scenario", OutputKind::scenario);
  module.def(
      "write_files",
      [](const std::vector<std::tuple<OutputKind, std::string, std::string>>& given, const std::vector<std::string>& inputs,
         bool force) {
        OutputFiles files({}, inputs, force);
        for (const auto& [kind, path, content] : given) files.add({kind, path}, content);
        files.commit();
      },
      py::arg("files"), py::arg("inputs"), py::arg("force"),
      "Writes files (kind, path, content), all or none; one that is there and that earthtop did not write needs force.");
  module.def(
      "run",
      [](const Scene& scene, unsigned jobs, const py::object& on_progress) {
        return result_of(on_progress, [&](const Watch& watch) {
          return std::make_shared<RunResult>(run(scene, {watch, false, jobs}));
        });
      },
      py::arg("scene"), py::arg("jobs"), py::arg("on_progress"));
}

}  // namespace earthtop::python
