// SPDX-License-Identifier: GPL-3.0-or-later
/// Functions that make the entries of the table of summary.json. A value's function is a lambda without a capture, whose type
/// the entry remembers, so that the tables are constants.
#pragma once

#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <type_traits>

#include "earthtop/results/results.hpp"
#include "results/figures.hpp"

namespace earthtop::figure_table {

using Json = nlohmann::ordered_json;
using R = const RunResult&;
using I = std::size_t;

/// A figure is "known at the end" if no row between release and end is needed for it.
inline constexpr KnownFrom kAtEnd = KnownFrom::end, kFromRows = KnownFrom::rows;

/// The value of a member that is left out.
inline const Json kLeftOut = Json(Json::value_t::discarded);

template <class T>
Json json_from(const T& value) {
  return value;
}
template <class T>
Json json_from(const std::optional<T>& value) {
  return value ? Json(*value) : Json();
}

/// A value of the last row whose drift can be trusted; null where there is none.
template <class T>
inline Json reliable(R r, T DriftRow::*member) {
  const DriftRow* row = last_reliable_row(r);
  return row ? Json(row->*member) : Json();
}

template <class Get>
Json value_of(R r, I i) {
  if constexpr (std::is_invocable_v<Get, R, I>)
    return json_from(Get{}(r, i));
  else
    return json_from(Get{}(r));
}

/// Entry of a figure that is compared, or of a word. @param get  gives its value from the result and, for a member of a list's
/// elements, from the element's number
template <class Get>
constexpr SummaryMember compared(std::string_view path, FigureKind kind, FigureScope scope, KnownFrom known, Get,
                                 MemberForm form = MemberForm::value) {
  return {path, form, kind, scope, known, "", value_of<Get>, nullptr, false, false};
}
/// Entry of a member that is not compared. @param why  ends the sentence "It is not compared because ..."
template <class Get>
constexpr SummaryMember told(std::string_view path, KnownFrom known, std::string_view why, Get,
                             MemberForm form = MemberForm::value) {
  return {path, form, FigureKind::not_compared, FigureScope::any, known, why, value_of<Get>, nullptr, false, false};
}
template <class Get>
constexpr SummaryMember work(std::string_view path, Get) {
  return {path, MemberForm::value, FigureKind::cost, FigureScope::any, KnownFrom::rows, "", value_of<Get>, nullptr, false,
          false};
}
/// Entry of an object or a list.
/// @param count  gives 1 for an object, or the number of a list's elements; none where the result has no such member
template <class Count>
constexpr SummaryMember holder(std::string_view path, MemberForm form, Count, bool left_out = false) {
  return {path,
          form,
          FigureKind::not_compared,
          FigureScope::any,
          KnownFrom::end,
          "it only holds other members",
          nullptr,
          [](R r) -> std::optional<std::size_t> { return Count{}(r); },
          left_out,
          false};
}
constexpr SummaryMember object(std::string_view path) {
  return holder(path, MemberForm::object, [](R) { return 1; });
}
/// Entry of an object. @param is_there  whether the result has it; otherwise it is null
template <class IsThere>
constexpr SummaryMember object_or_null(std::string_view path, IsThere) {
  return holder(path, MemberForm::object, [](R r) { return IsThere{}(r) ? std::optional(1) : std::nullopt; });
}
/// The same, but where the result does not have the object the document leaves it out.
template <class IsThere>
constexpr SummaryMember object_or_nothing(std::string_view path, IsThere) {
  return holder(
      path, MemberForm::object, [](R r) { return IsThere{}(r) ? std::optional(1) : std::nullopt; }, true);
}
template <class Count>
constexpr SummaryMember list(std::string_view path, Count count, bool left_out = false) {
  return holder(path, MemberForm::list, count, left_out);
}
constexpr SummaryMember of_rows(SummaryMember member) {
  member.of_rows = true;
  return member;
}

constexpr SummaryMember of_scenario(SummaryMember member) {
  member.of_scenario = true;
  return member;
}

/// Entry of a figure of the end that is a quantity of the last row. @param quantity  the whole quantity's name, as in its columns
constexpr SummaryMember of_last_row(std::string_view quantity, SummaryMember member) {
  member.of_row = quantity;
  return member;
}

/// Entry of a figure of an event. @param time, bound  the members beside it that tell when the event is
constexpr SummaryMember of_event(SummaryMember member, std::string_view time = "t_s", std::string_view bound = "bound_s") {
  member.event_time = time, member.event_bound = bound;
  return member;
}

/// Entry of a figure that may be zero. @param beside  the member beside it that tells how large what it is made of is
constexpr SummaryMember sized_by(std::string_view beside, SummaryMember member) {
  member.sized_by = beside;
  return member;
}

/// Ends of the sentence "It is not compared because ...".
inline constexpr std::string_view kLabel = "it only names what is next to it",
                                  kOfScenario = "it repeats the scenario, whose keys are compared",
                                  kWords = "it says in words what other members say in numbers",
                                  kIsRow = "it belongs to a row, and the rows are compared",
                                  kOfEnds = "it follows from the first and the last row, and the rows are compared",
                                  kTimeOfLargest = "of two nearly equal values either may be the largest",
                                  kIsBounded = "the value that it belongs to is compared",
                                  kIsMarked = "it says which rows are marked, and the marks are compared",
                                  kRowCount = "missing and extra rows are findings of their own",
                                  kDigits = "it repeats a figure that is compared",
                                  kOrigin = "it says where the result comes from",
                                  kHeadline =
                                      "it checks a column or a figure, which is compared itself, against the scenario's number",
                                  kSelected = "the effects modelled are compared",
                                  kRemainder =
                                      "it is the error that rounding and the integration leave in numbers that are compared",
                                  kEffort = "it is the work that the search for a tolerance took";

/// The entries of several tables, one after another.
template <std::size_t... N>
constexpr auto joined(const std::array<SummaryMember, N>&... tables) {
  std::array<SummaryMember, (N + ...)> all{};
  std::size_t at = 0;
  const auto append = [&](const auto& table) {
    for (const SummaryMember& member : table) all[at++] = member;
  };
  (append(tables), ...);
  return all;
}

}  // namespace earthtop::figure_table
