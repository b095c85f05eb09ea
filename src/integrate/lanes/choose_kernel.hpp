// SPDX-License-Identifier: GPL-3.0-or-later
/// Chooses the kernel for an instruction set.
#pragma once

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "earthtop/integrate/instruction_set.hpp"
#include "integrate/lanes/block.hpp"

namespace earthtop::lanes {

/// The instruction set that was asked for, or the widest that there is.
/// @throws std::logic_error for one that this processor or program does not have
inline InstructionSet available(std::optional<InstructionSet> asked) {
  static const std::vector<InstructionSet> sets = instruction_sets();
  if (!asked) return sets.back();
  if (std::find(sets.begin(), sets.end(), *asked) == sets.end())
    throw std::logic_error("no instructions of this kind: " + std::string(to_string(*asked)));
  return *asked;
}

/// How many doubles the vectors of a kernel have.
inline int width_of(InstructionSet set) { return set == InstructionSet::avx512 ? 8 : set == InstructionSet::avx2 ? 4 : 2; }

}  // namespace earthtop::lanes

/// The kernel `name` for an instruction set: `name`_baseline, `name`_avx2 or `name`_avx512. A macro, since it joins names, and since
/// a program that was not built for wide lanes has only the first of them.
#ifdef EARTHTOP_WIDE_LANES
#define EARTHTOP_CHOOSE_KERNEL(set, name)                      \
  ((set) == ::earthtop::InstructionSet::avx512 ? name##_avx512 \
   : (set) == ::earthtop::InstructionSet::avx2 ? name##_avx2   \
                                               : name##_baseline)
#else
#define EARTHTOP_CHOOSE_KERNEL(set, name) ((void)(set), name##_baseline)
#endif
