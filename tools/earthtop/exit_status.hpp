// SPDX-License-Identifier: GPL-3.0-or-later
/// The program's exit status.
#pragma once

#include <string_view>

namespace earthtop::tool {

/// If a signal stopped the work, the status is 128 + signal: kInterrupted is the first of these.
enum ExitStatus : int {
  kDone = 0,
  kNegative = 1,
  kRefused = 2,
  kNumericalFailure = 3,
  kWriteFailed = 4,
  kInterrupted = 129,
  kReaderGone = 141
};

/// A status, or several that mean the same, for help and manual.
struct StatusMeaning {
  ExitStatus status;
  std::string_view shown;
  std::string_view meaning;              ///< of any command
  std::string_view of_a_verb = meaning;  ///< of a verb that states no meaning of its own; empty: it never ends with this status
};

/// All exit statuses of the program.
inline constexpr StatusMeaning kExitStatuses[] = {
    {kDone, "0", "done; a verdict on a drift is no failure, whatever it is", "done"},
    {kNegative, "1",
     "done, and the answer is no: check found errors, verify found a criterion that is not met, compare found a difference, a "
     "planned measurement would not determine its numbers, or points of a study failed or are missing",
     ""},
    {kRefused, "2", "the command line or an input was refused; nothing was written", "the command line was refused"},
    {kNumericalFailure, "3",
     "a numerical failure, which is named, and the rows before it are kept; or the accuracy asked for was not reached; or "
     "memory or threads ran out",
     "memory ran out"},
    {kWriteFailed, "4", "writing failed, or reading an input broke off; if only standard output failed, the results are whole",
     "writing to standard output failed"},
    {kInterrupted, "129, 130, 143", "interrupted by SIGHUP, SIGINT or SIGTERM"},
    {kReaderGone, "141", "standard output was closed when there was more to print"},
};

}  // namespace earthtop::tool
