// SPDX-License-Identifier: GPL-3.0-or-later
/// Commands to be pasted into a shell.
#pragma once

#include <string>
#include <string_view>

namespace earthtop::report {

/// A command whose standard input is a text: a "here document", ended by a line that the text does not have.
inline std::string with_input(std::string_view command, std::string_view text) {
  std::string end = "EOF";
  const std::string lines = '\n' + std::string(text) + '\n';
  while (lines.find('\n' + end + '\n') != lines.npos) end += "_";
  return std::string(command) + " <<'" + end + "'" + lines + end + '\n';
}

}  // namespace earthtop::report
