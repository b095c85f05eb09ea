// SPDX-License-Identifier: GPL-3.0-or-later
/// The screen that standard output is written on: how wide it is, and whether it shows colours.
#pragma once

#include <cstddef>

namespace earthtop::tool {

struct Screen {
  std::size_t width = 80;  ///< columns that a line of prose may take
  bool color = false;
};

/// The width of prose: the valid one of COLUMNS, else the terminal's, else 80; never below 40, nor above 120, where long lines
/// become hard to read.
/// @param variable the value of COLUMNS; null if it is not set   @param terminal columns of the terminal; 0 if there is none
std::size_t prose_width(const char* variable, std::size_t terminal);

/// The screen, or the file, that standard output goes to.
Screen output_screen();

}  // namespace earthtop::tool
