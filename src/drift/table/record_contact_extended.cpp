// SPDX-License-Identifier: GPL-3.0-or-later
#include "drift/table/record_contact.ipp"

namespace earthtop {
EARTHTOP_RECORD_CONTACT(float80, Observer::laboratory)
EARTHTOP_RECORD_CONTACT(float80, Observer::inertial)
EARTHTOP_RECORD_CONTACT(float128, Observer::laboratory)
EARTHTOP_RECORD_CONTACT(float128, Observer::inertial)
}  // namespace earthtop
