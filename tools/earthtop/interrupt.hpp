/// Signals that ask the work to stop.
#pragma once

namespace earthtop::tool {

/// From now on the first SIGINT, SIGTERM or SIGHUP asks the run to stop, which takes well under a second. Another one ends the
/// program at once, but for the moment in which results are put in place.
void install_stop_handlers();

/// 128 + the signal that came.
int interrupted_status();

}  // namespace earthtop::tool
