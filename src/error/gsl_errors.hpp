// SPDX-License-Identifier: GPL-3.0-or-later
/// Stops GSL from calling `abort` on errors, which is its default.
#pragma once

#include <gsl/gsl_errno.h>

#include <mutex>
#include <new>

namespace earthtop {

/// The object that a GSL function has allocated. @throws std::bad_alloc if there was no memory for it
template <class T>
T* allocated(T* object) {
  if (object == nullptr) throw std::bad_alloc();
  return object;
}

/// While an object of this class lives, GSL functions return their errors instead of aborting. The process has one handler for
/// all its threads: the first object puts it off, and the last one restores it.
class ReturnedGslErrors {
 public:
  ReturnedGslErrors() {
    const std::lock_guard lock(mutex_);
    if (objects_++ == 0) before_ = gsl_set_error_handler_off();
  }
  ~ReturnedGslErrors() {
    const std::lock_guard lock(mutex_);
    if (--objects_ == 0) gsl_set_error_handler(before_);
  }
  ReturnedGslErrors(const ReturnedGslErrors&) = delete;
  ReturnedGslErrors& operator=(const ReturnedGslErrors&) = delete;

 private:
  inline static std::mutex mutex_;
  inline static int objects_ = 0;
  inline static gsl_error_handler_t* before_ = nullptr;
};

}  // namespace earthtop
