// SPDX-License-Identifier: GPL-3.0-or-later
// Why the drift of a body in gimbals is what it is.
#include "run/why_told.hpp"

namespace earthtop::why {

void tell_with_gimbals(Told& told) { tell_earth_turns(told); }

}  // namespace earthtop::why
