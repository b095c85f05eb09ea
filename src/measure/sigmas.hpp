// SPDX-License-Identifier: GPL-3.0-or-later
/// How sentences write a number of standard errors.
#pragma once

#include <fmt/core.h>

#include <string>

namespace earthtop::measure {

/// "17", "3.4", "0.1".
inline std::string sigmas(double count) {
  if (count < 9.95) return fmt::format("{:.1f}", count);
  return count < 9999.5 ? fmt::format("{:.0f}", count) : fmt::format("{:.1e}", count);
}

}  // namespace earthtop::measure
