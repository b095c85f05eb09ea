// SPDX-License-Identifier: GPL-3.0-or-later
// A library to be preloaded: begins a program with x87's control word and MXCSR changed as PROCESSOR_STATE says,
// "SET_X87 CLEAR_X87 SET_MXCSR CLEAR_MXCSR" in decimal. A program that is started has the system's state; only a library that it
// loads can change that before `main`.
#include <fpu_control.h>
#include <xmmintrin.h>

#include <cstdio>
#include <cstdlib>

__attribute__((constructor)) static void change_state() {
  const char* const text = std::getenv("PROCESSOR_STATE");
  unsigned set_x87 = 0, clear_x87 = 0, set_mxcsr = 0, clear_mxcsr = 0;
  if (text == nullptr || std::sscanf(text, "%u %u %u %u", &set_x87, &clear_x87, &set_mxcsr, &clear_mxcsr) != 4) return;
  fpu_control_t word = 0;
  _FPU_GETCW(word);
  word = static_cast<fpu_control_t>((word & ~clear_x87) | set_x87);
  _FPU_SETCW(word);
  _mm_setcsr((_mm_getcsr() & ~clear_mxcsr) | set_mxcsr);
}
