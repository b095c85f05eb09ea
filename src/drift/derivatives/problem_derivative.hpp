// SPDX-License-Identifier: GPL-3.0-or-later
/// Goes through the members of a model together with the derivatives of a problem by an input.
#pragma once

#include <functional>

#include "earthtop/drift/sensitivity.hpp"
#include "earthtop/members.hpp"

namespace earthtop {

/// Stands in place of a derivative: the member changes with no input, or follows from other members.
struct NoDerivative {};

/// The derivatives of a model's members, in the order of the members, as a tuple of references; for a struct that consists of
/// numbers with derivatives of their own, a tuple again.
/// @tparam Derivative  ProblemDerivative, const or not
template <class Derivative>
auto derivatives_of_members(Derivative& derivative) {
  using std::ref;
  auto& [I_BP_B, I_BP_B_inverse, S_BP_B, mass_moment_B, apparent_gravity_L, W_IL_L_scaled, q_LB, w_XB_B, coriolis, centrifugal,
         release, platform, applied, tide, journey, table] =
      derivative;  // three of them are of the release; the journey is added to a recording, and the table is no member of a model
  auto& [rate, acceleration, amplitude, frequency, phase, pivot_offset_P] = platform;
  const NoDerivative none;
  const auto weights = std::make_tuple(ref(coriolis), none, ref(centrifugal));
  const auto turn =
      std::make_tuple(none, none, ref(rate), ref(acceleration), ref(amplitude), ref(frequency), ref(phase), none, none);
  return std::make_tuple(ref(I_BP_B), ref(I_BP_B_inverse), ref(S_BP_B), ref(mass_moment_B), ref(apparent_gravity_L), none,
                         ref(W_IL_L_scaled), none, weights, std::make_tuple(turn, ref(pivot_offset_P)), ref(applied), ref(tide),
                         none, none, none, none, none);
}

namespace problem_derivative_detail {
template <class Take, class Derivatives, class... Structs>
void for_each_pair(const Take& take, const Derivatives& derivatives, Structs&... structs) {
  const auto take_one = [&](auto& derivative, auto&... members) {
    using D = std::remove_const_t<std::remove_reference_t<decltype(derivative)>>;
    if constexpr (requires { std::tuple_size<D>::value; })
      for_each_pair(take, derivative, members...);
    else if constexpr (!std::is_same_v<D, NoDerivative>)
      take(derivative, members...);
  };
  for_each_in_tuples(take_one, derivatives, std::remove_const_t<Structs>::members_of(structs)...);
}
}  // namespace problem_derivative_detail

/// Calls take(derivative, a, b...) for each member of the models that has a derivative: numbers, vectors and matrices, and as a
/// whole the applied torques and the tide.   @param models  of one scalar or of several
template <class Take, class Derivative, class... Models>
void for_each_derivative(const Take& take, Derivative& derivative, Models&... models) {
  problem_derivative_detail::for_each_pair(take, derivatives_of_members(derivative), models...);
}

}  // namespace earthtop
