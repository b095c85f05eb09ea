// SPDX-License-Identifier: GPL-3.0-or-later
/// The shape of a state with its tangents (tangents.hpp), by which the steps of its series are controlled.
#pragma once

#include "integrate/group_norms.hpp"

namespace earthtop::taylor {

/// The motion, then a tangent in each direction. A tangent has the groups of the motion.
/// @tparam Shape  of the motion, or of a state that begins with it   @tparam kMotion  number of the motion's components
/// @tparam kLeastScale  the least size against which the error of a tangent's group is measured, by that of the motion's group
template <class Shape, std::size_t kMotion, std::size_t kDirections, double (*kLeastScale)(double)>
struct TangentShape {
  static constexpr std::size_t kSize = (1 + kDirections) * kMotion;
  static constexpr std::size_t kOwnGroups = [] {
    std::size_t count = 0;
    for (const ComponentGroup& group : Shape::groups()) count += group.begin < kMotion ? 1U : 0U;
    return count;
  }();
  static constexpr auto groups() {
    constexpr auto own = Shape::groups();
    std::array<ComponentGroup, (1 + kDirections) * kOwnGroups> all{};
    for (std::size_t slot = 0; slot <= kDirections; ++slot)
      for (std::size_t g = 0; g < kOwnGroups; ++g)
        all[slot * kOwnGroups + g] = {slot * kMotion + own[g].begin, own[g].count,
                                      slot == 0 ? own[g].least_scale : kLeastScale(own[g].least_scale)};
    return all;
  }
};

}  // namespace earthtop::taylor
