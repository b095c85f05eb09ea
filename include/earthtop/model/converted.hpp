// SPDX-License-Identifier: GPL-3.0-or-later
/// Coefficients over another scalar: in another precision, as pairs, as jets, or as numbers that record what is computed with them.
/// All members of a struct go over (members.hpp), and those of the structs in it.
#pragma once

#include "earthtop/members.hpp"
#include "earthtop/vectors.hpp"

namespace earthtop {

/// Sets `made` to the same coefficients over another scalar.
/// @param from  a number, a vector or a matrix, a struct that lists its members, an array or a vector of these, or a function of time
/// @param to  gives a number, or a function of time, over the other scalar
template <class From, class Made, class To>
void convert(const From& from, Made& made, const To& to) {
  if constexpr (std::is_integral_v<From> || std::is_enum_v<From>) {
    made = from;  // no coefficient: a flag, a word, the number of an axis
  } else if constexpr (ListsMembers<From>) {
    for_each_member([&](const auto& member, auto& member_made) { convert(member, member_made, to); }, from, made);
  } else if constexpr (std::is_base_of_v<Eigen::MatrixBase<From>, From>) {
    for (int i = 0; i < from.rows(); ++i)
      for (int j = 0; j < from.cols(); ++j) made(i, j) = to(from(i, j));
  } else if constexpr (requires { from.begin(); }) {
    if constexpr (requires { made.resize(from.size()); }) made.resize(from.size());
    for (std::size_t i = 0; i < from.size(); ++i) convert(from[i], made[i], to);
  } else {
    made = to(from);
  }
}

/// Calls take(x, y...) for each number of structs that list the same members, over the same scalar or over several. Flags and
/// words are left out.
template <class Take, class First, class... Others>
void for_each_number(const Take& take, First& first, Others&... others) {
  using Kind = std::remove_const_t<First>;
  if constexpr (ListsMembers<Kind>) {
    for_each_member([&](auto&... members) { for_each_number(take, members...); }, first, others...);
  } else if constexpr (std::is_base_of_v<Eigen::MatrixBase<Kind>, Kind>) {
    for (int i = 0; i < first.rows(); ++i)
      for (int j = 0; j < first.cols(); ++j) take(first(i, j), others(i, j)...);
  } else if constexpr (!std::is_integral_v<Kind> && !std::is_enum_v<Kind>) {
    take(first, others...);
  }
}

/// The same struct over the scalar S.   @param to  as above
template <class S, template <class> class Struct, class T, class To>
Struct<S> converted(const Struct<T>& from, const To& to) {
  Struct<S> made;
  convert(from, made, to);
  return made;
}

}  // namespace earthtop
