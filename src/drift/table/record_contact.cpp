// SPDX-License-Identifier: GPL-3.0-or-later
#include "drift/table/record_contact.ipp"

namespace earthtop {
EARTHTOP_RECORD_CONTACT(double, Observer::laboratory)
EARTHTOP_RECORD_CONTACT(double, Observer::inertial)
}  // namespace earthtop
