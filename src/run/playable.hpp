// SPDX-License-Identifier: GPL-3.0-or-later
/// Which scenes the page to play with (tools/play) runs: its engine asks here, and so does the gallery.
#pragma once

#include <string>

#include "earthtop/scene/scene.hpp"

namespace earthtop {

/// The reason for scenes with a date, a tide or chosen effects, which need these places.
inline constexpr const char* kNoSunOrMoon = "a page has no places of the Sun and the Moon";

/// The reason for a laboratory that travels: the page's pictures and sliders know one at rest.
inline constexpr const char* kNoJourney = "a page shows a laboratory at rest, and this one travels";

/// Why the page does not run a scene: what is in the way and, after a semicolon, the remedy. Empty if it does.
std::string unplayable(const Scene& scene);

}  // namespace earthtop
