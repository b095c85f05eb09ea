// SPDX-License-Identifier: GPL-3.0-or-later
#include "screen.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <string_view>

#include "output.hpp"

namespace earthtop::tool {
namespace {

/// The number that a text consists of; 0 for any other text.
std::size_t whole_number(std::string_view text) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? number : 0;
}

std::size_t terminal_columns() {
  winsize size{};
  return ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

}  // namespace

std::size_t prose_width(const char* variable, std::size_t terminal) {
  constexpr std::size_t kUnknown = 80, kLeast = 40, kMost = 120;
  const std::size_t wanted = variable != nullptr ? whole_number(variable) : 0;
  const std::size_t width = wanted > 0 ? wanted : terminal > 0 ? terminal : kUnknown;
  return std::clamp(width, kLeast, kMost);
}

Screen output_screen() { return {prose_width(std::getenv("COLUMNS"), terminal_columns()), wants_color()}; }

}  // namespace earthtop::tool
