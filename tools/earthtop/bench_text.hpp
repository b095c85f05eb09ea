// SPDX-License-Identifier: GPL-3.0-or-later
/// What `earthtop bench` prints.
#pragma once

#include <string>

namespace earthtop {
struct BenchReport;
}

namespace earthtop::tool {

/// The table of one scenario, and what each family of methods costs at equal error.
/// @param brief  of the table only the Pareto front, and what `auto` takes
std::string bench_text(const BenchReport& report, bool brief);

}  // namespace earthtop::tool
