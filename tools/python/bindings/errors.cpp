// SPDX-License-Identifier: GPL-3.0-or-later
#include "errors.hpp"

#include <filesystem>
#include <new>
#include <stdexcept>

#include "bindings.hpp"
#include "earthtop/arithmetic.hpp"

namespace earthtop::python {
namespace {

/// Raises the exception that a class or function of that name in earthtop._errors makes from these arguments.
template <class... Arguments>
void raise(const char* name, const Arguments&... arguments) {
  const py::object exception = py::module_::import("earthtop._errors").attr(name)(arguments...);
  PyErr_SetObject(py::type::of(exception).ptr(), exception.ptr());
}

py::object known(int number) { return number > 0 ? py::object(py::int_(number)) : py::none(); }

}  // namespace

py::list findings(const std::string& file, const std::vector<Diagnostic>& diagnostics) {
  py::list list;
  for (const Diagnostic& one : diagnostics)
    list.append(
        py::make_tuple(file, known(one.line), known(one.column), one.pointer, one.message, format_diagnostic(file, one)));
  return list;
}

void bind_errors(py::module_&) {
  py::register_local_exception_translator([](std::exception_ptr pointer) {  // NOLINT: pybind11 asks for a copy
    try {
      if (pointer) std::rethrow_exception(pointer);
    } catch (const ScenarioError& error) {
      raise("refused", findings(error.file(), error.diagnostics()));
    } catch (const FileError& error) {
      raise("file_failed", error.file(), error.reason());
    } catch (const ArithmeticError& error) {
      raise("ArithmeticError", std::string(error.what()));
    } catch (const std::filesystem::filesystem_error& error) {
      raise("file_failed", error.path1().string(), error.code().message());
    } catch (const std::bad_alloc& error) {
      PyErr_SetString(PyExc_MemoryError, plain_words(error).c_str());
    } catch (const py::builtin_exception&) {  // the following are left to pybind11
      throw;
    } catch (const py::error_already_set&) {
      throw;
    } catch (const std::invalid_argument&) {
      throw;
    } catch (const std::exception& error) {
      PyErr_SetString(PyExc_RuntimeError, plain_words(error).c_str());
    }
  });
}

}  // namespace earthtop::python
