// SPDX-License-Identifier: GPL-3.0-or-later
/// GSL calls `abort` where something is wrong, unless told otherwise.
#pragma once

#include <gsl/gsl_errno.h>

namespace earthtop {

/// GSL's errors are returned, not fatal, as long as this lives.
class ReturnedGslErrors {
 public:
  ReturnedGslErrors() : before_(gsl_set_error_handler_off()) {}
  ~ReturnedGslErrors() { gsl_set_error_handler(before_); }
  ReturnedGslErrors(const ReturnedGslErrors&) = delete;
  ReturnedGslErrors& operator=(const ReturnedGslErrors&) = delete;

 private:
  gsl_error_handler_t* before_;
};

}  // namespace earthtop
