// SPDX-License-Identifier: GPL-3.0-or-later
/// What happens to the contact of a top with a table during a motion.
#pragma once

#include <optional>
#include <string_view>

#include "earthtop/drift/stop_event.hpp"

namespace earthtop {

enum class ContactEventKind {
  slip_stopped,     ///< exact dry friction has brought the slip to zero: the tip rolls on
  slip_started,     ///< rolling took more friction than the table gives
  lifted_off,       ///< the normal force fell to zero: the run ends
  rim_touched,      ///< the tilt passed the largest that is allowed: the run ends
  inverted,         ///< the axis passed the table's plane upward: a tippe top stands up
  no_unique_force,  ///< Painleve's paradox: no force, or several, keep the tip on the table: the run ends
  patch_stopped  ///< a contact patch (`contensou`) neither slides nor turns any more, and dry friction holds it: the run ends
};
std::string_view to_string(ContactEventKind kind);
/// What happens, in a sentence without its end.
std::string_view in_words(ContactEventKind kind);
/// Whether nothing is computed after such an event.
bool ends_run(ContactEventKind kind);

struct ContactEvent {
  ContactEventKind kind = ContactEventKind::slip_stopped;
  Prediction prediction = Prediction::reference;
  double t_s = 0;
  /// Time of this event in the rotating motion less that in the reference, without cancellation (s); none where only one of the
  /// two has it.
  std::optional<double> time_difference_s{};
  std::optional<double> bound_s{};  ///< bound on the error of `t_s`
};

}  // namespace earthtop
