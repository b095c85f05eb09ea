// SPDX-License-Identifier: GPL-3.0-or-later
/// Reads tables of angles, of rates or of places from CSV text.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "earthtop/frames/angle_table.hpp"

namespace earthtop::scenario {

/// The first fault of a table and its line (1-based).
struct TableFault {
  std::size_t line = 0;
  std::string message;
};

/// What a table lists.
struct TableKind {
  std::string_view header;    ///< its first line: the names of its columns, of which the first is the time
  std::string_view in_units;  ///< what its other columns are, and in which unit
  std::string_view rate_unit, acceleration_unit;
  bool lists_rates;  ///< rates, or else what has them
  /// The column of angles in degrees that go round, where a step by more than half a turn goes the other way; 0: none.
  std::size_t circular_column = 0;
};
inline constexpr TableKind kTableOfAngles{"t_s,angle_rad", "the angles in radians", "rad/s", "rad/s^2", false};
inline constexpr TableKind kTableOfRates{"t_s,rate_rad_s", "the rates in rad/s", "rad/s", "rad/s^2", true};
inline constexpr TableKind kTableOfPlaces{"t_s,x_m,y_m,z_m", "the coordinates in metres", "m/s", "m/s^2", false};

inline constexpr TableKind kTableOfTorques{"t_s,x_N_m,y_N_m,z_N_m", "the torques in N m", "N m/s", "N m/s^2", false};
inline constexpr TableKind kTableOfJourney{"t_s,latitude_deg,longitude_deg,height_m",
                                           "the places in degrees and metres",
                                           "deg/s or m/s",
                                           "deg/s^2 or m/s^2",
                                           false,
                                           2};

/// Reads a table from CSV text: its header line, then at least four lines of as many finite numbers. The times must
/// be strictly ascending, start at or before 0 and end at or after the duration. Lines end with LF or CRLF; the last one may
/// end with the text.
/// @param duration_s  (s); if it is 0, the last time is not checked   @returns a table for each column beside the times, or the first fault
std::variant<std::vector<AngleTable>, TableFault> parse_tables(std::string_view text, double duration_s, const TableKind& kind);

/// The same of a table with one column beside the times.
std::variant<AngleTable, TableFault> parse_angle_table(std::string_view text, double duration_s,
                                                       const TableKind& kind = kTableOfAngles);

}  // namespace earthtop::scenario
