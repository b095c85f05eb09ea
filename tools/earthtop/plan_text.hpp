// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace earthtop {
struct PlanReport;
}

namespace earthtop::tool {

/// A plan for the terminal.
std::string plan_text(const PlanReport& report, bool color);

}  // namespace earthtop::tool
