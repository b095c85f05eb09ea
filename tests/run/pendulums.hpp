// SPDX-License-Identifier: GPL-3.0-or-later
/// Runs of symmetric bodies on a pivot, pendulums among them.
#pragma once

#include <fmt/format.h>

#include <string>

#include "earthtop/run.hpp"

namespace earthtop::testing {

struct Pendulum {
  double I1, I3, center_m, mass_kg = 1;
};
/// @param release, more, earth  members of a scenario, in JSON; without the last one the Earth does not rotate
inline RunResult run_of(const Pendulum& body, const std::string& release, double duration_s, const std::string& more = "",
                        const std::string& earth = R"("rotation_rate_rad_s": 0)") {
  const std::string text = fmt::format(
      R"({{"site": {{"latitude_deg": 50, "gravity_m_s2": 9.8}}, "earth": {{{}}}, "body": {{"mass_kg": {}, "center_of_mass_m": [0, 0, {}],
         "inertia": {{"principal_kg_m2": [{}, {}, {}]}}}}, "release": {{{}}}, "motion": {{"duration_s": {}}}{}}})",
      earth, body.mass_kg, body.center_m, body.I1, body.I1, body.I3, release, duration_s, more);
  return run(parse_scene({"m.json", text}, {}));
}

}  // namespace earthtop::testing
