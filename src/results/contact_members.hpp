// SPDX-License-Identifier: GPL-3.0-or-later
/// The members of summary.json about the contact of a top with its table: its events, how far the prediction itself moves with
/// its inputs, and the balances of both predictions.
#pragma once

#include <algorithm>
#include <string_view>

#include "results/member_entries.hpp"
#include "text/number_words.hpp"

namespace earthtop::figure_table {

inline std::string_view to_event_word(Prediction prediction) {
  return prediction == Prediction::rotating ? "rotating" : "reference";
}
inline const ContactEvent& event(R r, I i) { return r.contact->events[i]; }
inline const PredictionChange& change(R r, I i) { return r.contact->changes[i]; }

inline std::optional<double> over_size(const ContactBalance& balance) { return share_of(balance.balance, balance.size); }

/// A text as a template's argument.
template <std::size_t N>
struct FixedText {
  char text[N]{};
  constexpr FixedText(const char (&given)[N]) { std::copy_n(given, N, text); }
  constexpr std::string_view view() const { return {text, N - 1}; }
};
/// Texts one after another, as a constant that lasts.
template <FixedText... parts>
struct Path {
  static constexpr auto kText = [] {
    std::array<char, (parts.view().size() + ...)> text{};
    auto at = text.begin();
    ((at = std::copy(parts.view().begin(), parts.view().end(), at)), ...);
    return text;
  }();
  static constexpr std::string_view kView{kText.data(), kText.size()};
};

inline constexpr auto kContactMembers = [] {
  using enum FigureKind;
  using enum FigureScope;
  return std::array{
      object_or_nothing("contact", [](R r) { return r.contact.has_value(); }),
      list("contact.events", [](R r) { return r.contact->events.size(); }),
      of_event(
          compared("contact.events.*.event", outcome, at_event, kAtEnd, [](R r, I i) { return to_string(event(r, i).kind); })),
      of_event(compared("contact.events.*.t_s", event_time, at_event, kAtEnd, [](R r, I i) { return event(r, i).t_s; })),
      of_event(compared("contact.events.*.bound_s", error, at_event, kAtEnd, [](R r, I i) { return event(r, i).bound_s; })),
      of_event(compared("contact.events.*.prediction", word, at_event, kAtEnd,
                        [](R r, I i) { return to_event_word(event(r, i).prediction); })),
      of_event(compared("contact.events.*.time_difference_s", derived, at_event, kAtEnd,
                        [](R r, I i) { return event(r, i).time_difference_s; })),
      list("contact.prediction_changes", [](R r) { return r.contact->changes.size(); }),
      compared("contact.prediction_changes.*.input", word, end, kAtEnd, [](R r, I i) { return change(r, i).input; }),
      compared("contact.prediction_changes.*.step", word, end, kAtEnd, [](R r, I i) { return change(r, i).step; }),
      compared("contact.prediction_changes.*.axis_rad", derived, end, kAtEnd, [](R r, I i) { return change(r, i).axis_rad; }),
      compared("contact.prediction_changes.*.tip_m", derived, end, kAtEnd, [](R r, I i) { return change(r, i).tip_m; }),
      compared("contact.prediction_changes.*.at_s", input, end, kAtEnd, [](R r, I) { return r.contact->at_s; }),
  };
}();

/// The balance of Jellett's integral in one prediction: the integral at both ends, and what changes it.
template <FixedText prediction, ContactBalances ContactReport::*of>
constexpr auto jellett_members() {
  using enum FigureKind;
  using enum FigureScope;
  constexpr FixedText kJellett = "contact.jellett.";
  return std::array{
      object(Path<kJellett, prediction>::kView),
      compared(Path<kJellett, prediction, ".first_kg_m3_s">::kView, derived, any, kAtEnd,
               [](R r) { return ((*r.contact).*of).jellett->first; }),
      compared(Path<kJellett, prediction, ".last_kg_m3_s">::kView, derived, end, kAtEnd,
               [](R r) { return ((*r.contact).*of).jellett->last; }),
      compared(Path<kJellett, prediction, ".integral_kg_m3_s">::kView, derived, end, kAtEnd,
               [](R r) { return ((*r.contact).*of).jellett->integral; }),
      told(Path<kJellett, prediction, ".balance_kg_m3_s">::kView, kAtEnd, kRemainder,
           [](R r) { return ((*r.contact).*of).jellett->balance; }),
      told(Path<kJellett, prediction, ".balance_over_size">::kView, kAtEnd, kRemainder,
           [](R r) { return over_size(*((*r.contact).*of).jellett); }),
  };
}

/// The balance of the Jacobi integral in one prediction: the integral at both ends, and the work of friction.
template <FixedText prediction, ContactBalances ContactReport::*of>
constexpr auto work_members() {
  using enum FigureKind;
  using enum FigureScope;
  constexpr FixedText kWork = "contact.work.";
  return std::array{
      object(Path<kWork, prediction>::kView),
      compared(Path<kWork, prediction, ".slip_work_J">::kView, derived, end, kAtEnd,
               [](R r) { return ((*r.contact).*of).jacobi->integral; }),
      compared(Path<kWork, prediction, ".jacobi_first_J">::kView, derived, any, kAtEnd,
               [](R r) { return ((*r.contact).*of).jacobi->first; }),
      compared(Path<kWork, prediction, ".jacobi_last_J">::kView, derived, end, kAtEnd,
               [](R r) { return ((*r.contact).*of).jacobi->last; }),
      told(Path<kWork, prediction, ".balance_J">::kView, kAtEnd, kRemainder,
           [](R r) { return ((*r.contact).*of).jacobi->balance; }),
      told(Path<kWork, prediction, ".balance_over_size">::kView, kAtEnd, kRemainder,
           [](R r) { return over_size(*((*r.contact).*of).jacobi); }),
  };
}

inline constexpr auto kContactBalanceMembers =
    joined(std::array{object_or_nothing("contact.jellett", [](R r) { return r.contact->rotating.jellett.has_value(); })},
           jellett_members<"rotating", &ContactReport::rotating>(), jellett_members<"reference", &ContactReport::reference>(),
           std::array{object_or_nothing("contact.work", [](R r) { return r.contact->rotating.jacobi.has_value(); })},
           work_members<"rotating", &ContactReport::rotating>(), work_members<"reference", &ContactReport::reference>());

}  // namespace earthtop::figure_table
