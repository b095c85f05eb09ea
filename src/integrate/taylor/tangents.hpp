// SPDX-License-Identifier: GPL-3.0-or-later
/// A recorded right-hand side together with its derivatives in some directions: the tangents of the motion, which say how it
/// changes with its initial state and with its parameters.
///
/// The list is gone through once more, and each of its operations is written down with the derivatives of its result, by the rule
/// of its kind. So no equation needs variational equations of its own.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "earthtop/real.hpp"
#include "integrate/taylor/operations.hpp"

namespace earthtop::taylor {

/// The list for a state with its tangents, [motion, tangent 0, tangent 1, ..], each with as many components as the motion.
/// Parameters become numbers.
/// @param directions  number of tangents that are followed; those after them, for which there is room, stay as they are
/// @param by_parameter  for each parameter, in their order, its derivatives in all directions for which there is room
/// @param x  the state with its tangents at which the new list is recorded; its motion is that at which `operations` were
template <class T>
Operations<T> with_tangents(const Operations<T>& operations, std::size_t directions, std::span<const T> by_parameter,
                            std::span<const T> x, T t);
extern template Operations<double> with_tangents(const Operations<double>&, std::size_t, std::span<const double>,
                                                 std::span<const double>, double);
extern template Operations<float80> with_tangents(const Operations<float80>&, std::size_t, std::span<const float80>,
                                                  std::span<const float80>, float80);
extern template Operations<float128> with_tangents(const Operations<float128>&, std::size_t, std::span<const float128>,
                                                   std::span<const float128>, float128);

}  // namespace earthtop::taylor
