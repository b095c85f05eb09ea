// SPDX-License-Identifier: GPL-3.0-or-later
/// A journey of the laboratory as a scenario gives it.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "earthtop/frames/angle_table.hpp"

namespace earthtop {

/// `rhumb`: constant course. `geodesic`: the straightest line on the surface of constant height. `table`: places at given times.
enum class TravelPath { rhumb, geodesic, table };
/// The motion that the drift is measured from: the same journey on an Earth that stands still, or the laboratory that stays at the
/// place of the release on the Earth that turns.
enum class TravelReference { same_path, at_rest };
/// Which motions feel the plumb line lean by -2 W x v (Coriolis force on the laboratory): the rotating one, both, or none.
enum class TravelEotvos { rotating, both, off };
enum class TravelFigure { wgs84, sphere };

/// A part of a journey. What changes in it does so by x^3 (10 - 15 x + 6 x^2), where x is the share of its duration.
struct TravelLeg {
  double duration_s = 0;
  std::optional<double> speed_m_s = {};  ///< reached at its end; unchanged if left out
  double turn_deg = 0;                   ///< of the course, clockwise, in addition to the path's own
  double climb_m = 0;
  bool operator==(const TravelLeg&) const = default;
};

/// A journey as a scenario gives it. It starts at the site.
struct TravelSpec {
  TravelPath path = TravelPath::rhumb;
  double course_deg = 0;  ///< compass course at the start
  double speed_m_s = 0;   ///< horizontal, at the pivot's height, relative to the Earth, at the start
  std::vector<TravelLeg> legs = {};
  std::array<FiledTable, 3> table = {};  ///< for TravelPath::table: latitude (deg), longitude (deg, without jumps), height (m)
  TravelReference reference = TravelReference::same_path;
  TravelEotvos eotvos = TravelEotvos::rotating;
  TravelFigure figure = TravelFigure::wgs84;
  double radius_m = 6371008.7714;  ///< of the sphere: the mean radius of WGS 84, (2 a + b)/3
  /// Whether gravity is normal gravity all along the journey, and not everywhere that of the site: where a scenario does not give it, or gives
  /// that of the site.
  bool has_normal_gravity = false;

  bool operator==(const TravelSpec&) const = default;
};

/// The lengths (m) of one unit of each column of a table of places, at its first row: of a degree of latitude, of a degree of longitude, and
/// of a metre.
std::array<double, 3> metres_a_unit(const TravelSpec& spec);

/// The acceleration that errors of one unit in the last printed digit of a table of places make in its spline (m/s^2, root mean square):
/// 6 sigma/D^2 for independent errors sigma of rows that are D apart, here of the two that are nearest to each other. It is 0 without a
/// table; a column that never changes has no errors. [The spline's second derivatives answer an error of frequency f with
/// 6 (2 cos 2 pi f D - 2)/(2 cos 2 pi f D + 4)/D^2, of which the mean square is 36/D^4.]
double noise_of_table_m_s2(const TravelSpec& spec);

/// A laboratory is not carried farther North or South: East and North lose their meaning at the poles.
inline constexpr double kLargestLatitudeDeg = 89.9;

}  // namespace earthtop
