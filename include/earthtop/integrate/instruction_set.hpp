// SPDX-License-Identifier: GPL-3.0-or-later
/// The vector instruction sets with which many points can be integrated side by side (motion_lanes.hpp, drift_lanes.hpp). All
/// of them give the same results, to the last bit.
#pragma once

#include <string_view>
#include <vector>

namespace earthtop {

/// `baseline` is what every processor of the architecture has (SSE2 on x86-64).
enum class InstructionSet { baseline, avx2, avx512 };
std::string_view to_string(InstructionSet set);

/// The instruction sets that the program was built for and that this processor has, the widest last.
std::vector<InstructionSet> instruction_sets();

}  // namespace earthtop
