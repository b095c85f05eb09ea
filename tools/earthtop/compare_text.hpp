// SPDX-License-Identifier: GPL-3.0-or-later
/// A comparison as text for a terminal.
#pragma once

#include <string>

namespace earthtop {
struct CompareReport;
}

namespace earthtop::tool {

/// @param everything  list the quantities that passed of many pairs, too
std::string compare_text(const CompareReport& report, bool everything);

}  // namespace earthtop::tool
