// SPDX-License-Identifier: GPL-3.0-or-later
// What the engine leaves out, in place of the core's own source: the places of the Sun and the Moon, since ERFA is a compiled library.
#include "earthtop/error.hpp"
#include "frames/ephemeris.hpp"
#include "run/playable.hpp"

namespace earthtop {
namespace {

[[noreturn]] void refuse_date() {
  throw ScenarioError("/motion/start_utc", std::string(kNoSunOrMoon) + "; run it with the program, earthtop run");
}

}  // namespace

std::optional<UtcInstant> parse_utc(std::string_view) { refuse_date(); }
TerrestrialTime terrestrial_time(const UtcInstant&, double) { refuse_date(); }
Vec3<double> moon_position_I(const TerrestrialTime&) { refuse_date(); }
Vec3<double> sun_position_I(const TerrestrialTime&) { refuse_date(); }
Vec3<double> mean_axis_I(const TerrestrialTime&) { refuse_date(); }
Mat3<double> celestial_to_terrestrial(const UtcInstant&, double) { refuse_date(); }

}  // namespace earthtop
