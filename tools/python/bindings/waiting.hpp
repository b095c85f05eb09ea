// SPDX-License-Identifier: GPL-3.0-or-later
/// Long work called from Python: it runs in a thread of its own, without the interpreter's lock, while the calling thread answers
/// Ctrl-C and tells the progress.
#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <optional>

#include "earthtop/watch.hpp"

namespace earthtop::python {

/// Does the work and returns when it has ended. Signals are checked every 20 ms: if a handler raises, the work is asked to stop,
/// and the exception is passed on once it has stopped.
/// @param on_progress  Python callable that takes the share done (0 to 1) and the phase, called about ten times a second and
/// once at the end; or None
/// @param work  is called once, in another thread, with the arithmetic that IEEE 754 has by default
/// @throws what the work throws; error_already_set from a signal handler or `on_progress`
void wait_for(const pybind11::object& on_progress, const std::function<void(const Watch&)>& work);

/// The same for work that returns something.
template <class Work>
auto result_of(const pybind11::object& on_progress, const Work& work) {
  std::optional<decltype(work(Watch()))> result;
  wait_for(on_progress, [&](const Watch& watch) { result.emplace(work(watch)); });
  return *std::move(result);
}

}  // namespace earthtop::python
