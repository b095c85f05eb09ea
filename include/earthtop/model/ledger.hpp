/// The torque ledger: every torque that an observer counts, beside the change of the angular momentum that it sees.
#pragma once

#include <string_view>

namespace earthtop {

/// Whose torques a ledger lists: the frame that counts them, in its own axes.
enum class LedgerObserver { inertial, laboratory, platform, body };

std::string_view to_string(LedgerObserver observer);

}  // namespace earthtop
