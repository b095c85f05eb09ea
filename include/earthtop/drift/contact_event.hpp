// SPDX-License-Identifier: GPL-3.0-or-later
/// The events of the contact of a top with a table during a motion.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "earthtop/drift/stop_event.hpp"

namespace earthtop {

enum class ContactEventKind {
  slip_stopped,     ///< exact dry friction has brought the slip to zero
  slip_started,     ///< rolling took more friction than the table gives
  lifted_off,       ///< the normal force fell to zero
  rim_touched,      ///< the tilt passed the largest that is allowed
  inverted,         ///< the axis passed the table's plane upward: a tippe top stands up
  no_unique_force,  ///< Painleve's paradox: no force, or more than one, keeps the tip on the table
  patch_stopped     ///< a contact patch (`contensou`) neither slides nor turns any more
};

struct ContactEventType {
  ContactEventKind kind;
  std::string_view name;
  std::string_view words;  ///< what happens, in a sentence without its full stop
  bool ends_run;           ///< whether nothing is computed after such an event
};
inline constexpr ContactEventType kContactEvents[] = {
    {ContactEventKind::slip_stopped, "slip_stopped", "friction has brought the slip to zero, and the tip rolls on", false},
    {ContactEventKind::slip_started, "slip_started",
     "rolling needs more friction than the table gives, and the tip starts to slip", false},
    {ContactEventKind::lifted_off, "lifted_off", "the normal force falls to zero, and the tip lifts off: the run ends", true},
    {ContactEventKind::rim_touched, "rim_touched",
     "the tilt exceeds the largest one allowed, and the rim touches the table: the run ends", true},
    {ContactEventKind::inverted, "inverted", "the axis passes the table's plane upward: the top stands up on its other end",
     false},
    {ContactEventKind::no_unique_force, "no_unique_force",
     "no force, or more than one, keeps the tip on the table (Painlevé's paradox): the run ends", true},
    {ContactEventKind::patch_stopped, "patch_stopped",
     "the contact patch has stopped sliding and turning at the same time, and dry friction holds it: the run ends", true}};
constexpr const ContactEventType& type_of(ContactEventKind kind) { return kContactEvents[static_cast<std::size_t>(kind)]; }
static_assert([] {
  for (const ContactEventType& type : kContactEvents)
    if (&type_of(type.kind) != &type) return false;
  return true;
}());
constexpr std::string_view to_string(ContactEventKind kind) { return type_of(kind).name; }
constexpr bool ends_run(ContactEventKind kind) { return type_of(kind).ends_run; }

struct ContactEvent {
  ContactEventKind kind = ContactEventKind::slip_stopped;
  Prediction prediction = Prediction::reference;
  double t_s = 0;
  /// Time of this event in the rotating motion minus that in the reference, without cancellation (s); none where only one of the
  /// two has it.
  std::optional<double> time_difference_s{};
  std::optional<double> bound_s{};  ///< bound on the error of `t_s`
};

}  // namespace earthtop
