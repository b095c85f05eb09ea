// SPDX-License-Identifier: GPL-3.0-or-later
/// The name by which sentences call an input of a fit.
#pragma once

#include <string>
#include <string_view>

namespace earthtop::measure {

/// "the Earth's rate" for "/earth/rotation_rate_rad_s"; the name itself where there are no words for it.
std::string spoken_input(std::string_view name);

}  // namespace earthtop::measure
