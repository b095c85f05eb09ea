// SPDX-License-Identifier: GPL-3.0-or-later
/// Signals that ask the program to stop.
#pragma once

#include <atomic>

namespace earthtop::tool {

/// From now on SIGINT, SIGTERM and SIGHUP end the program with status 128 + signal, whatever it does: at once, without a
/// temporary file left, but for the moment in which results are put in place. @param json  how errors are told
void install_stop_handlers(bool json);

/// What the first signal sets: for the watch of the work that is to stop then.
const std::atomic<bool>* stop_flag() noexcept;

/// While it lives, the first signal asks the work to stop, which then says how far it came. For that it has a tenth of a second
/// of processor time. When that is used up, and where the work does nothing at all, the program ends as it does elsewhere.
class OrderlyEnd {
 public:
  /// @param keeps  whether what is there then is to be kept: a million rows take longer to put together
  explicit OrderlyEnd(bool keeps = false);
  ~OrderlyEnd();
  OrderlyEnd(const OrderlyEnd&) = delete;
  OrderlyEnd& operator=(const OrderlyEnd&) = delete;
};

/// After a signal: what is there is to be kept, and may take its time. Another signal still ends the program at once.
void keep_what_is_there();

/// 128 + the signal that came.
int interrupted_status();

}  // namespace earthtop::tool
