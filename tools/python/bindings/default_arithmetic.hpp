// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cfenv>

namespace earthtop::python {

/// While it lives, the thread rounds to nearest, keeps subnormal numbers and all digits of long double, and traps nothing. Other
/// libraries in the process may have changed that: those compiled with -ffast-math do so in the thread that loads them, and new
/// threads inherit it.
class DefaultArithmetic {
 public:
  DefaultArithmetic() {
    std::fegetenv(&before_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~DefaultArithmetic() { std::fesetenv(&before_); }
  DefaultArithmetic(const DefaultArithmetic&) = delete;
  DefaultArithmetic& operator=(const DefaultArithmetic&) = delete;

 private:
  std::fenv_t before_{};
};

}  // namespace earthtop::python
