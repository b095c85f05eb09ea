// SPDX-License-Identifier: GPL-3.0-or-later
/// Handling of the signals that ask the program to stop.
#pragma once

#include <atomic>

namespace earthtop::tool {

/// Installs handlers after which SIGINT, SIGTERM and SIGHUP end the program at once, with status 128 + signal and without
/// leaving temporary files; only the moment in which results are moved into place is not interrupted.
/// @param json report the interruption as JSON
void install_stop_handlers(bool json);

/// The flag that the first signal sets during an OrderlyEnd; to be given to the Watch of the work.
const std::atomic<bool>* stop_flag() noexcept;

/// While an object of this class lives, the first signal only asks the work to stop, so that it can report how far it came. The
/// work has a tenth of a second of processor time for that; after it, or if the work does nothing at all, the program ends at
/// once.
class OrderlyEnd {
 public:
  /// @param keeps what has been computed will be kept: there is no limit on the time, as a million rows take longer to put
  /// together
  explicit OrderlyEnd(bool keeps = false);
  ~OrderlyEnd();
  OrderlyEnd(const OrderlyEnd&) = delete;
  OrderlyEnd& operator=(const OrderlyEnd&) = delete;
};

/// Lifts the time limit after a signal, so that what has been computed can be kept. Another signal still ends the program at
/// once.
void lift_time_limit();

/// 128 + the signal that was received.
int interrupted_status();

/// Reports that nothing is kept of a command that was interrupted. @returns interrupted_status()
int report_interruption(bool json);

}  // namespace earthtop::tool
