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

/// The list for the state x and its tangents in K directions: [x, tangent 0, .., tangent K - 1], each with as many components as x.
/// Parameters become numbers.
/// @param by_parameter  for each parameter, in their order, its derivatives in the K directions; as long as all parameters: the
///   derivatives of one after the other
/// @param x  a state with its tangents at which the new list is recorded; the part of x is that at which `operations` were
template <class T>
Operations<T> with_tangents(const Operations<T>& operations, std::size_t directions, std::span<const T> by_parameter,
                            std::span<const T> x, T t);
extern template Operations<double> with_tangents(const Operations<double>&, std::size_t, std::span<const double>,
                                                 std::span<const double>, double);
extern template Operations<long double> with_tangents(const Operations<long double>&, std::size_t, std::span<const long double>,
                                                      std::span<const long double>, long double);
extern template Operations<float128> with_tangents(const Operations<float128>&, std::size_t, std::span<const float128>,
                                                   std::span<const float128>, float128);

}  // namespace earthtop::taylor
