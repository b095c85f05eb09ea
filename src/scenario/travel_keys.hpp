// SPDX-License-Identifier: GPL-3.0-or-later
/// The description of a journey's keys, as keys.hpp describes the other sections.
#pragma once

#include "earthtop/frames/travel_spec.hpp"
#include "scenario/rules.hpp"

namespace earthtop::scenario {

/// Returns the double nearest to a speed in knots, in m/s.
double m_s_from_knots(double knots);

/// Describes a speed. It is written in m/s, so that the canonical text has the number that the run used.
template <class Codec, class S>
void speed_keys(Codec& codec, S& moving) {
  if constexpr (!Codec::kWrites) {
    if (codec.takes("speed_kn", false)) {
      double knots = 0;
      codec.key("speed_kn", knots);
      moving.speed_m_s = m_s_from_knots(knots);
      return;
    }
  }
  codec.key("speed_m_s", moving.speed_m_s);
}

template <class Codec, class S>
void leg_keys(Codec& codec, S& leg) {
  codec.key("duration_s", leg.duration_s);
  speed_keys(codec, leg);
  codec.sparse("turn_deg", leg.turn_deg);
  codec.sparse("climb_m", leg.climb_m);
}

/// Describes a journey without its legs. The keys of a path are written with that path only, the radius with a sphere only.
template <class Codec, class S>
void travel_keys(Codec& codec, S& travel) {
  codec.word("path", travel.path, kTravelPaths);
  const bool has_table = travel.path == TravelPath::table;
  if (!Codec::kWrites || !has_table) {
    codec.key("course_deg", travel.course_deg);
    speed_keys(codec, travel);
  }
  if (!Codec::kWrites || has_table) {
    codec.key("file", travel.table[0].file);
    codec.key("file_sha256", travel.table[0].file_sha256);  // represents the table in the run's identity
  }
  codec.word("reference", travel.reference, kTravelReferences);
  codec.word("eotvos", travel.eotvos, kTravelEotvos);
  codec.word("figure", travel.figure, kTravelFigures);
  if (!Codec::kWrites || travel.figure == TravelFigure::sphere) codec.key("radius_m", travel.radius_m);
}

}  // namespace earthtop::scenario
