// SPDX-License-Identifier: GPL-3.0-or-later
/// Formats the result of a run for a terminal.
#pragma once

#include <string>
#include <string_view>

namespace earthtop {
struct RunResult;
}

namespace earthtop::tool {

struct Screen;

/// Where a run was written.
struct Written {
  std::string directory;
  std::string taken;  ///< the directory where it would have been written if that had not held other results; empty: the same
};

/// Everything that is known of a run.
/// @param changed the scenario differs from its file, so that a headline figure that is not met says nothing about the program
/// @param picture  lines that stand before the last ones
std::string summary_text(const RunResult& result, const Written& where, bool changed, const Screen& screen,
                         std::string_view picture = "");

/// The short text says what drifts, how surely that is known, why, and what to do next: as a screen of 24 lines shows it, of explanations as many as fit.
/// Nothing that warns is left out. The arguments are those of summary_text.
std::string brief_text(const RunResult& result, const Written& where, bool changed, const Screen& screen,
                       std::string_view picture = "");

}  // namespace earthtop::tool
