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
  }
  throw std::logic_error("unknown event of a contact");
}

bool ends_run(ContactEventKind kind) {
  return kind == ContactEventKind::lifted_off || kind == ContactEventKind::rim_touched ||
         kind == ContactEventKind::no_unique_force;
}

}  // namespace earthtop
