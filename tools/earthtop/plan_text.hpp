// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace earthtop {
struct PlanReport;
}

namespace earthtop::tool {

struct Screen;

/// A plan for the terminal.
std::string plan_text(const PlanReport& report, const Screen& screen);

}  // namespace earthtop::tool
