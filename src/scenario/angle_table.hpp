// SPDX-License-Identifier: GPL-3.0-or-later
/// Reads tables of angles, or of rates, from CSV text.
#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "earthtop/frames/angle_table.hpp"

namespace earthtop::scenario {

/// The first fault of a table and its line (1-based).
struct TableFault {
  std::size_t line = 0;
  std::string message;
};

/// What a table lists.
struct TableKind {
  std::string_view header;    ///< its first line: the names of its two columns
  std::string_view in_units;  ///< what its second column is, and in which unit
  bool lists_rates;           ///< rates (rad/s), or else angles (rad)
  std::string_view column() const { return header.substr(header.find(',') + 1); }
};
inline constexpr TableKind kTableOfAngles{"t_s,angle_rad", "the angles in radians", false};
inline constexpr TableKind kTableOfRates{"t_s,rate_rad_s", "the rates in rad/s", true};

/// Reads a table from CSV text: its header line, then at least four lines of two finite numbers. The times must
/// be strictly ascending, start at or before 0 and end at or after the duration. Lines end with LF or CRLF; the last one may
/// end with the text.
/// @param duration_s  (s); if it is 0, the last time is not checked   @returns the table, or its first fault
std::variant<AngleTable, TableFault> parse_angle_table(std::string_view text, double duration_s,
                                                       const TableKind& kind = kTableOfAngles);

}  // namespace earthtop::scenario
