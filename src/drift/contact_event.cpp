// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/drift/contact_event.hpp"

#include <stdexcept>

namespace earthtop {

std::string_view to_string(ContactEventKind kind) {
  switch (kind) {
    case ContactEventKind::slip_stopped: return "slip_stopped";
    case ContactEventKind::slip_started: return "slip_started";
    case ContactEventKind::lifted_off: return "lifted_off";
    case ContactEventKind::rim_touched: return "rim_touched";
    case ContactEventKind::inverted: return "inverted";
    case ContactEventKind::no_unique_force: return "no_unique_force";
    case ContactEventKind::patch_stopped: return "patch_stopped";
  }
  throw std::logic_error("unknown event of a contact");
}

std::string_view in_words(ContactEventKind kind) {
  switch (kind) {
    case ContactEventKind::slip_stopped: return "friction has brought the slip to zero, and the tip rolls on";
    case ContactEventKind::slip_started: return "rolling takes more friction than the table gives, and the tip slips";
    case ContactEventKind::lifted_off: return "the normal force falls to zero, and the tip lifts off: the run ends";
    case ContactEventKind::rim_touched:
      return "the tilt passes the largest allowed, and the rim touches the table: the run ends";
    case ContactEventKind::inverted: return "the axis passes the table's plane upward: the top stands up on its other end";
    case ContactEventKind::no_unique_force:
      return "no force, or several, keep the tip on the table (Painlevé's paradox): the run ends";
    case ContactEventKind::patch_stopped:
      return "slip and turning of the contact patch have ended together, and dry friction holds it: the run ends";
  }
  throw std::logic_error("unknown event of a contact");
}

bool ends_run(ContactEventKind kind) {
  return kind == ContactEventKind::lifted_off || kind == ContactEventKind::rim_touched ||
         kind == ContactEventKind::no_unique_force || kind == ContactEventKind::patch_stopped;
}

}  // namespace earthtop
