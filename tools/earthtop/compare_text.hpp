// SPDX-License-Identifier: GPL-3.0-or-later
/// Formats a comparison for a terminal.
#pragma once

#include <string>

namespace earthtop {
struct CompareReport;
struct EngineFit;
}  // namespace earthtop

namespace earthtop::tool {

struct Screen;

/// @param everything also list the quantities that passed when many pairs are compared
std::string compare_text(const CompareReport& report, bool everything, const Screen& screen);

std::string engine_fit_text(const EngineFit& fit, const Screen& screen);

}  // namespace earthtop::tool
