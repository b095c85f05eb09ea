// SPDX-License-Identifier: GPL-3.0-or-later
/// Structs that list their members. What has to go through all members of a struct, as a conversion to another scalar does, takes
/// them from this list; so that a struct with a member that is not in it does not compile wherever it is gone through.
#pragma once

#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

/// Lists the members of the struct in which it stands, all of them and in their order. It is a macro so that each is written once:
/// the names of a structured binding must be as many as the members, and each of these names is also handed on.
#define EARTHTOP_MEMBERS(...)                    \
  template <class Self>                          \
  static constexpr auto members_of(Self& self) { \
    auto& [__VA_ARGS__] = self;                  \
    return std::tie(__VA_ARGS__);                \
  }

namespace earthtop {

/// A struct that lists its members.
template <class S>
concept ListsMembers = requires(S& s) {
  std::remove_const_t<S>::members_of(s);
};

/// Calls take(a, b...) for the first elements of all tuples, then for the second ones, and so on.
template <class Take, class First, class... Others>
constexpr void for_each_in_tuples(const Take& take, const First& first, const Others&... others) {
  static_assert(((std::tuple_size_v<First> == std::tuple_size_v<Others>)&&...),
                "a member has no counterpart in the other list");
  const auto take_at = [&]<std::size_t i>(std::integral_constant<std::size_t, i>) {
    take(std::get<i>(first), std::get<i>(others)...);
  };
  [&]<std::size_t... i>(std::index_sequence<i...>) { (take_at(std::integral_constant<std::size_t, i>()), ...); }
  (std::make_index_sequence<std::tuple_size_v<First>>());
}

/// Calls take(a, b...) for each member of structs that have the same members, over the same scalar or over several.
template <class Take, ListsMembers... Structs>
constexpr void for_each_member(const Take& take, Structs&... structs) {
  for_each_in_tuples(take, std::remove_const_t<Structs>::members_of(structs)...);
}

/// Functions of one name, one for each kind of member: a member of a kind that none of them takes does not compile.
template <class... Functions>
struct ByKind : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
ByKind(Functions...) -> ByKind<Functions...>;

}  // namespace earthtop
