// SPDX-License-Identifier: GPL-3.0-or-later
/// How the BLAS of GSL reports a wrong argument, which is a mistake in this program. Its own report in Debian's archive cannot be linked into
/// a shared library; BLAS lets a program have another one.
#include <cstdlib>
#include <iostream>

extern "C" [[noreturn]] void cblas_xerbla(int argument, const char* function, const char*, ...) {
  std::cerr << "earthtop: argument " << argument << " of " << function << " is wrong\n";
  std::abort();
}
