// SPDX-License-Identifier: GPL-3.0-or-later
/// A map of a way over the Earth: a graticule without coasts, so that a few metres and a whole turn look alike.
#pragma once

#include <string>
#include <vector>

#include "report/drawings.hpp"

namespace earthtop::report {

/// A way over the Earth from a start.
struct Track {
  double start_latitude_deg = 0, start_longitude_deg = 0;
  std::vector<double> north_deg, east_deg;  ///< latitude and longitude less those of the start; without jumps at the date line
  double radius_m = 0;                      ///< of the parallel at the middle latitude, over its cosine: of a degree's length
  std::string title, subtitle;
};

/// The middle of a track's latitudes, at which its map is true (deg).
double middle_latitude_deg(const Track& track);

/// Whether a track is long enough for a map, and on a planet: one that stands still, or climbs, is not.
bool has_map(const Track& track);

/// "45.5° N", "180°", "0.002° W". @param decimals  after the point
std::string latitude_text(double deg, int decimals);
std::string longitude_text(double deg, int decimals);
/// Both of a place, with as many decimals as tell the places of a track apart.
std::string place_text(const Track& track, double north_deg, double east_deg);

/// SVG documents: the track over lines of whole degrees or parts of them, start and end marked, and a bar that shows the scale. A degree of
/// longitude is cos(middle latitude) of a degree of latitude wide, so that courses are angles there. A track that goes round the Earth more
/// than once is drawn on one turn.
Drawings track_svg(const Track& track);

}  // namespace earthtop::report
