// SPDX-License-Identifier: GPL-3.0-or-later
/// Formats the output of `earthtop bench`.
#pragma once

#include <string>

namespace earthtop {
struct BenchReport;
}

namespace earthtop::tool {

/// The table of one scenario, and the cost of each family of methods at equal error.
/// @param brief list only the methods on the Pareto front and the one that `auto` chooses
std::string bench_text(const BenchReport& report, bool brief, std::size_t width);

}  // namespace earthtop::tool
