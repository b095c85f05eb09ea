// SPDX-License-Identifier: GPL-3.0-or-later
/// How methods look in plots.
#pragma once

#include <optional>
#include <string_view>

#include "earthtop/plot/plot.hpp"

namespace earthtop {

struct Look {
  LineColor color;
  Marker marker;
  bool operator==(const Look&) const = default;
};

/// Colour and marker of a method, from its row in the table of methods; none for what is not a method or has no look.
std::optional<Look> look_of_method(std::string_view word);

}  // namespace earthtop
