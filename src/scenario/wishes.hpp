// SPDX-License-Identifier: GPL-3.0-or-later
/// Answers to keys that users have looked for in a scenario and that there are not, by their words: what earthtop cannot do, and what
/// it can instead. An entry goes when its key comes.
#pragma once

#include "input/fields.hpp"

namespace earthtop::scenario {

inline constexpr input::Wish kWishes[] = {
    {"cage|gyrostat", "the cage of a rotor is /body, and the rotor that turns in it is /rotor"},
    {"suspension|cardan",
     "a Cardan suspension is /gimbals: /gimbals/outer is the outer gimbal, and /body the inner one, which carries /rotor"},
    {"ring",
     "a ring as a part of the top is one of /body/solids, {\"shape\": \"ring\"}; the rings of a suspension are "
     "/gimbals/outer and /body"},
    {"tape", "the tape that carries a gyroscope is the torsion of /gimbals/outer, torsion_N_m_rad and torsion_rest_deg"},
    {"ellipsoid",
     "neither a solid nor the tip can be an ellipsoid: give an ellipsoid's mass and moments as mass_kg and inertia, "
     "and its tip as a sphere, /contact/tip_radius_m"},
    {"rim|edge",
     "no rim or edge rolls on the table, as that of a coin does: only a spherical tip touches it, and a run ends "
     "where the rim would, at /contact/max_tilt_deg"},
    {"camera",
     "what a camera's tilt and turn do to measured angles is told by /instrument/turn_east_deg, turn_north_deg and "
     "turn_up_deg"},
    {"clock_offset",
     "t = 0 is the release; what a clock shows then is /instrument/time_offset_s, and the times of another program's results "
     "are "
     "shifted by /time/offset_s of a mapping"},
};

}  // namespace earthtop::scenario
