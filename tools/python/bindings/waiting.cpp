// SPDX-License-Identifier: GPL-3.0-or-later
#include "waiting.hpp"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "default_arithmetic.hpp"

namespace earthtop::python {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

/// A thread that does the work. It is always joined, and asked to stop if it must be joined early.
class Worker {
 public:
  explicit Worker(const std::function<void(const Watch&)>& work) : thread_([this, &work] { run(work); }) {}
  ~Worker() {
    stop_ = true;
    if (thread_.joinable()) {
      const pybind11::gil_scoped_release released;
      thread_.join();
    }
  }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// Waits without the interpreter's lock. @returns whether the work has ended
  bool has_ended_within(milliseconds time) {
    const pybind11::gil_scoped_release released;
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, time, [this] { return ended_; });
  }
  const Progress& progress() const { return progress_; }
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  void run(const std::function<void(const Watch&)>& work) {
    const DefaultArithmetic arithmetic;
    try {
      work(Watch(&stop_, &progress_));
    } catch (...) {
      error_ = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    ended_ = true;
    changed_.notify_all();
  }

  std::atomic<bool> stop_ = false;
  Progress progress_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool ended_ = false;
  std::exception_ptr error_;
  std::thread thread_;  // the last, because it uses the others
};

}  // namespace

void wait_for(const pybind11::object& on_progress, const std::function<void(const Watch&)>& work) {
  constexpr milliseconds kLook(20), kTell(100);
  Worker worker(work);
  auto told = steady_clock::now();
  while (!worker.has_ended_within(kLook)) {
    if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
    if (on_progress.is_none() || steady_clock::now() - told < kTell) continue;
    told = steady_clock::now();
    on_progress(worker.progress().share(), worker.progress().phase());
  }
  worker.rethrow();
  if (!on_progress.is_none()) on_progress(worker.progress().share(), worker.progress().phase());
}

}  // namespace earthtop::python
