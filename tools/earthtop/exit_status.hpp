// SPDX-License-Identifier: GPL-3.0-or-later
/// The program's exit status.
#pragma once

namespace earthtop::tool {

/// If a signal stopped the work, the status is 128 + signal.
enum ExitStatus : int { kDone = 0, kNegative = 1, kRefused = 2, kNumericalFailure = 3, kWriteFailed = 4, kReaderGone = 141 };

struct StatusMeaning {
  int status;
  const char* meaning;
};

/// All exit statuses, for the manual.
inline constexpr StatusMeaning kExitStatuses[] = {
    {kDone, "done"},
    {kNegative,
     "done, and the answer is no: check found errors, verify a criterion that is not met, compare a difference, or points of a "
     "study failed or are missing"},
    {kRefused, "the input or the command line was refused; nothing was written"},
    {kNumericalFailure, "a numerical failure, which is named, the rows before it being kept; or out of memory"},
    {kWriteFailed, "writing failed, or reading an input broke off; if only standard output failed, the results are whole"},
    {129, "interrupted by SIGHUP"},
    {130, "interrupted by SIGINT"},
    {kReaderGone, "standard output was closed when there was more to print"},
    {143, "interrupted by SIGTERM"},
};

}  // namespace earthtop::tool
