// SPDX-License-Identifier: GPL-3.0-or-later
/// The vector instructions that points side by side may be integrated with. All give the same bits.
#pragma once

#include <string_view>
#include <vector>

namespace earthtop {

/// baseline: what every processor of its kind has (SSE2 on x86-64).
enum class InstructionSet { baseline, avx2, avx512 };
std::string_view to_string(InstructionSet set);

/// Those that the program is built for and this processor has, the widest last.
std::vector<InstructionSet> instruction_sets();

}  // namespace earthtop
